// Between two rounds of the wave: the queues change halves, and the next dispatches get their sizes.
#include "stages/queue.glsl"

// Gives the parts of a queue their workgroups; the number of entries.
uint schedule_queue(uint which, uint turn, uint groups_at)
{
    uint lengths[QUEUE_BINS];
    uint begins[QUEUE_BINS];
    uint groups = 0u;
    uint waiting = 0u;
    for (uint b = 0u; b < QUEUE_BINS; ++b) {
        lengths[b] = counters[queue_counter(which, turn, b)];
        counters[queue_counter(which, 1u - turn, b)] = 0u;
        begins[b] = groups;
        groups += (lengths[b] + WORKGROUP - 1u) / WORKGROUP;
        waiting += lengths[b];
    }
    uint w = which * SCHEDULE_WORDS;
    store_schedule(w, uvec4(begins[0], begins[1], begins[2], begins[3]));
    store_schedule(w + 1u, uvec4(begins[4], begins[5], begins[6], begins[7]));
    store_schedule(w + 2u, uvec4(lengths[0], lengths[1], lengths[2], lengths[3]));
    store_schedule(w + 3u, uvec4(lengths[4], lengths[5], lengths[6], lengths[7]));
    store_schedule(w + 4u, uvec4(turn, groups, 0u, 0u));
    counters[groups_at] = (groups + frame.threads - 1u) / frame.threads;
    counters[groups_at + 1u] = frame.threads;
    counters[groups_at + 2u] = 1u;
    return waiting;
}

void main()
{
    if (gl_LocalInvocationIndex != 0u) return;
    uint turn = 1u - counters[COUNTER_TURN];
    counters[COUNTER_TURN] = turn;
    counters[COUNTER_WAITING_PATHS] = schedule_queue(QUEUE_PATHS, turn, COUNTER_PATH_GROUPS);
    counters[COUNTER_WAITING_SHADOWS] = schedule_queue(QUEUE_SHADOWS, turn, COUNTER_SHADOW_GROUPS);
}
