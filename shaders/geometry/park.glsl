// Rays that ran out of steps: `parked` keeps current reference, depth of the stack, instance, hit, and the light that has
// come through, then the stack.

#include "geometry/walk.glsl"

uint parked_at(uint place) { return place * (PARKED_HEAD + frame.parked_stack); }

Walk parked_walk(uint place)
{
    uint at = parked_at(place);
    Hit hit = Hit(uintBitsToFloat(parked[at + 3u]), parked[at + 4u], parked[at + 5u]);
    return Walk(parked[at], parked[at + 1u], parked[at + 2u], hit);
}

uint parked_entry(uint place, uint i) { return parked[parked_at(place) + PARKED_HEAD + i]; }

vec3 parked_through(uint place)
{
    uint at = parked_at(place) + 6u;
    return uintBitsToFloat(uvec3(parked[at], parked[at + 1u], parked[at + 2u]));
}

void park_through(uint place, vec3 through)
{
    uint at = parked_at(place) + 6u;
    parked[at] = floatBitsToUint(through.x);
    parked[at + 1u] = floatBitsToUint(through.y);
    parked[at + 2u] = floatBitsToUint(through.z);
}

void park(uint place, Walk walk)
{
    uint at = parked_at(place);
    parked[at] = walk.current;
    parked[at + 1u] = walk.depth;
    parked[at + 2u] = walk.instance;
    parked[at + 3u] = floatBitsToUint(walk.hit.t);
    parked[at + 4u] = walk.hit.triangle;
    parked[at + 5u] = walk.hit.instance;
}

void park_entry(uint place, uint i, uint entry) { parked[parked_at(place) + PARKED_HEAD + i] = entry; }
