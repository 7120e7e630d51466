// A sphere seen from outside: uniform over the cone that it fills. From inside, and an ellipsoid (radius 0 in its
// record): the image of a uniform choice on the unit sphere.
#include "light/sample.glsl"

// 1 − cos of the half-angle of the cone, without cancellation for a small sphere (pbrt-v4, section 6.2.4).
float sphere_cone(float sin2_max)
{
    return sin2_max < 0.00068523 ? 0.5 * sin2_max : 1.0 - safe_sqrt(1.0 - sin2_max);
}

// The cofactors of the map from the unit sphere to the light: inverse · determinant, and the transpose of that. They are
// those of its axes in units of `size`, whose cube may be beyond a float.
struct SphereMap { vec3 vw; vec3 wu; vec3 uv; float determinant; float size; };

SphereMap sphere_map(Light light)
{
    vec3 w = vec3(light.uv0, light.uv1.x);
    float size = max_component(max(abs(light.edge_u), max(abs(light.edge_v), abs(w))));
    vec3 u = light.edge_u / size;
    vec3 v = light.edge_v / size;
    w /= size;
    vec3 vw = cross(v, w);
    return SphereMap(vw, cross(w, u), cross(u, v), dot(u, vw), size);
}

// The point of the unit sphere that `offset` from the centre comes from.
vec3 sphere_object_point(SphereMap map, vec3 offset)
{
    offset /= map.size;
    return vec3(dot(map.vw, offset), dot(map.wu, offset), dot(map.uv, offset)) / map.determinant;
}

// Normal of the light at the image of `n`; `growth` is by how much the area grows there.
vec3 sphere_normal(SphereMap map, vec3 n, out float growth)
{
    vec3 scaled = map.vw * n.x + map.wu * n.y + map.uv * n.z;
    float size = length(scaled);
    growth = size * sqr(map.size);
    return scaled / (map.determinant < 0.0 ? -size : size);
}

LightSample ellipsoid_sample_light(Light light, SphereMap map, vec3 from, vec2 u01)
{
    vec3 n = sphere_sample(u01);
    vec3 point = light.position + light.edge_u * n.x + light.edge_v * n.y + vec3(light.uv0, light.uv1.x) * n.z;
    float growth;
    vec3 normal = sphere_normal(map, n, growth);
    float pdf = area_to_solid_angle(4.0 * PI * growth, from, point, normal);
    return light_surface_point(light, from, pdf, context_at(point, sphere_uv(n), normal));
}

LightSample sphere_sample_light(Light light, vec3 from, vec2 u01)
{
    SphereMap map = sphere_map(light);
    vec3 axis = light.position - from;
    float d2 = dot(axis, axis);
    float radius = light.a;
    if (radius == 0.0 || d2 <= sqr(radius) * 1.0001) return ellipsoid_sample_light(light, map, from, u01);
    float sin2_max = sqr(radius) / d2;
    float one_minus_cos_max = sphere_cone(sin2_max);
    float one_minus_cos = u01.x * one_minus_cos_max;
    float cos_theta = 1.0 - one_minus_cos;
    float sin2 = one_minus_cos * (1.0 + cos_theta);
    // The angle at the centre, from the angle at the receiver. Its sine by the way to the point, (d² − r²) / (d cos θ + …),
    // because near the sphere its cosine is next to 1
    float root = safe_sqrt(1.0 - sin2 / sin2_max);
    float cos_alpha = sin2 * inversesqrt(sin2_max) + cos_theta * root;
    float sin_alpha = sqrt(sin2) * (d2 - sqr(radius)) / (radius * (sqrt(d2) * cos_theta + radius * root));
    vec3 towards = -axis * inversesqrt(d2);
    vec3 n = basis_to_world(basis_around(towards), vec3(sin_alpha * circle_point(2.0 * PI * u01.y), cos_alpha));
    vec2 uv = sphere_uv(sphere_object_point(map, radius * n));
    return light_surface_point(light, from, INV_TWO_PI / one_minus_cos_max, context_at(light.position + radius * n, uv, n));
}

float sphere_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    vec3 axis = light.position - from;
    float d2 = dot(axis, axis);
    if (light.a > 0.0 && d2 > sqr(light.a) * 1.0001) return INV_TWO_PI / sphere_cone(sqr(light.a) / d2);
    SphereMap map = sphere_map(light);
    float growth;
    sphere_normal(map, sphere_object_point(map, point - light.position), growth);
    return area_to_solid_angle(4.0 * PI * growth, from, point, normal);
}
