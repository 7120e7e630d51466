// Ray against triangle, watertight along shared edges and at shared vertices.
#include "base/math.glsl"

// A ray made ready for triangles: axes turned so that z is the one along which it is longest, and x and y sheared so that
// it runs along z (Woop, Benthin and Wald 2013).
struct TriangleRay { vec3 origin; vec3 shear; bool x_major; bool y_major; };

vec3 major_last(vec3 v, bool x_major, bool y_major)
{
    return vec3(x_major ? v.z : v.x, y_major ? v.z : v.y, x_major ? v.x : y_major ? v.y : v.z);
}

TriangleRay triangle_ray(vec3 origin, vec3 direction)
{
    vec3 size = abs(direction);
    bool x_major = size.x >= size.y && size.x >= size.z;
    bool y_major = !x_major && size.y >= size.z;
    vec3 d = major_last(direction, x_major, y_major);
    return TriangleRay(major_last(origin, x_major, y_major), vec3(d.xy, 1.0) / d.z, x_major, y_major);
}

// A vertex goes to the same point of the plane across the ray for every triangle that has it, and the sign of a difference
// of two rounded products is never wrong, only 0 at times. A 0 counts as inside on both sides of an edge: so a ray through a
// closed surface meets one of its triangles at least. `precise` keeps a compiler from fusing a product into a difference.
// Gives t, and the barycentric coordinates of b and c; true when 0 < t < t_max. A triangle without area is never hit.
bool triangle_hit(vec3 a, vec3 b, vec3 c, TriangleRay ray, float t_max, out float t, out vec2 bary)
{
    precise vec3 pa = major_last(a, ray.x_major, ray.y_major) - ray.origin;
    precise vec3 pb = major_last(b, ray.x_major, ray.y_major) - ray.origin;
    precise vec3 pc = major_last(c, ray.x_major, ray.y_major) - ray.origin;
    pa.xy -= ray.shear.xy * pa.z;
    pb.xy -= ray.shear.xy * pb.z;
    pc.xy -= ray.shear.xy * pc.z;
    precise float u = pc.x * pb.y - pc.y * pb.x;
    precise float v = pa.x * pc.y - pa.y * pc.x;
    precise float w = pb.x * pa.y - pb.y * pa.x;
    float sum = u + v + w;
    float inverse = 1.0 / sum;
    bary = vec2(v, w) * inverse;
    // One product after the division, on which all waits; the sum is a float for triangles up to a size of 10¹²
    t = (u * pa.z + v * pb.z + w * pc.z) * inverse * ray.shear.z;
    bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    return inside && sum != 0.0 && t > 0.0 && t < t_max;
}

// Whether a point is behind the plane of a triangle: so is the begin of a ray that meets it from behind.
bool is_behind(vec3 a, vec3 b, vec3 c, vec3 point) { return dot(cross(b - a, c - a), a - point) > 0.0; }
