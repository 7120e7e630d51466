// Disks and triangles: uniform over the area.
#include "light/sample.glsl"

LightSample disk_sample_light(Light light, vec3 from, vec2 u01)
{
    vec2 at = disk_sample(u01);
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = normalize(cross(light.edge_u, light.edge_v));
    // On the unit disk of the object: the edges of a mirrored one have changed places
    vec2 on_disk = at.x * light.uv1 + at.y * light.uv2;
    float phi = atan(on_disk.y, on_disk.x) * INV_TWO_PI;
    vec2 uv = vec2(phi < 0.0 ? phi + 1.0 : phi, 1.0 - length(at));
    return light_surface_point(light, from, point, normal, area_to_solid_angle(light.b, from, point, normal), uv);
}

LightSample triangle_sample_light(Light light, vec3 from, vec2 u01)
{
    vec2 at = triangle_sample(u01);
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = normalize(cross(light.edge_u, light.edge_v));
    vec2 uv = light.uv0 + at.x * light.uv1 + at.y * light.uv2;
    return light_surface_point(light, from, point, normal, area_to_solid_angle(light.b, from, point, normal), uv);
}

float flat_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    return area_to_solid_angle(light.b, from, point, normal);
}
