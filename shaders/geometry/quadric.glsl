// Ray against the unit sphere about the origin, and the unit disk in z = 0.
#include "base/math.glsl"

// Nearest t_min < t < t_max, by the stable form of the quadratic (pbrt-v4, section 6.8.2). A root within rounding of a ray
// that starts on the surface is told by the origin: `offset_ray_origin` has put it on its side. The direction is as long as
// the sphere is small, so the quadratic is solved along its unit vector: a float may not hold the square of t.
bool sphere_hit(vec3 origin, vec3 direction, float t_min, float t_max, out float t)
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
    float near = min(q, other) / size;
    float far = max(q, other) / size;
    t = near > t_min ? near : far;
    return discriminant >= 0.0 && t > t_min && t < t_max;
}

bool disk_hit(vec3 origin, vec3 direction, float t_min, float t_max, out float t)
{
    t = -origin.z / direction.z;
    vec2 p = origin.xy + t * direction.xy;
    return direction.z != 0.0 && t > t_min && t < t_max && dot(p, p) <= 1.0;
}
