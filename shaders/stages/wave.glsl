// The wave of paths: which slot is which pixel and sample, and the state of a path.
#include "stages/queue.glsl"
#include "base/random.glsl"
#include "base/time.glsl"

// Slots are ordered by tile, then sample, then pixel of the tile in Morton order.
struct SlotPlace { uvec2 pixel; uint sample_index; bool inside; };

uint morton_even(uint x) { return (x & 1u) | ((x >> 1) & 2u) | ((x >> 2) & 4u); }

// Column and row, within its tile, of the pixel of a lane.
uvec2 tile_place(uint lane) { return uvec2(morton_even(lane), morton_even(lane >> 1)); }

uvec2 tile_pixel(uint tile, uint lane)
{
    uvec2 corner = uvec2(tile % frame.tiles_x, tile / frame.tiles_x) * TILE;
    return frame.window_min + corner + tile_place(lane);
}

SlotPlace slot_place(uint slot)
{
    uint group = slot / WORKGROUP;
    uvec2 pixel = tile_pixel(frame.first_tile + group / frame.sample_count, slot % WORKGROUP);
    bool inside = pixel.x < frame.window_max.x && pixel.y < frame.window_max.y;
    return SlotPlace(pixel, frame.first_sample + group % frame.sample_count, inside);
}

// A path between kernels.
struct Path {
    vec3 throughput;
    float pdf;          // of the last direction, over solid angle; 0 = camera or mirror direction
    vec3 radiance;
    uint depth;         // scattering events so far
    uint diffuse_depth; // those that were neither mirror nor clear glass
    uint flags;
    uint medium;        // material that the path is inside of, or NONE
    float eta_scale;    // product of squared index ratios, for Russian roulette
    SampleKey key;      // of its random numbers
};

const uint PATH_COVERED = 1u;     // the camera ray hit something
const uint PATH_HAS_AOV = 2u;     // its albedo, depth and normal are stored
const uint PATH_WAITS = 4u;       // its shadow ray is too long for one dispatch
const uint PATH_NEGATIVE = 8u;    // the pixel filter is below 0 at its place on the film
const uint PATH_FLAGS_SHIFT = 2u * PATH_DEPTH_BITS;
const uint PATH_DEPTH_MASK = (1u << PATH_DEPTH_BITS) - 1u;

Path path_load(uint slot)
{
    uvec4 a = fetch_paths(slot * PATH_WORDS);
    uvec4 b = fetch_paths(slot * PATH_WORDS + 1u);
    uvec4 c = fetch_paths(slot * PATH_WORDS + 2u);
    return Path(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w & PATH_DEPTH_MASK,
                (b.w >> PATH_DEPTH_BITS) & PATH_DEPTH_MASK, b.w >> PATH_FLAGS_SHIFT, c.x, uintBitsToFloat(c.y), SampleKey(c.z, c.w, frame.strata));
}

void path_store(uint slot, Path p)
{
    store_paths(slot * PATH_WORDS, uvec4(floatBitsToUint(p.throughput), floatBitsToUint(p.pdf)));
    uint packed = p.depth | (p.diffuse_depth << PATH_DEPTH_BITS) | (p.flags << PATH_FLAGS_SHIFT);
    store_paths(slot * PATH_WORDS + 1u, uvec4(floatBitsToUint(p.radiance), packed));
}

// What only glass changes, beside the key of the random numbers, which stays as the camera made it.
void path_store_medium(uint slot, Path p)
{
    store_paths(slot * PATH_WORDS + 2u, uvec4(p.medium, floatBitsToUint(p.eta_scale), p.key.pixel, p.key.index));
}

// The key of the path of a slot.
SampleKey path_key(uint slot)
{
    uvec4 c = fetch_paths(slot * PATH_WORDS + 2u);
    return SampleKey(c.z, c.w, frame.strata);
}

// Sets `path_time`. The time of a path is a function of its key.
void time_begin(SampleKey key)
{
#ifdef HAS_TIME
    path_time = sample_1d(key, DIMENSION_TIME);
#endif
}

// Of the decisions at surfaces that let some rays through, the same until the path has its next event.
uint path_opacity_key(Path p) { return hash2(hash2(p.key.pixel, p.key.index), p.depth); }

// The ray of a slot, and the cone around it that its pixel sees (Akenine-Möller et al. 2021).
struct WaveRay {
    vec3 origin;
    float width;    // of the cone at the origin, scene units
    vec3 direction; // of unit length
    float spread;   // what the width grows by in a unit of length
};

WaveRay ray_load(uint slot)
{
    vec4 a = uintBitsToFloat(fetch_rays(slot * RAY_WORDS));
    vec4 b = uintBitsToFloat(fetch_rays(slot * RAY_WORDS + 1u));
    return WaveRay(a.xyz, a.w, b.xyz, b.w);
}

void ray_store(uint slot, WaveRay ray)
{
    store_rays(slot * RAY_WORDS, floatBitsToUint(vec4(ray.origin, ray.width)));
    store_rays(slot * RAY_WORDS + 1u, floatBitsToUint(vec4(ray.direction, ray.spread)));
}

// What `hits` holds in its last lane, and `shadows`: there, 0 is a ray that nobody has followed yet.
const uint HIT_MISS = 0u;
const uint HIT_SURFACE = 1u;
const uint HIT_LONG = 2u;   // ran out of steps: waits for the kernel that can park it
const uint HIT_PARKED = 3u; // stands where it was parked
const uint HIT_PASSED = 4u; // goes on beyond the surface at `t`, which has let it through
