// Bricks and dots: patterns in x and y whose cells have random numbers.
#include "shared/bindings.glsl"
#include "texture/octaves.glsl"
#include "texture/pattern.glsl"
#include "texture/worley.glsl"

// The part of the cells 0 to 1 that is left of x, where each has a gap of `gap` at both of its ends; from 0.
float filled_until(float x, float gap)
{
    float cell = floor(x);
    return cell * (1.0 - 2.0 * gap) + clamp(x - cell - gap, 0.0, 1.0 - 2.0 * gap);
}

// How much of a width around x is not gap.
float filled(float x, float width, float gap)
{
    float place = x - floor(x);
    if (width < 1e-5) return place >= gap && place < 1.0 - gap ? 1.0 : 0.0;
    return clamp((filled_until(place + 0.5 * width, gap) - filled_until(place - 0.5 * width, gap)) / width, 0.0, 1.0);
}

// The wall whose record is at word w; each brick has a lightness of its own, which fades where the pixel is wider.
vec4 texture_brick(uint w, vec3 p, vec3 widths, vec4 brick, vec4 mortar)
{
    Wall wall = wall_unpack(fetch_textures(w));
    float variation = node_number_unpack(fetch_textures(w + 1u)).number;
    vec2 cell = p.xy / wall.size;
    vec2 width = widths.xy / wall.size;
    vec2 gap = 0.5 * wall.joint / wall.size;
    float row = floor(cell.y);
    cell.x += wall.offset * row;
    float random = float(pcg3d(uvec3(ivec3(clamp(vec3(floor(cell.x), row, 0.0), -1e9, 1e9)))).x >> 8u) * (1.0 / 8388608.0) - 1.0;
    float lightness = 1.0 + variation * random * octave_weight(resolved_octaves(max(width.x, width.y)));
    float share = filled(cell.x, width.x, gap.x) * filled(cell.y, width.y, gap.y);
    return mix(mortar, vec4(brick.rgb * lightness, brick.a), share);
}

// The dots whose radius is at word w (pbrt, DotsBase): their cells are those around whole numbers.
vec4 texture_dots(uint w, vec3 p, vec3 widths, vec4 outside, vec4 inside)
{
    float radius = node_number_unpack(fetch_textures(w)).number;
    vec2 cell = floor(p.xy + 0.5);
    bool present = pbrt_noise(vec3(cell + 0.5, 0.5)) > 0.0;
    float shift = 0.5 - radius;
    vec2 center = cell + shift * vec2(pbrt_noise(vec3(cell + vec2(1.5, 2.8), 0.5)), pbrt_noise(vec3(cell + vec2(4.5, 9.8), 0.5)));
    float distance = length(p.xy - center);
    float width = max(widths.x, widths.y);
    float sharp = width > 0.0 ? clamp(0.5 + (radius - distance) / width, 0.0, 1.0) : float(distance < radius);
    // Half of the cells have a dot
    float share = mix(0.5 * PI * radius * radius, present ? sharp : 0.0, octave_weight(resolved_octaves(width)));
    return mix(outside, inside, share);
}
