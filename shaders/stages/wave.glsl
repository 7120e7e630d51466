// The wave of paths: which slot is which pixel and sample, the state of a path, and the queues between kernels.
#include "shared/bindings.glsl"
#include "base/random.glsl"

layout(local_size_x = 64) in;

// Workgroup g to the g-th piece of work. A CPU driver cuts a dispatch into one contiguous part a thread and never
// balances them: neighbouring pieces go to different parts. Work is ⌈pieces / threads⌉ · threads groups.
uint interleaved_group(uint pieces)
{
    uint columns = (pieces + frame.threads - 1u) / frame.threads;
    return (gl_WorkGroupID.x % columns) * frame.threads + gl_WorkGroupID.x / columns;
}

// Slots are ordered by tile, then sample, then pixel of the tile in Morton order.
struct SlotPlace { uvec2 pixel; uint sample_index; bool inside; };

uint morton_even(uint x) { return (x & 1u) | ((x >> 1) & 2u) | ((x >> 2) & 4u); }

uvec2 tile_pixel(uint tile, uint lane)
{
    uvec2 corner = uvec2(tile % frame.tiles_x, tile / frame.tiles_x) * TILE;
    return frame.window_min + corner + uvec2(morton_even(lane), morton_even(lane >> 1));
}

SlotPlace slot_place(uint slot)
{
    uint group = slot / WORKGROUP;
    uvec2 pixel = tile_pixel(frame.first_tile + group / frame.sample_count, slot % WORKGROUP);
    bool inside = pixel.x < frame.window_max.x && pixel.y < frame.window_max.y;
    return SlotPlace(pixel, frame.first_sample + group % frame.sample_count, inside);
}

SampleKey slot_key(SlotPlace place) { return sample_key(place.pixel, place.sample_index, frame.seed, frame.strata); }

// A path between kernels: three words.
struct Path {
    vec3 throughput;
    float pdf;          // of the last direction, over solid angle; 0 = camera or mirror direction
    vec3 radiance;
    uint depth;         // scattering events so far
    uint diffuse_depth; // those that were neither mirror nor clear glass
    uint flags;
    uint medium;        // material that the path is inside of, or NONE
    float eta_scale;    // product of squared index ratios, for Russian roulette
};

const uint PATH_COVERED = 1u;     // the camera ray hit something
const uint PATH_HAS_AOV = 2u;
const uint PATH_WORDS = 3u;

Path path_load(uint slot)
{
    uvec4 a = fetch_paths(slot * PATH_WORDS);
    uvec4 b = fetch_paths(slot * PATH_WORDS + 1u);
    uvec4 c = fetch_paths(slot * PATH_WORDS + 2u);
    return Path(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w & 0xfffu, (b.w >> 12) & 0xfffu,
                b.w >> 24, c.x, uintBitsToFloat(c.y));
}

void path_store(uint slot, Path p)
{
    store_paths(slot * PATH_WORDS, uvec4(floatBitsToUint(p.throughput), floatBitsToUint(p.pdf)));
    uint packed = p.depth | (p.diffuse_depth << 12) | (p.flags << 24);
    store_paths(slot * PATH_WORDS + 1u, uvec4(floatBitsToUint(p.radiance), packed));
    store_paths(slot * PATH_WORDS + 2u, uvec4(p.medium, floatBitsToUint(p.eta_scale), 0u, 0u));
}

// The ray of a slot: two words. The last lane says whether a shadow ray of the slot is parked.
struct WaveRay { vec3 origin; vec3 direction; };

const uint RAY_WORDS = 2u;
const uint SHADOW_WORDS = 3u; // of the shadow ray of a slot
const uint AOV_WORDS = 2u;    // of albedo, depth and normal

WaveRay ray_load(uint slot)
{
    return WaveRay(uintBitsToFloat(fetch_rays(slot * RAY_WORDS).xyz), uintBitsToFloat(fetch_rays(slot * RAY_WORDS + 1u).xyz));
}

void ray_store(uint slot, vec3 origin, vec3 direction)
{
    store_rays(slot * RAY_WORDS, uvec4(floatBitsToUint(origin), 0u));
    store_rays(slot * RAY_WORDS + 1u, uvec4(floatBitsToUint(direction), 0u));
}

// What `hits` holds in its last lane.
const uint HIT_MISS = 0u;
const uint HIT_SURFACE = 1u;
const uint HIT_PARKED = 2u;

// Counters. Two halves of each queue take turns: `turn` says which is read.
const uint COUNTER_TURN = 0u;
const uint COUNTER_PATHS = 1u;          // 1, 2: length of the path queue, by half
const uint COUNTER_SHADOWS = 3u;        // 3, 4: length of the shadow queue, by half
const uint COUNTER_STEPS = 5u;          // kernels ran out of steps this often
const uint COUNTER_PATH_GROUPS = 8u;    // 8, 9, 10: size of the dispatch over paths
const uint COUNTER_SHADOW_GROUPS = 12u; // 12, 13, 14: size of the dispatch over shadow rays

// `queue` holds the two halves of the path queue, then those of the shadow queue.
uint path_queue(uint half_index, uint i) { return half_index * frame.slot_count + i; }
uint shadow_queue(uint half_index, uint i) { return (2u + half_index) * frame.slot_count + i; }

void path_append(uint half_index, uint slot)
{
    queue[path_queue(half_index, atomicAdd(counters[COUNTER_PATHS + half_index], 1u))] = slot;
}

void shadow_append(uint half_index, uint slot)
{
    queue[shadow_queue(half_index, atomicAdd(counters[COUNTER_SHADOWS + half_index], 1u))] = slot;
}
