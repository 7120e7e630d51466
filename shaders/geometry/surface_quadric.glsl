// From a hit on a sphere or disk to the point on the surface that shading needs.
#include "base/math.glsl"
#include "geometry/instance.glsl"
#include "geometry/surface_point.glsl"

// A point on a unit sphere (longitude about +z from +x, latitude) or unit disk of an instance.
Surface quadric_surface(Instance instance, float t, vec3 origin, vec3 direction)
{
    Surface s;
    vec3 p = object_point(instance, origin) + t * object_vector(instance, direction);
    bool sphere = instance.kind == INSTANCE_SPHERE;
    if (sphere) p = normalize(p); else p.z = 0.0;
    s.uv = sphere ? sphere_uv(p) : disk_uv(p.xy);
    s.object_position = p;
    s.position = world_point(instance, p);
    s.reach = world_reach(instance, 1.0);
    float from_axis = length(p.xy);
    vec2 outward = from_axis > 0.0 ? p.xy / from_axis : vec2(1.0, 0.0);
    // Of length 1 in object space: where the angle grows, and where v grows
    vec3 along_u = vec3(-outward.y, outward.x, 0.0);
    vec3 along_v = sphere ? vec3(-p.z * outward, from_axis) : vec3(-outward, 0.0);
    s.object_dpdu = 2.0 * PI * from_axis * along_u;
    s.object_dpdv = sphere ? PI * along_v : along_v;
    s.dpdu = world_vector(instance, s.object_dpdu);
    s.dpdv = world_vector(instance, s.object_dpdv);
    along_u = world_vector(instance, along_u);
    along_v = world_vector(instance, along_v);
    s.object_rate = 1.0 / length(along_u);
    // A picture is seen squeezed at a pole, not blurred: there u counts as on the equator
    s.uv_rate = vec2(INV_TWO_PI, sphere ? INV_PI : 1.0) / vec2(length(along_u), length(along_v));
    vec3 normal = world_normal(instance, sphere ? p : vec3(0.0, 0.0, 1.0));
    s.geometric = normalize(normal);
    s.normal = s.geometric;
    // The normal of a unit sphere is its point
    s.dndu = sphere ? unit_derivative(normal, world_normal(instance, s.object_dpdu)) : vec3(0.0);
    s.dndv = sphere ? unit_derivative(normal, world_normal(instance, s.object_dpdv)) : vec3(0.0);
    s.tangent = vec4(0.0);
    s.material = instance.material;
    s.light = instance.light;
    s.primitive = 0u;
#ifdef HAS_VERTEX_COLOR
    s.vertex_color = vec4(1.0);
#endif
#ifdef HAS_UV1
    s.uv1 = s.uv;
    s.uv_by_uv1 = mat2(1.0);
#endif
    return s;
}
