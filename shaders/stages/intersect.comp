// The nearest surface along the ray of every path in the queue. PARKING: for rays that are too long for one dispatch.
#include "stages/wave.glsl"
#include "geometry/traverse.glsl"

void main()
{
    uint slot = queue_take(QUEUE_PATHS).slot;
    if (slot == NONE) return;
    WaveRay ray = ray_load(slot);
    Hit nearest = Hit(FAR, NONE, NONE);
#ifdef PARKING
    bool finished = traverse(ray.origin, ray.direction, fetch_hits(slot).w == HIT_PARKED, 2u * slot, nearest);
    uint unfinished = HIT_PARKED;
#else
    if (fetch_hits(slot).w == HIT_LONG) return;
    bool finished = traverse(ray.origin, ray.direction, false, 0u, nearest);
    uint unfinished = HIT_LONG;
#endif
    bool hit = nearest.triangle != NONE || nearest.instance != NONE;
    uint state = !finished ? unfinished : hit ? HIT_SURFACE : HIT_MISS;
    store_hits(slot, uvec4(floatBitsToUint(nearest.t), nearest.triangle, nearest.instance, state));
}
