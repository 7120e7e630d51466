// Ray against triangle, watertight along shared edges.
#include "base/math.glsl"

// Edge functions by Plücker coordinates about the ray's origin (Platis and Theoharis 2003). Both triangles at an edge
// compute the same number with opposite sign, to the bit, so a ray cannot slip between them; an exact 0 counts for
// both. `precise` keeps a compiler from contracting the two differently. Gives t, and the barycentric coordinates of
// b and c; true when 0 < t < t_max. A triangle without area is never hit.
bool triangle_hit(vec3 a, vec3 b, vec3 c, vec3 origin, vec3 direction, float t_max, out float t, out vec2 bary)
{
    vec3 va = a - origin;
    vec3 vb = b - origin;
    vec3 vc = c - origin;
    vec3 eb = vc - va;
    vec3 ec = va - vb;
    vec3 ea = vb - vc;
    precise float u = dot(cross(eb, vc + va), direction);
    precise float v = dot(cross(ec, va + vb), direction);
    precise float w = dot(cross(ea, vb + vc), direction);
    vec3 normal = cross(ec, eb);
    float denominator = dot(normal, direction);
    t = dot(va, normal) / denominator;
    float inverse = 1.0 / (u + v + w);
    bary = vec2(u, v) * inverse;
    bool inside = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    return inside && denominator != 0.0 && t > 0.0 && t < t_max;
}
