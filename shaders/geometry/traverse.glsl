// Rays through the two levels of trees. Switches of the variant: HAS_INSTANCES (there is a tree over instances; else
// the root is that of the triangles in world space), HAS_SPHERES, HAS_DISKS, ANY_HIT (stop at the first hit).
//
// A ray takes at most `frame.step_limit` steps here: the rest waits in the Traversal, which can be kept and resumed
// (Mesa before 25.0 leaves loops after 65,535 rounds).
#include "shared/bindings.glsl"
#include "geometry/instance.glsl"
#include "geometry/quadric.glsl"
#include "geometry/triangle.glsl"

struct Hit { float t; uint triangle; uint instance; };

// References besides those of nodes and leaves.
const uint REFERENCE_DONE = 0xffffffffu;
const uint REFERENCE_LEAVE_INSTANCE = 0xfffffffeu;

struct Traversal { uint current; uint depth; uint instance; Hit hit; };

uint traversal_stack[TRAVERSAL_STACK];

Traversal traversal_start(float t_max)
{
    traversal_stack[0] = REFERENCE_DONE;
    return Traversal(frame.root, 1u, NONE, Hit(t_max, NONE, NONE));
}

// 1 / direction without infinities, so that a box test never meets 0 · ∞.
vec3 safe_inverse(vec3 d)
{
    const float tiny = 1e-25;
    return 1.0 / vec3(abs(d.x) < tiny ? tiny : d.x, abs(d.y) < tiny ? tiny : d.y, abs(d.z) < tiny ? tiny : d.z);
}

// Entry and exit distance of a box; the exit is widened by the rounding of the test (Ize 2013).
vec2 box_range(vec3 low, vec3 high, vec3 origin, vec3 inverse, float t_max)
{
    vec3 a = (low - origin) * inverse;
    vec3 b = (high - origin) * inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    return vec2(max(max(near.x, near.y), max(near.z, 0.0)), min(min(far.x, far.y), min(far.z, t_max)) * 1.00000036);
}

// Traces on from `s`; true when the ray is finished, false when it ran out of steps.
bool traverse(vec3 origin, vec3 direction, inout Traversal s)
{
    vec3 o = origin;
    vec3 d = direction;
#ifdef HAS_INSTANCES
    if (s.instance != NONE) {
        Instance entered = instance_fetch(s.instance);
        if (entered.in_world == 0u) {
            o = object_point(entered, origin);
            d = object_vector(entered, direction);
        }
    }
#endif
    vec3 inverse = safe_inverse(d);
    uint steps = 0u;
    while (s.current != REFERENCE_DONE && steps < frame.step_limit) {
        // Down to a leaf
        while ((s.current & LEAF) == 0u && steps < frame.step_limit) {
            uint w = s.current * NODE_WORDS;
            uvec4 w0 = fetch_nodes(w);
            uvec4 w1 = fetch_nodes(w + 1u);
            uvec4 w2 = fetch_nodes(w + 2u);
            uvec4 w3 = fetch_nodes(w + 3u);
            Node node = node_unpack(w0, w1, w2, w3);
            vec2 r0 = box_range(node.min0, node.max0, o, inverse, s.hit.t);
            vec2 r1 = box_range(node.min1, node.max1, o, inverse, s.hit.t);
            bool enter0 = r0.x <= r0.y;
            bool enter1 = r1.x <= r1.y;
            bool swap = enter1 && (!enter0 || r1.x < r0.x);
            uint near = swap ? node.child1 : node.child0;
            uint far = swap ? node.child0 : node.child1;
            if (enter0 && enter1) {
                traversal_stack[s.depth] = far;
                s.depth += 1u;
            }
            s.current = near;
            if (!enter0 && !enter1) {
                s.depth -= 1u;
                s.current = traversal_stack[s.depth];
            }
            steps += 1u;
        }
        if ((s.current & LEAF) == 0u || s.current == REFERENCE_DONE) continue;
#ifdef HAS_INSTANCES
        // Back to the world
        if (s.current == REFERENCE_LEAVE_INSTANCE) {
            o = origin;
            d = direction;
            inverse = safe_inverse(d);
            s.instance = NONE;
            s.depth -= 1u;
            s.current = traversal_stack[s.depth];
            steps += 1u;
            continue;
        }
        // Into an instance
        if ((s.current & LEAF_INSTANCE) != 0u) {
            uint index = s.current & LEAF_FIRST_MASK;
            Instance entered = instance_fetch(index);
            bool move = entered.in_world == 0u;
            vec3 local_o = move ? object_point(entered, origin) : origin;
            vec3 local_d = move ? object_vector(entered, direction) : direction;
            bool has_tree = entered.kind <= INSTANCE_SOUP;
            if (has_tree) {
                o = local_o;
                d = local_d;
                inverse = safe_inverse(d);
                traversal_stack[s.depth] = REFERENCE_LEAVE_INSTANCE;
                s.depth += 1u;
                s.current = entered.root;
                s.instance = index;
            }
            bool hit = false;
            float t = 0.0;
#ifdef HAS_SPHERES
            if (entered.kind == INSTANCE_SPHERE) hit = sphere_hit(local_o, local_d, s.hit.t, t);
#endif
#ifdef HAS_DISKS
            if (entered.kind == INSTANCE_DISK) hit = disk_hit(local_o, local_d, s.hit.t, t);
#endif
            if (hit) s.hit = Hit(t, NONE, index);
            if (!has_tree) {
                s.depth -= 1u;
                s.current = traversal_stack[s.depth];
            }
            steps += 1u;
#ifdef ANY_HIT
            if (hit) s.current = REFERENCE_DONE;
#endif
            continue;
        }
#endif
        // The triangles of a leaf
        uint first = s.current & LEAF_FIRST_MASK;
        uint end = first + ((s.current >> LEAF_COUNT_SHIFT) & 7u) + 1u;
        bool found = false;
        for (uint i = first; i < end; ++i) {
            uint w = i * TRIANGLE_WORDS;
            Triangle triangle = triangle_unpack(fetch_triangles(w), fetch_triangles(w + 1u), fetch_triangles(w + 2u));
            float t;
            vec2 bary;
            if (triangle_hit(triangle.a, triangle.b, triangle.c, o, d, s.hit.t, t, bary)) {
                s.hit.t = t;
                s.hit.triangle = i;
                found = true;
            }
        }
        if (found) s.hit.instance = s.instance;
        s.depth -= 1u;
        s.current = traversal_stack[s.depth];
#ifdef ANY_HIT
        if (found) s.current = REFERENCE_DONE;
#endif
        steps += end - first;
    }
    return s.current == REFERENCE_DONE;
}

// A ray that ran out of steps, kept in `parked` at its slot: current, depth, instance, hit, stack.
const uint PARKED_HEAD = 6u;

void traversal_park(uint slot, Traversal s)
{
    uint at = slot * (PARKED_HEAD + frame.parked_stack);
    parked[at] = s.current;
    parked[at + 1u] = s.depth;
    parked[at + 2u] = s.instance;
    parked[at + 3u] = floatBitsToUint(s.hit.t);
    parked[at + 4u] = s.hit.triangle;
    parked[at + 5u] = s.hit.instance;
    for (uint i = 0u; i < s.depth; ++i) parked[at + PARKED_HEAD + i] = traversal_stack[i];
}

Traversal traversal_resume(uint slot)
{
    uint at = slot * (PARKED_HEAD + frame.parked_stack);
    Hit hit = Hit(uintBitsToFloat(parked[at + 3u]), parked[at + 4u], parked[at + 5u]);
    Traversal s = Traversal(parked[at], parked[at + 1u], parked[at + 2u], hit);
    for (uint i = 0u; i < s.depth; ++i) traversal_stack[i] = parked[at + PARKED_HEAD + i];
    return s;
}
