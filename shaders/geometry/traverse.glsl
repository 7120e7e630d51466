// Rays through the two levels of trees. Switches of the variant: HAS_INSTANCES (there is a tree over instances; else
// the root is that of the triangles in world space), HAS_OPACITY (some surfaces let rays through), HAS_FRONT_ONLY (some
// triangles are not there from behind), ANY_HIT (stop at the first hit), PARKING, and those of the menu of shapes.
//
// A ray takes at most `frame.step_limit` steps at once: Mesa before 25.0 leaves loops after 65,535 rounds. A step takes up
// to ROUNDS_A_STEP of them.
#include "shared/bindings.glsl"
#include "geometry/instance.glsl"
#include "geometry/shape.glsl"
#include "geometry/triangle.glsl"
#include "geometry/walk.glsl"
#include "geometry/node.glsl"
#ifdef PARKING
#include "geometry/park.glsl"
#endif
#ifdef HAS_OPACITY
#include "geometry/passing.glsl"
#endif

// Follows a ray, from `hit.t` = t_max. True when it is finished. Else it ran out of steps: with PARKING it is parked at
// `place` and goes on from there when `resumed`; without, `hit` is of no use.
bool traverse(vec3 origin, vec3 direction, bool resumed, uint place, inout Passing passing, inout Hit hit)
{
    uint stack[TRAVERSAL_STACK];
    stack[0] = REFERENCE_DONE;
    Walk walk = Walk(frame.root, 1u, NONE, hit);
    uint limit = frame.step_limit;
    TreeRay ray = tree_ray(origin, direction);
#ifdef PARKING
    if (resumed) {
        walk = parked_walk(place);
        passing.through = parked_through(place);
        for (uint i = 0u; i < walk.depth; ++i) stack[i] = parked_entry(place, i);
    }
#ifdef HAS_INSTANCES
    if (walk.instance != NONE) {
        Instance entered = instance_fetch(walk.instance);
        if (entered.kind != INSTANCE_SOUP) ray = tree_ray(object_point(entered, origin), object_vector(entered, direction));
    }
#endif
#endif
    Hit candidate = NO_HIT;
    uint steps = 0u;
    while (walk.current != REFERENCE_DONE && steps < limit) {
        // One step is a node or a triangle: the same words are read as both, since on lavapipe a branch that not all
        // lanes take costs as much as both of its sides.
        while (is_in_tree(walk.current) && !is_hit(candidate) && steps < limit) {
            bool leaf = (walk.current & LEAF) != 0u;
            uint item = walk.current & LEAF_FIRST_MASK;
            uint word = item * ITEM_WORDS;
            uvec4 w0 = fetch_tree(word);
            uvec4 w1 = fetch_tree(word + 1u);
            uvec4 w2 = fetch_tree(word + 2u);
            Node node = node_unpack(w0, w1, w2);
            Triangle triangle = triangle_unpack(w0, w1, w2);
            OpenChildren children = node_open(node, ray, walk.hit.t);
            float t;
            vec2 bary;
            bool found = triangle_hit(triangle.a, triangle.b, triangle.c, ray.triangles, walk.hit.t, t, bary) && leaf;
#ifdef HAS_FRONT_ONLY
            bool behind = is_behind(triangle.a, triangle.b, triangle.c, ray.origin);
            found = found && !(behind && (triangle.primitive & PRIMITIVE_FRONT_ONLY) != 0u);
#endif
#ifdef HAS_OPACITY
            // A triangle that may let the ray through is looked at outside of this loop
            if (found && (triangle.primitive & PRIMITIVE_LETS_THROUGH) != 0u) {
                candidate = t > passing.t_min ? Hit(t, item, walk.instance) : NO_HIT;
                found = false;
            }
#endif
            walk.hit.t = found ? t : walk.hit.t;
            walk.hit.triangle = found ? item : walk.hit.triangle;
            walk.hit.instance = found ? walk.instance : walk.hit.instance;
            // The next triangle of the leaf, the nearest child, or what is on top of the stack
            bool last = (walk.current & LEAF_COUNT_MASK) == 0u;
            bool pop = leaf ? last : children.count == 0u;
            uint next = leaf ? walk.current + 1u - (1u << LEAF_COUNT_SHIFT) : children.nearest.x;
            // The others wait, the farthest lowest. A loop, since a store that no lane needs costs as much as any
            uint others = leaf ? 0u : max(children.count, 1u) - 1u;
            uint entry = others == 3u ? children.nearest.w : others == 2u ? children.nearest.z : children.nearest.y;
            for (uint k = 0u; k < others; ++k) {
                stack[walk.depth + k] = entry;
                entry = others - k == 3u ? children.nearest.z : children.nearest.y;
            }
            uint top = stack[walk.depth - 1u];
            walk.current = pop ? top : next;
            walk.depth = pop ? walk.depth - 1u : walk.depth + others;
            steps += 1u; COUNT_TEST
#ifdef ANY_HIT
            if (found) walk.current = REFERENCE_DONE;
#endif
        }
#ifdef HAS_INSTANCES
        bool ready = !is_hit(candidate);
        bool leaves = ready && walk.current == REFERENCE_LEAVE_INSTANCE;
        bool enters = ready && !is_in_tree(walk.current) && walk.current < REFERENCE_LEAVE_INSTANCE;
        bool pop = leaves || enters;
        bool found = false;
        if (leaves) {
            ray = tree_ray(origin, direction);
            walk.instance = NONE;
        }
        if (enters) { COUNT_TEST
            uint index = fetch_tree((walk.current & LEAF_FIRST_MASK) * ITEM_WORDS).x;
            Instance entered = instance_fetch(index);
            bool move = entered.kind != INSTANCE_SOUP;
            vec3 o = move ? object_point(entered, origin) : origin;
            vec3 d = move ? object_vector(entered, direction) : direction;
            float t = 0.0;
#ifdef HAS_SHAPES
            found = shape_hit(entered, o, d, passing.t_min, walk.hit.t, t);
#endif
#ifdef HAS_OPACITY
            if (found) candidate = Hit(t, NONE, index);
            found = false;
#endif
            if (found) walk.hit = Hit(t, NONE, index);
            // Into its tree, with a mark on the stack for the way back
            if (entered.kind <= INSTANCE_SOUP) {
                ray = tree_ray(o, d);
                walk.instance = index;
                stack[walk.depth] = REFERENCE_LEAVE_INSTANCE;
                walk.depth += 1u;
                walk.current = entered.root;
                pop = false;
            }
        }
        if (pop) {
            walk.depth -= 1u;
            walk.current = stack[walk.depth];
        }
#ifdef ANY_HIT
        if (found) walk.current = REFERENCE_DONE;
#endif
        steps += 1u;
#endif
#ifdef HAS_OPACITY
        passing_decide(passing, walk, candidate, origin, direction);
        candidate = NO_HIT;
#endif
    }
    hit = walk.hit;
    if (walk.current == REFERENCE_DONE) return true;
#ifdef PARKING
    park(place, walk);
    park_through(place, passing.through);
    for (uint i = 0u; i < walk.depth; ++i) park_entry(place, i, stack[i]);
#endif
    return false;
}
