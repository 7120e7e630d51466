// The samples of a wave into the sums of the film: one invocation a pixel.
#include "stages/wave.glsl"
#include "base/fixed.glsl"

const uint AOV_WORDS = 2u;
const float AOV_SCALE = 1048576.0; // 2^20, src/layout AOV_EXPONENT

uint film_at(uint plane, uint pixel) { return (plane * frame.film_tile_count * WORKGROUP + pixel) * 4u; }

void film_add(uint at, float value)
{
    uvec2 sum = fixed_add(uvec2(film[at], film[at + 1u]), fixed_from_float(value));
    film[at] = sum.x;
    film[at + 1u] = sum.y;
}

// One channel: the sum, and the sum of squares in a plane of its own.
void film_add_radiance(uint at, uint square_at, float value)
{
    film_add(at, value);
    float whole = fixed_round(value);
    uvec3 square = fixed_wide_from_float(whole * whole);
    square = fixed_wide_add(uvec3(film[square_at], film[square_at + 1u], film[square_at + 2u]), square);
    film[square_at] = square.x;
    film[square_at + 1u] = square.y;
    film[square_at + 2u] = square.z;
}

void film_add_sample(uint pixel, uint slot)
{
    Path path = path_load(slot);
    vec3 radiance = path.radiance * frame.radiance_scale;
    if (!is_finite(radiance.x + radiance.y + radiance.z)) {
        film[film_at(2u, pixel) + 3u] += 1u;
        return;
    }
    vec3 limited = clamp(radiance, vec3(0.0), vec3(FIXED_LIMIT));
    if (limited != radiance) film[film_at(3u, pixel) + 3u] += 1u;
    film_add_radiance(film_at(0u, pixel), film_at(2u, pixel), limited.x);
    film_add_radiance(film_at(0u, pixel) + 2u, film_at(3u, pixel), limited.y);
    film_add_radiance(film_at(1u, pixel), film_at(4u, pixel), limited.z);
    film[film_at(1u, pixel) + 2u] += 1u;
    if ((path.flags & PATH_COVERED) != 0u) film[film_at(1u, pixel) + 3u] += 1u;
    if ((path.flags & PATH_HAS_AOV) == 0u) return;

    vec4 albedo_depth = uintBitsToFloat(fetch_aovs(slot * AOV_WORDS));
    vec3 normal = uintBitsToFloat(fetch_aovs(slot * AOV_WORDS + 1u).xyz);
    vec3 albedo = clamp(albedo_depth.xyz, 0.0, 65536.0) * AOV_SCALE;
    film_add(film_at(5u, pixel), albedo.x);
    film_add(film_at(5u, pixel) + 2u, albedo.y);
    film_add(film_at(6u, pixel), albedo.z);
    film_add(film_at(6u, pixel) + 2u, min(albedo_depth.w * frame.depth_scale, FIXED_LIMIT));
    film_add(film_at(7u, pixel), normal.x * AOV_SCALE);
    film_add(film_at(7u, pixel) + 2u, normal.y * AOV_SCALE);
    film_add(film_at(8u, pixel), normal.z * AOV_SCALE);
    film[film_at(8u, pixel) + 2u] += 1u;
}

void main()
{
    // A wave with parked rays is not finished: the host sends it round again.
    uint turn = counters[COUNTER_TURN];
    if (counters[COUNTER_PATHS + turn] + counters[COUNTER_SHADOWS + turn] != 0u) return;
    uint tile = interleaved_group(frame.tile_count);
    uint lane = gl_LocalInvocationIndex;
    if (tile >= frame.tile_count || !slot_place(tile * frame.sample_count * WORKGROUP + lane).inside) return;
    uint pixel = (frame.first_tile + tile - frame.film_first_tile) * WORKGROUP + lane;
    for (uint s = 0u; s < frame.sample_count; ++s) film_add_sample(pixel, (tile * frame.sample_count + s) * WORKGROUP + lane);
}
