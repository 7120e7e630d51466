// Queues of slots between kernels. A queue has two halves, one read and one filled, and each half has a part for every
// octant of directions: rays of one octant meet the same nodes, and the lanes of a subgroup stay together longer.
#include "shared/bindings.glsl"

layout(local_size_x = WORKGROUP) in;

const uint QUEUE_PATHS = 0u;
const uint QUEUE_SHADOWS = 1u;

// Workgroup to piece of work. A CPU driver cuts a dispatch into one contiguous part a thread and never balances them:
// neighbouring pieces go to different parts. Dispatches are ⌈pieces / threads⌉ × threads.
uint interleaved_group() { return gl_WorkGroupID.x * frame.threads + gl_WorkGroupID.y; }

uint queue_counter(uint which, uint half_index, uint bin)
{
    return (which == QUEUE_PATHS ? COUNTER_PATHS : COUNTER_SHADOWS) + half_index * QUEUE_BINS + bin;
}

uint queue_place(uint which, uint half_index, uint bin, uint i)
{
    return ((which * 2u + half_index) * QUEUE_BINS + bin) * frame.slot_count + i;
}

uint octant(vec3 direction)
{
    return (direction.x < 0.0 ? 1u : 0u) | (direction.y < 0.0 ? 2u : 0u) | (direction.z < 0.0 ? 4u : 0u);
}

void queue_append(uint which, uint half_index, vec3 direction, uint slot)
{
    uint bin = octant(direction);
    queue[queue_place(which, half_index, bin, atomicAdd(counters[queue_counter(which, half_index, bin)], 1u))] = slot;
}

// A slot of the half that is read, or NONE for an invocation too many, and the half that is filled.
struct Taken { uint slot; uint next_half; };

Taken queue_take(uint which)
{
    uint w = which * SCHEDULE_WORDS;
    uvec4 head = fetch_schedule(w + 4u);
    uvec4 begins[2] = uvec4[2](fetch_schedule(w), fetch_schedule(w + 1u));
    uvec4 lengths[2] = uvec4[2](fetch_schedule(w + 2u), fetch_schedule(w + 3u));
    uint group = interleaved_group();
    uint bin = 0u;
    uint begin = 0u;
    uint length = lengths[0].x;
    for (int b = 1; b < int(QUEUE_BINS); ++b) {
        bool beyond = group >= begins[b / 4][b % 4];
        bin = beyond ? uint(b) : bin;
        begin = beyond ? begins[b / 4][b % 4] : begin;
        length = beyond ? lengths[b / 4][b % 4] : length;
    }
    uint i = (group - begin) * WORKGROUP + gl_LocalInvocationIndex;
    uint slot = NONE;
    if (group < head.y && i < length) slot = queue[queue_place(which, head.x, bin, i)];
    return Taken(slot, 1u - head.x);
}
