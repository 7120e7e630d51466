// Rays against tubes and against parts of spheres and disks.
#include "shared/bindings.glsl"
#include "geometry/quadric.glsl"

QuadricPart part_fetch(uint w) { return quadric_part_unpack(fetch_instances(w), fetch_instances(w + 1u)); }

// Whether a point of the whole shape is on the part that there is.
bool part_has(QuadricPart part, uint kind, vec3 p)
{
    float r2 = dot(p.xy, p.xy);
    bool in_ring = kind != INSTANCE_DISK_PART || (r2 <= 1.0 && r2 >= sqr(part.inner_radius));
    return p.z >= part.z_min && p.z <= part.z_max && in_ring && turns(p.xy) <= part.turn;
}

// Nearest t_min < t < t_max: of both roots the nearer that is on the part.
bool part_hit(QuadricPart part, uint kind, vec3 origin, vec3 direction, float t_min, float t_max, out float t)
{
    // A tube is a circle, seen along its axis
    vec3 kept = kind == INSTANCE_CYLINDER ? vec3(1.0, 1.0, 0.0) : vec3(1.0);
    vec3 d = direction * kept;
    bool crosses = dot(d, d) > 0.0;
    Roots roots = sphere_roots(origin * kept, crosses ? d : vec3(1.0, 0.0, 0.0));
    if (kind == INSTANCE_DISK_PART) {
        float plane = disk_distance(origin, direction);
        roots = Roots(plane, plane, direction.z != 0.0);
    }
    bool near = roots.near > t_min && part_has(part, kind, origin + roots.near * direction);
    bool far = roots.far > t_min && part_has(part, kind, origin + roots.far * direction);
    t = near ? roots.near : roots.far;
    return roots.real && crosses && (near || far) && t < t_max;
}
