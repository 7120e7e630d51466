// Where patterns are, and those that need no noise.
#include "shared/bindings.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"

Pattern pattern_fetch(uint w)
{
    return pattern_unpack(fetch_textures(w), fetch_textures(w + 1u), fetch_textures(w + 2u), fetch_textures(w + 3u));
}

// A point in the space of the pattern whose record starts at word w, and w of noise in four dimensions.
vec3 pattern_point(uint w, vec3 p)
{
    Pattern pattern = pattern_fetch(w);
    vec4 point = vec4(p, 1.0);
    return vec3(dot(pattern.row0, point), dot(pattern.row1, point), dot(pattern.row2, point));
}

float pattern_w(uint w, float time)
{
    Pattern pattern = pattern_fetch(w);
    return pattern.w + time * pattern.w_rate;
}

// How wide a pixel is along the axes of the pattern: that of an ellipsoid which is `widths` wide along those of its space.
vec3 pattern_widths(uint w, vec3 widths)
{
    Pattern pattern = pattern_fetch(w);
    vec3 along = vec3(length(pattern.row0.xyz * widths), length(pattern.row1.xyz * widths), length(pattern.row2.xyz * widths));
    return pattern.filter_width * along;
}

float widest(vec3 widths) { return max(widths.x, max(widths.y, widths.z)); }

// Parity from the fraction: a float that is large is an even whole number.
vec3 parity_of(vec3 cell)
{
    vec3 half_cell = 0.5 * cell;
    return half_cell - floor(half_cell);
}

vec4 texture_checker(vec3 p, uint dimensions, vec4 even, vec4 odd)
{
    vec3 parity = parity_of(floor(p));
    float sum = parity.x + parity.y + (dimensions == 3u ? parity.z : 0.0);
    return sum - floor(sum) > 0.25 ? odd : even;
}

// Mean over a width of the square wave that is 1 in even cells and −1 in odd ones. Its integral is a triangle wave.
float square_wave(float x, float width)
{
    float low = floor(x - 0.5 * width);
    float high = floor(x + 0.5 * width);
    float place = x - 2.0 * floor(0.5 * x);
    if (low == high) return place < 1.0 ? 1.0 : -1.0;
    vec2 ends = vec2(place + 0.5 * width, place - 0.5 * width);
    vec2 integral = abs(ends - 2.0 * floor(0.5 * ends) - 1.0);
    return clamp((integral.y - integral.x) / width, -1.0, 1.0);
}

vec4 texture_checker_filtered(vec3 p, vec3 widths, uint dimensions, vec4 even, vec4 odd)
{
    float wave = square_wave(p.x, widths.x) * square_wave(p.y, widths.y);
    if (dimensions == 3u) wave *= square_wave(p.z, widths.z);
    return mix(even, odd, 0.5 - 0.5 * wave);
}

float gradient_linear(vec3 p) { return p.x; }
float gradient_cylindrical(vec3 p) { return length(p.xy); }
float gradient_spherical(vec3 p) { return length(p); }

vec4 texture_gradient(float distance, vec4 low, vec4 high) { return mix(low, high, clamp(distance, 0.0, 1.0)); }
