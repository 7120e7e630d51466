// The nearest surface along the ray of every path in the queue. PARKING: for rays that are too long for one dispatch.
// COUNT_TESTS: the radiance of the path, which no light reaches in the view of it, is the number of tests so far.
#include "stages/wave.glsl"
#include "geometry/traverse.glsl"

void main()
{
    uint slot = queue_take(QUEUE_PATHS).slot;
    if (slot == NONE) return;
#ifdef HAS_TIME
    time_begin(path_key(slot));
#endif
    WaveRay ray = ray_load(slot);
    uvec4 before = fetch_hits(slot);
    Hit nearest = Hit(FAR, NONE, NONE);
    Passing passing = PASSING_NOTHING;
#ifdef HAS_OPACITY
    passing.key = path_opacity_key(path_load(slot));
    if (before.w >= HIT_LONG) passing.t_min = uintBitsToFloat(before.x);
#endif
#ifdef PARKING
    bool finished = traverse(ray.origin, ray.direction, before.w == HIT_PARKED, 2u * slot, passing, nearest);
    uint unfinished = HIT_PARKED;
#else
    if (before.w == HIT_LONG) return;
    bool finished = traverse(ray.origin, ray.direction, false, 0u, passing, nearest);
    uint unfinished = HIT_LONG;
#endif
#ifdef COUNT_TESTS
    // A ray that is neither finished nor parked begins again
    uint done = finished || unfinished == HIT_PARKED ? tests_done : 0u;
    uvec4 radiance = fetch_paths(slot * PATH_WORDS + 1u);
    radiance.x = floatBitsToUint(uintBitsToFloat(radiance.x) + float(done));
    store_paths(slot * PATH_WORDS + 1u, radiance);
#endif
    uint state = !finished ? unfinished : is_hit(nearest) ? HIT_SURFACE : HIT_MISS;
    float t = finished ? nearest.t : passing.t_min;
    store_hits(slot, uvec4(floatBitsToUint(t), nearest.triangle, nearest.instance, state));
}
