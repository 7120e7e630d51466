// From a hit on a sphere, disk or tube, or on a part of one, to the point on the surface that shading needs.
#include "base/math.glsl"
#include "geometry/instance.glsl"
#include "geometry/shape.glsl"
#include "geometry/surface_point.glsl"

// A point on the unit shape and its derivatives in object space. Where the angle grows and where v grows are of length 1.
struct QuadricPoint { vec3 p; vec2 uv; vec2 uv_length; vec3 along_u; vec3 along_v; vec3 normal; vec3 dndu; vec3 dndv; };

// On a unit sphere: longitude about +z from +x, and latitude; on a unit disk; on a tube of radius 1 about z from 0 to 1.
QuadricPoint quadric_point(Instance instance, vec3 p)
{
    bool sphere = instance.kind == INSTANCE_SPHERE;
#ifdef HAS_PARTS
    sphere = sphere || instance.kind == INSTANCE_SPHERE_PART;
    bool tube = instance.kind == INSTANCE_CYLINDER;
#else
    const bool tube = false;
#endif
    if (sphere) p = normalize(p);
    else if (tube) p = vec3(normalize(p.xy), clamp(p.z, 0.0, 1.0));
    else p.z = 0.0;
    QuadricPoint point;
    point.p = p;
    point.uv = sphere ? sphere_uv(p) : tube ? vec2(turns(p.xy), p.z) : disk_uv(p.xy);
    // What u and v grow by along their directions, at the equator
    point.uv_length = vec2(2.0 * PI, sphere ? PI : 1.0);
#ifdef HAS_PARTS
    if (is_part(instance)) {
        QuadricPart part = part_fetch(instance.root);
        float v = part.v_range > 0.0 ? (point.uv.y - part.v_min) / part.v_range : 0.0;
        point.uv = vec2(min(point.uv.x / part.turn, 1.0), clamp(v, 0.0, 1.0));
        point.uv_length *= vec2(part.turn, part.v_range);
    }
#endif
    float from_axis = length(p.xy);
    vec2 outward = from_axis > 0.0 ? p.xy / from_axis : vec2(1.0, 0.0);
    point.along_u = vec3(-outward.y, outward.x, 0.0);
    point.along_v = sphere ? vec3(-p.z * outward, from_axis) : tube ? vec3(0.0, 0.0, 1.0) : vec3(-outward, 0.0);
    // The normal of a unit sphere is its point, that of a tube the point on its circle
    point.normal = sphere ? p : tube ? vec3(outward, 0.0) : vec3(0.0, 0.0, 1.0);
    point.dndu = sphere || tube ? point.uv_length.x * from_axis * point.along_u : vec3(0.0);
    point.dndv = sphere ? point.uv_length.y * point.along_v : vec3(0.0);
    return point;
}

Surface quadric_surface(Instance instance, float t, vec3 origin, vec3 direction)
{
    QuadricPoint point = quadric_point(instance, object_point(instance, origin) + t * object_vector(instance, direction));
    Surface s;
    s.uv = point.uv;
    s.object_position = point.p;
    s.position = world_point(instance, point.p);
    s.reach = world_reach(instance, 1.0);
    s.object_dpdu = point.uv_length.x * length(point.p.xy) * point.along_u;
    s.object_dpdv = point.uv_length.y * point.along_v;
    s.dpdu = world_vector(instance, s.object_dpdu);
    s.dpdv = world_vector(instance, s.object_dpdv);
    vec3 along_u = world_vector(instance, point.along_u);
    vec3 along_v = world_vector(instance, point.along_v);
    s.object_rate = 1.0 / length(along_u);
    // A picture is seen squeezed at a pole, not blurred: there u counts as on the equator
    s.uv_rate = 1.0 / (point.uv_length * vec2(length(along_u), length(along_v)));
    vec3 normal = world_normal(instance, point.normal);
    s.geometric = normalize(normal);
    s.normal = s.geometric;
    s.dndu = unit_derivative(normal, world_normal(instance, point.dndu));
    s.dndv = unit_derivative(normal, world_normal(instance, point.dndv));
    s.tangent = vec4(0.0);
    s.material = instance.material;
    s.light = instance.light;
    s.primitive = 0u;
    plain_corners(s);
    return s;
}
