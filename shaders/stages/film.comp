// The samples of a wave into the sums of the film: one invocation a pixel.
#include "stages/wave.glsl"
#include "base/fixed.glsl"

const float AOV_SCALE = 1048576.0; // 2^20, src/layout AOV_EXPONENT

// What the samples of a pixel add, before it goes into the film.
struct PixelSums {
    uvec2 radiance[3];
    uvec3 squares[3];
    uvec2 aov[7]; // albedo, depth, normal
    uint samples;
    uint covered;
    uint left_out;
    uint clamped;
    uint depth_hits;
};

void add_sample(inout PixelSums sums, uint slot)
{
    uvec4 word = fetch_paths(slot * PATH_WORDS + 1u);
    uint flags = word.w >> PATH_FLAGS_SHIFT;
    vec3 radiance = uintBitsToFloat(word.xyz) * frame.radiance_scale;
    if (!is_finite(radiance.x + radiance.y + radiance.z)) {
        sums.left_out += 1u;
        return;
    }
    vec3 limited = clamp(radiance, vec3(0.0), vec3(FIXED_LIMIT));
    if (limited != radiance) sums.clamped += 1u;
    vec3 whole = vec3(fixed_round(limited.x), fixed_round(limited.y), fixed_round(limited.z));
    for (int c = 0; c < 3; ++c) {
        sums.radiance[c] = fixed_add(sums.radiance[c], fixed_from_float(whole[c]));
        sums.squares[c] = fixed_wide_add(sums.squares[c], fixed_wide_from_float(whole[c] * whole[c]));
    }
    sums.samples += 1u;
    sums.covered += flags & PATH_COVERED;
    if ((flags & PATH_HAS_AOV) == 0u) return;
    vec4 albedo_depth = uintBitsToFloat(fetch_aovs(slot * AOV_WORDS));
    vec3 normal = uintBitsToFloat(fetch_aovs(slot * AOV_WORDS + 1u).xyz);
    vec3 albedo = clamp(albedo_depth.xyz, 0.0, 65536.0);
    for (int c = 0; c < 3; ++c) {
        sums.aov[c] = fixed_add(sums.aov[c], fixed_from_float(albedo[c] * AOV_SCALE));
        sums.aov[4 + c] = fixed_add(sums.aov[4 + c], fixed_from_float(normal[c] * AOV_SCALE));
    }
    sums.aov[3] = fixed_add(sums.aov[3], fixed_from_float(min(albedo_depth.w * frame.depth_scale, FIXED_LIMIT)));
    sums.depth_hits += 1u;
}

uint film_at(uint plane, uint pixel) { return (plane * frame.film_tile_count * WORKGROUP + pixel) * 4u; }

void film_add(uint at, uvec2 value)
{
    uvec2 sum = fixed_add(uvec2(film[at], film[at + 1u]), value);
    film[at] = sum.x;
    film[at + 1u] = sum.y;
}

void film_add_wide(uint at, uvec3 value)
{
    uvec3 sum = fixed_wide_add(uvec3(film[at], film[at + 1u], film[at + 2u]), value);
    film[at] = sum.x;
    film[at + 1u] = sum.y;
    film[at + 2u] = sum.z;
}

// The planes are those of src/film.
void store_pixel(uint pixel, PixelSums sums)
{
    film_add(film_at(0u, pixel), sums.radiance[0]);
    film_add(film_at(0u, pixel) + 2u, sums.radiance[1]);
    film_add(film_at(1u, pixel), sums.radiance[2]);
    film[film_at(1u, pixel) + 2u] += sums.samples;
    film[film_at(1u, pixel) + 3u] += sums.covered;
    film_add_wide(film_at(2u, pixel), sums.squares[0]);
    film_add_wide(film_at(3u, pixel), sums.squares[1]);
    film_add_wide(film_at(4u, pixel), sums.squares[2]);
    film[film_at(2u, pixel) + 3u] += sums.left_out;
    film[film_at(3u, pixel) + 3u] += sums.clamped;
    film_add(film_at(5u, pixel), sums.aov[0]);
    film_add(film_at(5u, pixel) + 2u, sums.aov[1]);
    film_add(film_at(6u, pixel), sums.aov[2]);
    film_add(film_at(6u, pixel) + 2u, sums.aov[3]);
    film_add(film_at(7u, pixel), sums.aov[4]);
    film_add(film_at(7u, pixel) + 2u, sums.aov[5]);
    film_add(film_at(8u, pixel), sums.aov[6]);
    film[film_at(8u, pixel) + 2u] += sums.depth_hits;
}

void main()
{
    // A wave with parked rays is not finished: the host sends it round again.
    if (counters[COUNTER_WAITING_PATHS] + counters[COUNTER_WAITING_SHADOWS] != 0u) return;
    uint tile = interleaved_group();
    uint lane = gl_LocalInvocationIndex;
    if (tile >= frame.tile_count || !slot_place(tile * frame.sample_count * WORKGROUP + lane).inside) return;
    uint pixel = (frame.first_tile + tile - frame.film_first_tile) * WORKGROUP + lane;
    PixelSums sums = PixelSums(uvec2[3](uvec2(0), uvec2(0), uvec2(0)), uvec3[3](uvec3(0), uvec3(0), uvec3(0)),
                               uvec2[7](uvec2(0), uvec2(0), uvec2(0), uvec2(0), uvec2(0), uvec2(0), uvec2(0)),
                               0u, 0u, 0u, 0u, 0u);
    for (uint s = 0u; s < frame.sample_count; ++s) add_sample(sums, (tile * frame.sample_count + s) * WORKGROUP + lane);
    store_pixel(pixel, sums);
}
