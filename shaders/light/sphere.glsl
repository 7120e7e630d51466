// A sphere seen from outside: uniform over the cone that it fills. From inside: uniform over its area.
#include "light/sample.glsl"

// 1 − cos of the half-angle of the cone, without cancellation for a small sphere (pbrt-v4, section 6.2.4).
float sphere_cone(float sin2_max)
{
    return sin2_max < 0.00068523 ? 0.5 * sin2_max : 1.0 - safe_sqrt(1.0 - sin2_max);
}

LightSample sphere_sample_light(Light light, vec3 from, vec2 u01)
{
    vec3 axis = light.position - from;
    float d2 = dot(axis, axis);
    float radius = light.a;
    if (d2 <= sqr(radius) * 1.0001) {
        vec3 n = sphere_sample(u01);
        vec3 point = light.position + radius * n;
        return light_surface_point(light, from, point, n, area_to_solid_angle(light.b, from, point, n), vec2(0.0));
    }
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
    float phi = 2.0 * PI * u01.y;
    vec3 towards = -axis * inversesqrt(d2);
    vec3 n = basis_to_world(basis_around(towards), vec3(sin_alpha * cos(phi), sin_alpha * sin(phi), cos_alpha));
    return light_surface_point(light, from, light.position + radius * n, n, INV_TWO_PI / one_minus_cos_max, vec2(0.0));
}

float sphere_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    vec3 axis = light.position - from;
    float d2 = dot(axis, axis);
    if (d2 <= sqr(light.a) * 1.0001) return area_to_solid_angle(light.b, from, point, normal);
    return INV_TWO_PI / sphere_cone(sqr(light.a) / d2);
}
