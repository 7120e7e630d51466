// Whether light reaches the paths in the shadow queue; what reaches them is added to their radiance.
// PARKING: for rays that are too long for one dispatch.
#include "stages/wave.glsl"
#define ANY_HIT
#include "geometry/traverse.glsl"

void main()
{
    Taken taken = queue_take(QUEUE_SHADOWS);
    uint slot = taken.slot;
    if (slot == NONE) return;
#ifdef HAS_TIME
    time_begin(path_key(slot));
#endif
    uvec4 a = fetch_shadows(slot * SHADOW_WORDS);
    uvec4 b = fetch_shadows(slot * SHADOW_WORDS + 1u);
    uvec4 c = fetch_shadows(slot * SHADOW_WORDS + 2u);
    Hit blocker = Hit(uintBitsToFloat(a.w), NONE, NONE);
    Passing passing = PASSING_NOTHING;
#ifdef PARKING
    bool finished = traverse(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), c.w == HIT_PARKED, 2u * slot + 1u, passing, blocker);
    uint unfinished = HIT_PARKED;
#else
    // A ray that is known to be long is not followed again: it hits nothing and stays in the queue.
    if (c.w == HIT_LONG) blocker.t = 0.0;
    bool finished = traverse(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), false, 0u, passing, blocker) && c.w != HIT_LONG;
    uint unfinished = HIT_LONG;
#endif
    uvec4 radiance = fetch_paths(slot * PATH_WORDS + 1u);
    if (finished) {
        bool lit = !is_hit(blocker);
        vec3 sum = uintBitsToFloat(radiance.xyz) + (lit ? uintBitsToFloat(c.xyz) * passing.through : vec3(0.0));
        uint state = radiance.w & ~(PATH_WAITS << PATH_FLAGS_SHIFT);
        if (lit || c.w != 0u) store_paths(slot * PATH_WORDS + 1u, uvec4(floatBitsToUint(sum), state));
        return;
    }
    // The rest waits in the other half; the path waits for it in shade.comp.
    store_shadows(slot * SHADOW_WORDS + 2u, uvec4(c.xyz, unfinished));
    store_paths(slot * PATH_WORDS + 1u, uvec4(radiance.xyz, radiance.w | (PATH_WAITS << PATH_FLAGS_SHIFT)));
    queue_append(QUEUE_SHADOWS, taken.next_half, uintBitsToFloat(b.xyz), slot);
}
