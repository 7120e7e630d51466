// A ray against the boxes of a node.
#include "shared/bindings.glsl"
#include "geometry/triangle.glsl"

// A ray in the space of the tree that it is in, made ready for boxes and triangles.
struct TreeRay { vec3 origin; vec3 inverse; bvec3 backward; TriangleRay triangles; };

// 1 / direction without infinities, so that a box test never meets 0 · ∞: what is smaller than 10⁻¹² of the longest
// component turns the ray by less than a float can tell.
TreeRay tree_ray(vec3 origin, vec3 direction)
{
    vec3 size = abs(direction);
    float least = max(max(size.x, size.y), max(size.z, 1e-25)) * 1e-12;
    vec3 d = mix(direction, mix(vec3(least), vec3(-least), lessThan(direction, vec3(0.0))), lessThan(size, vec3(least)));
    return TreeRay(origin, 1.0 / d, lessThan(d, vec3(0.0)), triangle_ray(origin, direction));
}

// Without the care for NaN that makes min and max three times as long on lavapipe.
vec4 larger(vec4 a, vec4 b) { return mix(b, a, greaterThan(a, b)); }
vec4 smaller(vec4 a, vec4 b) { return mix(b, a, lessThan(a, b)); }

vec4 byte_values(uint word) { return vec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24); }

// The children that the ray enters, nearest first.
struct OpenChildren { uvec4 nearest; uint count; };

void in_order(inout float near0, inout uint child0, inout float near1, inout uint child1)
{
    bool swap = near1 < near0;
    float near = swap ? near1 : near0;
    uint child = swap ? child1 : child0;
    near1 = swap ? near0 : near1;
    child1 = swap ? child0 : child1;
    near0 = near;
    child0 = child;
}

OpenChildren node_open(Node node, TreeRay ray, float t_max)
{
    // Corner k of an axis is met at t = k · step + start. The bound of its rounding errors goes to the far side of both.
    uvec3 exponents = uvec3(node.exponents, node.exponents >> 8, node.exponents >> 16) & 255u;
    vec3 steps = uintBitsToFloat(exponents << 23) * ray.inverse;
    vec3 start = (node.origin - ray.origin) * ray.inverse;
    vec3 margin = (abs(start) + 255.0 * abs(steps)) * 6e-7;
    vec3 from = start - margin;
    vec3 to = start + margin;
    uvec3 near = mix(node.low, node.high, ray.backward);
    uvec3 far = mix(node.high, node.low, ray.backward);
    vec4 enter = larger(larger(byte_values(near.x) * steps.x + from.x, byte_values(near.y) * steps.y + from.y),
                        larger(vec4(0.0), byte_values(near.z) * steps.z + from.z));
    vec4 leave = smaller(smaller(byte_values(far.x) * steps.x + to.x, byte_values(far.y) * steps.y + to.y),
                         smaller(vec4(t_max), byte_values(far.z) * steps.z + to.z));
    uvec4 code = uvec4(node.children << 24, node.children << 16, node.children << 8, node.children);
    uvec4 child = (code & 0xf0000000u) | (node.base + ((code >> 24) & CHILD_OFFSET_MASK));
    // Every node has two children at least
    bvec4 open = lessThanEqual(enter, leave);
    open = bvec4(open.x, open.y, open.z && code.z < 0xff000000u, open.w && code.w < 0xff000000u);
    vec4 t = mix(vec4(FAR), enter, open);
    uint count = uint(open.x) + uint(open.y) + uint(open.z) + uint(open.w);
    in_order(t.x, child.x, t.y, child.y);
    in_order(t.z, child.z, t.w, child.w);
    in_order(t.x, child.x, t.z, child.z);
    in_order(t.y, child.y, t.w, child.w);
    in_order(t.y, child.y, t.z, child.z);
    return OpenChildren(child, count);
}
