// Rays through the two levels of trees. Switches of the variant: HAS_INSTANCES (there is a tree over instances; else
// the root is that of the triangles in world space), HAS_SPHERES, HAS_DISKS, ANY_HIT (stop at the first hit).
//
// A ray takes at most `frame.step_limit` steps at once, then it is parked and resumed by a later dispatch: Mesa before
// 25.0 leaves loops after 65,535 rounds.
#include "shared/bindings.glsl"
#include "geometry/instance.glsl"
#include "geometry/quadric.glsl"
#include "geometry/triangle.glsl"

struct Hit { float t; uint triangle; uint instance; };

// References besides those of nodes and leaves.
const uint REFERENCE_DONE = 0xffffffffu;
const uint REFERENCE_LEAVE_INSTANCE = 0xfffffffeu;

// A ray in the space of the tree that it is in, made ready for box tests.
struct TreeRay { vec3 origin; vec3 direction; vec3 inverse; bvec3 backward; };

// 1 / direction without infinities, so that a box test never meets 0 · ∞.
TreeRay tree_ray(vec3 origin, vec3 direction)
{
    const float tiny = 1e-25;
    vec3 d = vec3(abs(direction.x) < tiny ? tiny : direction.x, abs(direction.y) < tiny ? tiny : direction.y,
                  abs(direction.z) < tiny ? tiny : direction.z);
    return TreeRay(origin, direction, 1.0 / d, lessThan(d, vec3(0.0)));
}

// Entry and exit distance of a box; the exit is widened by the rounding of the test (Ize 2013).
vec2 box_range(vec3 low, vec3 high, TreeRay ray, float t_max)
{
    vec3 near = (mix(low, high, ray.backward) - ray.origin) * ray.inverse;
    vec3 far = (mix(high, low, ray.backward) - ray.origin) * ray.inverse;
    return vec2(max(max(near.x, near.y), max(near.z, 0.0)), min(min(far.x, far.y), min(far.z, t_max)) * 1.00000036);
}

// The state of a ray that ran out of steps is kept in `parked`: current reference, depth of the stack, instance, hit,
// then the stack.
const uint PARKED_HEAD = 6u;

uint parked_at(uint place) { return place * (PARKED_HEAD + frame.parked_stack); }

// Follows a ray, from `hit.t` = t_max, or from where it was parked at `place`. True when it is finished; else it is
// parked there.
bool traverse(vec3 origin, vec3 direction, bool resumed, uint place, inout Hit hit)
{
    uint stack[TRAVERSAL_STACK];
    stack[0] = REFERENCE_DONE;
    uint depth = 1u;
    uint current = frame.root;
    uint instance = NONE;
    uint limit = frame.step_limit;
    if (resumed) {
        uint at = parked_at(place);
        current = parked[at];
        depth = parked[at + 1u];
        instance = parked[at + 2u];
        hit = Hit(uintBitsToFloat(parked[at + 3u]), parked[at + 4u], parked[at + 5u]);
        for (uint i = 0u; i < depth; ++i) stack[i] = parked[at + PARKED_HEAD + i];
    }
    TreeRay ray = tree_ray(origin, direction);
#ifdef HAS_INSTANCES
    if (instance != NONE) {
        Instance entered = instance_fetch(instance);
        if (entered.in_world == 0u) ray = tree_ray(object_point(entered, origin), object_vector(entered, direction));
    }
#endif
    uint steps = 0u;
    while (current != REFERENCE_DONE && steps < limit) {
        // Down to a leaf
        while ((current & LEAF) == 0u && steps < limit) {
            uint w = current * NODE_WORDS;
            Node node = node_unpack(fetch_nodes(w), fetch_nodes(w + 1u), fetch_nodes(w + 2u), fetch_nodes(w + 3u));
            vec2 range0 = box_range(node.min0, node.max0, ray, hit.t);
            vec2 range1 = box_range(node.min1, node.max1, ray, hit.t);
            bool enter0 = range0.x <= range0.y;
            bool enter1 = range1.x <= range1.y;
            bool swap = enter1 && (!enter0 || range1.x < range0.x);
            current = swap ? node.child1 : node.child0;
            if (enter0 && enter1) {
                stack[depth] = swap ? node.child0 : node.child1;
                depth += 1u;
            }
            if (!enter0 && !enter1) {
                depth -= 1u;
                current = stack[depth];
            }
            steps += 1u;
        }
        if ((current & LEAF) == 0u || current == REFERENCE_DONE) continue;
        bool found = false;
#ifdef HAS_INSTANCES
        bool leaves = current == REFERENCE_LEAVE_INSTANCE;
        bool enters = !leaves && (current & LEAF_INSTANCE) != 0u;
        if (leaves) {
            ray = tree_ray(origin, direction);
            instance = NONE;
        }
        if (enters) {
            uint index = current & LEAF_FIRST_MASK;
            Instance entered = instance_fetch(index);
            bool move = entered.in_world == 0u;
            TreeRay local = tree_ray(move ? object_point(entered, origin) : origin,
                                     move ? object_vector(entered, direction) : direction);
            float t = 0.0;
#ifdef HAS_SPHERES
            if (entered.kind == INSTANCE_SPHERE) found = sphere_hit(local.origin, local.direction, hit.t, t);
#endif
#ifdef HAS_DISKS
            if (entered.kind == INSTANCE_DISK) found = disk_hit(local.origin, local.direction, hit.t, t);
#endif
            if (found) hit = Hit(t, NONE, index);
            // Into its tree, with a mark on the stack for the way back
            if (entered.kind <= INSTANCE_SOUP) {
                ray = local;
                instance = index;
                stack[depth] = REFERENCE_LEAVE_INSTANCE;
                stack[depth + 1u] = entered.root;
                depth += 2u;
            }
        }
        bool triangles = !leaves && !enters;
#else
        const bool triangles = true;
#endif
        // The triangles of a leaf
        uint first = current & LEAF_FIRST_MASK;
        uint end = triangles ? first + ((current >> LEAF_COUNT_SHIFT) & 7u) + 1u : first;
        for (uint i = first; i < end; ++i) {
            uint w = i * TRIANGLE_WORDS;
            Triangle triangle = triangle_unpack(fetch_triangles(w), fetch_triangles(w + 1u), fetch_triangles(w + 2u));
            float t;
            vec2 bary;
            if (triangle_hit(triangle.a, triangle.b, triangle.c, ray.origin, ray.direction, hit.t, t, bary)) {
                hit = Hit(t, i, instance);
                found = true;
            }
        }
        steps += end - first + 1u;
        depth -= 1u;
        current = stack[depth];
#ifdef ANY_HIT
        if (found) current = REFERENCE_DONE;
#endif
    }
    if (current == REFERENCE_DONE) return true;
    uint at = parked_at(place);
    parked[at] = current;
    parked[at + 1u] = depth;
    parked[at + 2u] = instance;
    parked[at + 3u] = floatBitsToUint(hit.t);
    parked[at + 4u] = hit.triangle;
    parked[at + 5u] = hit.instance;
    for (uint i = 0u; i < depth; ++i) parked[at + PARKED_HEAD + i] = stack[i];
    return false;
}
