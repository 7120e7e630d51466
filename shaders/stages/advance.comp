// Between two rounds of the wave: the queues change halves, and the next dispatches get their sizes.
#include "stages/wave.glsl"

uint dispatch_groups(uint count)
{
    uint pieces = (count + WORKGROUP - 1u) / WORKGROUP;
    return (pieces + frame.threads - 1u) / frame.threads * frame.threads;
}

void main()
{
    if (gl_LocalInvocationIndex != 0u) return;
    uint turn = 1u - counters[COUNTER_TURN];
    counters[COUNTER_TURN] = turn;
    counters[COUNTER_PATHS + 1u - turn] = 0u;
    counters[COUNTER_SHADOWS + 1u - turn] = 0u;
    counters[COUNTER_PATH_GROUPS] = dispatch_groups(counters[COUNTER_PATHS + turn]);
    counters[COUNTER_PATH_GROUPS + 1u] = 1u;
    counters[COUNTER_PATH_GROUPS + 2u] = 1u;
    counters[COUNTER_SHADOW_GROUPS] = dispatch_groups(counters[COUNTER_SHADOWS + turn]);
    counters[COUNTER_SHADOW_GROUPS + 1u] = 1u;
    counters[COUNTER_SHADOW_GROUPS + 2u] = 1u;
}
