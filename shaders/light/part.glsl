// Tubes, and parts of spheres and disks: the image of a uniform choice on the unit shape, which is uniform over the area where
// the map to the world stretches nothing.
#include "light/sphere.glsl"

// Area of the part of the unit shape.
float part_area(Light light)
{
    float turn = 2.0 * PI * light.uv1.y;
    switch (light.kind) {
    case LIGHT_SPHERE_PART: return turn * (light.uv2.y - light.uv2.x);
    case LIGHT_DISK_PART: return 0.5 * turn * (1.0 - sqr(light.uv2.x));
    default: return turn;
    }
}

// Its normal at a point.
vec3 part_normal(Light light, vec3 p)
{
    switch (light.kind) {
    case LIGHT_SPHERE_PART: return normalize(p);
    case LIGHT_DISK_PART: return vec3(0.0, 0.0, 1.0);
    default: return vec3(normalize(p.xy), 0.0);
    }
}

vec3 part_point(Light light, vec2 u01)
{
    float z = light.kind == LIGHT_SPHERE_PART ? mix(light.uv2.x, light.uv2.y, u01.x) : light.kind == LIGHT_CYLINDER ? u01.x : 0.0;
    float r = 1.0;
    if (light.kind == LIGHT_SPHERE_PART) r = safe_sqrt(1.0 - z * z);
    if (light.kind == LIGHT_DISK_PART) r = sqrt(mix(sqr(light.uv2.x), 1.0, u01.x));
    return vec3(r * circle_point(2.0 * PI * light.uv1.y * u01.y), z);
}

// u and v as the surface has them.
vec2 part_light_uv(Light light, vec3 p, vec2 u01)
{
    float v = p.z;
    if (light.kind == LIGHT_DISK_PART) v = (1.0 - length(p.xy)) / (1.0 - light.uv2.x);
    if (light.kind == LIGHT_SPHERE_PART) {
        vec2 ends = vec2(latitude_v(light.uv2.x, safe_sqrt(1.0 - sqr(light.uv2.x))), latitude_v(light.uv2.y, safe_sqrt(1.0 - sqr(light.uv2.y))));
        v = (latitude_v(p.z, length(p.xy)) - ends.x) / (ends.y - ends.x);
    }
    return vec2(u01.y, clamp(v, 0.0, 1.0));
}

LightSample part_sample_light(Light light, vec3 from, vec2 u01)
{
    SphereMap map = sphere_map(light);
    vec3 p = part_point(light, u01);
    vec3 point = light.position + light.edge_u * p.x + light.edge_v * p.y + vec3(light.uv0, light.uv1.x) * p.z;
    float growth;
    vec3 normal = sphere_normal(map, part_normal(light, p), growth);
    float pdf = area_to_solid_angle(part_area(light) * growth, from, point, normal);
    return light_surface_point(light, from, pdf, context_at(point, part_light_uv(light, p, u01), normal));
}

float part_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    SphereMap map = sphere_map(light);
    float growth;
    sphere_normal(map, part_normal(light, sphere_object_point(map, point - light.position)), growth);
    return area_to_solid_angle(part_area(light) * growth, from, point, normal);
}
