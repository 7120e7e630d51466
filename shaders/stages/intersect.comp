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
    Traversal s = fetch_hits(slot).w == HIT_PARKED ? traversal_resume(2u * slot) : traversal_start(FAR);
    bool finished = traverse(ray.origin, ray.direction, s);
    if (!finished) traversal_park(2u * slot, s);
    bool hit = s.hit.triangle != NONE || s.hit.instance != NONE;
    uint state = !finished ? HIT_PARKED : hit ? HIT_SURFACE : HIT_MISS;
    store_hits(slot, uvec4(floatBitsToUint(s.hit.t), s.hit.triangle, s.hit.instance, state));
}
