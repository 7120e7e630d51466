// The nearest surface along the ray of every path in the queue.
#include "stages/wave.glsl"
#include "geometry/traverse.glsl"

void main()
{
    uint turn = counters[COUNTER_TURN];
    uint count = counters[COUNTER_PATHS + turn];
    uint i = interleaved_group((count + WORKGROUP - 1u) / WORKGROUP) * WORKGROUP + gl_LocalInvocationIndex;
    if (i >= count) return;
    uint slot = queue[path_queue(turn, i)];
    if (slot == NONE) return;
    WaveRay ray = ray_load(slot);
    Hit nearest = Hit(FAR, NONE, NONE);
    bool finished = traverse(ray.origin, ray.direction, fetch_hits(slot).w == HIT_PARKED, 2u * slot, nearest);
    bool hit = nearest.triangle != NONE || nearest.instance != NONE;
    uint state = !finished ? HIT_PARKED : hit ? HIT_SURFACE : HIT_MISS;
    store_hits(slot, uvec4(floatBitsToUint(nearest.t), nearest.triangle, nearest.instance, state));
}
