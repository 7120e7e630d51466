// A disk: uniform over its area.
#include "light/sample.glsl"

LightSample disk_sample_light(Light light, vec3 from, vec2 u01)
{
    vec2 at = disk_sample(u01);
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = light.a * light_plane_normal(light);
    float pdf = area_to_solid_angle(light.b, from, point, normal);
    return light_surface_point(light, from, pdf, context_at(point, disk_uv(at), normal));
}
