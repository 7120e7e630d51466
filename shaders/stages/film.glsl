// The samples of a wave into the sums of the film: one invocation a pixel. Switch of the variant: SIGNED_FILTER. VIEW: the including
// file decides what is shown of each sample.
#include "stages/wave.glsl"
#include "base/fixed.glsl"

const float AOV_SCALE = float(1u << AOV_BITS);
// The largest magnitude of a sample before it is weighted.
#ifdef SIGNED_FILTER
#define SAMPLE_LIMIT (FIXED_LIMIT / frame.filter_weight)
#else
#define SAMPLE_LIMIT FIXED_LIMIT
#endif

// What the samples of a pixel add, before it goes into the film.
struct PixelSums {
    uvec2 radiance[3];
    uvec3 squares[3];
    uvec2 albedo[3];
    uvec2 normal[3];
    uvec2 depth;
    uint samples;
    uint covered;
    uint left_out;
    uint clamped;
    uint depth_hits;
};

#ifdef VIEW
// Puts what a view shows of a path in place of its radiance: `word` is the second word of the path.
void show(inout uvec4 word, inout PixelSums sums);
#endif

void add_sample(inout PixelSums sums, uint slot)
{
    uvec4 word = fetch_paths(slot * PATH_WORDS + 1u);
#ifdef VIEW
    show(word, sums);
#endif
    uint flags = word.w >> PATH_FLAGS_SHIFT;
    vec3 radiance = uintBitsToFloat(word.xyz) * frame.radiance_scale;
    if (!is_finite(radiance.x + radiance.y + radiance.z)) {
        sums.left_out += 1u;
        return;
    }
    vec3 limited = clamp(radiance, vec3(0.0), vec3(SAMPLE_LIMIT));
    if (limited != radiance) sums.clamped += 1u;
#ifdef SIGNED_FILTER
    limited *= frame.filter_weight;
#endif
    vec3 whole = vec3(fixed_round(limited.x), fixed_round(limited.y), fixed_round(limited.z));
    for (int c = 0; c < 3; ++c) {
#ifdef SIGNED_FILTER
        sums.radiance[c] = fixed_add(sums.radiance[c], fixed_from_float((flags & PATH_NEGATIVE) != 0u ? -whole[c] : whole[c]));
#else
        sums.radiance[c] = fixed_add(sums.radiance[c], fixed_from_float(whole[c]));
#endif
        sums.squares[c] = fixed_wide_add(sums.squares[c], fixed_wide_from_float(whole[c] * whole[c]));
    }
    sums.samples += 1u;
    sums.covered += flags & PATH_COVERED;
    if ((flags & PATH_HAS_AOV) == 0u) return;
    vec4 albedo_depth = uintBitsToFloat(fetch_aovs(slot * AOV_WORDS));
    vec3 normal = uintBitsToFloat(fetch_aovs(slot * AOV_WORDS + 1u).xyz);
    vec3 albedo = clamp(albedo_depth.xyz, 0.0, 65536.0);
    for (int c = 0; c < 3; ++c) {
        sums.albedo[c] = fixed_add(sums.albedo[c], fixed_from_float(albedo[c] * AOV_SCALE));
        sums.normal[c] = fixed_add(sums.normal[c], fixed_from_float(normal[c] * AOV_SCALE));
    }
    sums.depth = fixed_add(sums.depth, fixed_from_float(min(albedo_depth.w * frame.depth_scale, FIXED_LIMIT)));
    sums.depth_hits += 1u;
}

uint film_at(uint word, uint pixel) { return ((word / 4u) * frame.film_tile_count * WORKGROUP + pixel) * 4u + word % 4u; }

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

void store_pixel(uint pixel, PixelSums sums)
{
    for (uint c = 0u; c < 3u; ++c) {
        film_add(film_at(FILM_RADIANCE + 2u * c, pixel), sums.radiance[c]);
        film_add_wide(film_at(FILM_SQUARES + 4u * c, pixel), sums.squares[c]);
        film_add(film_at(FILM_ALBEDO + 2u * c, pixel), sums.albedo[c]);
        film_add(film_at(FILM_NORMAL + 2u * c, pixel), sums.normal[c]);
    }
    film_add(film_at(FILM_DEPTH, pixel), sums.depth);
    film[film_at(FILM_SAMPLES, pixel)] += sums.samples;
    film[film_at(FILM_COVERED, pixel)] += sums.covered;
    film[film_at(FILM_LEFT_OUT, pixel)] += sums.left_out;
    film[film_at(FILM_CLAMPED, pixel)] += sums.clamped;
    film[film_at(FILM_DEPTH_HITS, pixel)] += sums.depth_hits;
}

void main()
{
    // A wave with rays that wait is not finished: the host sends it round again.
    if (counters[COUNTER_WAITING_PATHS] + counters[COUNTER_WAITING_SHADOWS] != 0u) return;
    uint tile = interleaved_group();
    uint lane = gl_LocalInvocationIndex;
    if (tile >= frame.tile_count || !slot_place(tile * frame.sample_count * WORKGROUP + lane).inside) return;
    // In a tile, the pixels of the film are row by row.
    uvec2 at = tile_place(lane);
    uint pixel = (frame.first_tile + tile - frame.film_first_tile) * WORKGROUP + at.y * TILE + at.x;
    uvec2 zero = uvec2(0u);
    uvec3 wide = uvec3(0u);
    PixelSums sums = PixelSums(uvec2[3](zero, zero, zero), uvec3[3](wide, wide, wide), uvec2[3](zero, zero, zero),
                               uvec2[3](zero, zero, zero), zero, 0u, 0u, 0u, 0u, 0u);
    for (uint s = 0u; s < frame.sample_count; ++s) add_sample(sums, (tile * frame.sample_count + s) * WORKGROUP + lane);
    store_pixel(pixel, sums);
}
