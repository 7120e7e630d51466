// Ray against the unit sphere about the origin, and the unit disk in z = 0.
#include "base/math.glsl"

// Both roots of a ray, by the stable form of the quadratic (pbrt-v4, section 6.8.2); of no use when they are not real.
struct Roots { float near; float far; bool real; };

// The direction is as long as the sphere is small, so the quadratic is solved along its unit vector: a float may not hold the
// square of t.
Roots sphere_roots(vec3 origin, vec3 direction)
{
    float size = length(direction);
    vec3 unit = direction / size;
    float b = dot(origin, unit);
    vec3 closest = origin - b * unit;
    float discriminant = 1.0 - dot(closest, closest);
    float root = safe_sqrt(discriminant);
    float c = dot(origin, origin) - 1.0;
    float q = b < 0.0 ? -b + root : -b - root;
    float other = q != 0.0 ? c / q : 0.0;
    return Roots(min(q, other) / size, max(q, other) / size, discriminant >= 0.0);
}

// Nearest t_min < t < t_max. A root within rounding of a ray that starts on the surface is told by the origin:
// `offset_ray_origin` has put it on its side.
bool sphere_hit(vec3 origin, vec3 direction, float t_min, float t_max, out float t)
{
    Roots roots = sphere_roots(origin, direction);
    t = roots.near > t_min ? roots.near : roots.far;
    return roots.real && t > t_min && t < t_max;
}

float disk_distance(vec3 origin, vec3 direction) { return -origin.z / direction.z; }

bool disk_hit(vec3 origin, vec3 direction, float t_min, float t_max, out float t)
{
    t = disk_distance(origin, direction);
    vec2 p = origin.xy + t * direction.xy;
    return direction.z != 0.0 && t > t_min && t < t_max && dot(p, p) <= 1.0;
}
