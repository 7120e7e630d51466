// Disks and triangles: uniform over the area.
#include "light/sample.glsl"

LightSample disk_sample_light(Light light, vec3 from, vec2 u01)
{
    vec2 at = disk_sample(u01);
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = light.a * light_plane_normal(light);
    float pdf = area_to_solid_angle(light.b, from, point, normal);
    return light_surface_point(light, from, point, normal, pdf, disk_uv(at));
}

LightSample triangle_sample_light(Light light, vec3 from, vec2 u01)
{
    vec2 at = triangle_sample(u01);
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = light_plane_normal(light);
    vec2 uv = light.uv0 + at.x * light.uv1 + at.y * light.uv2;
    return light_surface_point(light, from, point, normal, area_to_solid_angle(light.b, from, point, normal), uv);
}

float flat_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    return area_to_solid_angle(light.b, from, point, normal);
}
