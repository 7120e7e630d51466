// Where a ray is on its way through the trees.
#include "shared/bindings.glsl"

struct Hit { float t; uint triangle; uint instance; };

const Hit NO_HIT = Hit(0.0, NONE, NONE);

bool is_hit(Hit hit) { return hit.triangle != NONE || hit.instance != NONE; }

// What a ray brings along for surfaces that let some of it through.
struct Passing {
    uint key;     // of its random decisions
    float t_min;  // where it begins: it has met and passed what is there
    vec3 through; // of a shadow ray: the part of its light that has come through
};

const Passing PASSING_NOTHING = Passing(0u, 0.0, vec3(1.0));

// What is open, and what it met so far.
struct Walk { uint current; uint depth; uint instance; Hit hit; };

// References besides those of nodes and leaves.
const uint REFERENCE_DONE = 0xffffffffu;
const uint REFERENCE_LEAVE_INSTANCE = 0xfffffffeu;

bool is_in_tree(uint reference) { return (reference & (LEAF | LEAF_INSTANCE)) != (LEAF | LEAF_INSTANCE); }

// How many nodes, triangles and instances a ray was tested against. Switch of the variant: COUNT_TESTS.
#ifdef COUNT_TESTS
uint tests_done = 0u;
#define COUNT_TEST tests_done += 1u;
#else
#define COUNT_TEST
#endif
