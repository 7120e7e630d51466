// Ray against triangle, watertight along shared edges and at shared vertices.
#include "base/math.glsl"

// Edge functions in the plane across the ray (Woop, Benthin and Wald 2013; their shear is a rotation here). A vertex goes
// to the same point of that plane for every triangle that has it, and the sign of a difference of two rounded products is
// never wrong, only 0 at times. A 0 counts as inside on both sides of an edge: so a ray through a closed surface meets one
// of its triangles at least. `precise` keeps a compiler from fusing a product into the difference, which would undo that.
// Gives t, and the barycentric coordinates of b and c; true when 0 < t < t_max. A triangle without area is never hit.
bool triangle_hit(vec3 a, vec3 b, vec3 c, vec3 origin, vec3 direction, float t_max, out float t, out vec2 bary)
{
    float scale = inversesqrt(dot(direction, direction));
    Basis across = basis_around(direction * scale);
    precise vec3 pa = basis_to_local(across, a - origin);
    precise vec3 pb = basis_to_local(across, b - origin);
    precise vec3 pc = basis_to_local(across, c - origin);
    precise float u = pc.x * pb.y - pc.y * pb.x;
    precise float v = pa.x * pc.y - pa.y * pc.x;
    precise float w = pb.x * pa.y - pb.y * pa.x;
    float inverse = 1.0 / (u + v + w);
    bary = vec2(v, w) * inverse;
    t = (u * pa.z + v * pb.z + w * pc.z) * inverse * scale;
    bool inside = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    return inside && u + v + w != 0.0 && t > 0.0 && t < t_max;
}
