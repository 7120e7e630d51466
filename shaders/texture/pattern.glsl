// What texture trees are made of, beside pictures.
#include "shared/bindings.glsl"
#include "base/math.glsl"
#include "texture/noise.glsl"
#include "texture/worley.glsl"

// A point in the space of the pattern whose record starts at word w.
vec3 pattern_point(uint w, vec3 p)
{
    Pattern pattern = pattern_unpack(fetch_textures(w), fetch_textures(w + 1u), fetch_textures(w + 2u));
    vec4 point = vec4(p, 1.0);
    return vec3(dot(pattern.row0, point), dot(pattern.row1, point), dot(pattern.row2, point));
}

// A constant input, and the word of the record of one that is a texture.
vec4 texture_constant(uint w) { return vec4(texture_input_unpack(fetch_textures(w)).value, 1.0); }
uint texture_input(uint w) { return texture_input_unpack(fetch_textures(w)).at; }

vec4 texture_checker(vec3 p, vec4 even, vec4 odd)
{
    // Parity from the fraction: a float that is large is an even whole number
    vec3 cell = floor(p);
    vec3 half_cell = 0.5 * cell;
    vec3 parity = half_cell - floor(half_cell);
    float sum = parity.x + parity.y + parity.z;
    return sum - floor(sum) > 0.25 ? odd : even;
}

float gradient_linear(vec3 p) { return p.x; }
float gradient_cylindrical(vec3 p) { return length(p.xy); }
float gradient_spherical(vec3 p) { return length(p); }

vec4 texture_gradient(float distance, vec4 low, vec4 high) { return mix(low, high, clamp(distance, 0.0, 1.0)); }

// The colour map at word w. A stop that is passed covers those before it.
vec4 texture_ramp(uint w, vec4 value)
{
    Ramp ramp = ramp_unpack(fetch_textures(w));
    uint first = w + RAMP_WORDS + TEXTURE_INPUT_WORDS;
    RampStop last = ramp_stop_unpack(fetch_textures(first));
    vec3 color = last.color;
    float x = mean_component(value.rgb);
    for (uint i = 1u; i < ramp.count; ++i) {
        RampStop stop = ramp_stop_unpack(fetch_textures(first + i * RAMP_STOP_WORDS));
        // Two stops at one place are a step
        float t = clamp((x - last.place) / max(stop.place - last.place, 1e-20), 0.0, 1.0);
        if (ramp.smooth_stops != 0u) t = t * t * (3.0 - 2.0 * t);
        color = mix(color, stop.color, t);
        last = stop;
    }
    return vec4(color, 1.0);
}

vec4 texture_mix(vec4 a, vec4 b, vec4 amount) { return mix(a, b, clamp(mean_component(amount.rgb), 0.0, 1.0)); }
vec4 texture_add(vec4 a, vec4 b) { return vec4(a.rgb + b.rgb, 1.0); }
vec4 texture_multiply(vec4 a, vec4 b) { return vec4(a.rgb * b.rgb, a.a * b.a); }
vec4 texture_invert(vec4 value) { return vec4(1.0 - value.rgb, value.a); }

// The sum of the record at word w; `creased` sums absolute values.
vec4 texture_noise(uint w, vec3 p, bool creased, vec4 low, vec4 high)
{
    NoiseSum noise = noise_sum_unpack(fetch_textures(w));
    float sum = 0.0;
    float amplitude = noise.scale;
    for (uint i = 0u; i < noise.octaves; ++i) {
        float n = perlin_noise(p);
        sum += amplitude * (creased ? abs(n) : n);
        amplitude *= noise.gain;
        p *= noise.lacunarity;
    }
    return mix(low, high, clamp(creased ? sum : 0.5 + 0.5 * sum, 0.0, 1.0));
}
