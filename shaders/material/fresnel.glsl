// How much a boundary reflects.
#include "base/math.glsl"

// Unpolarised reflectance of a dielectric; eta = index behind the surface over index in front, cos_i >= 0 in front.
// 1 under total internal reflection (pbrt-v4, section 9.3.5).
float fresnel_dielectric(float cos_i, float eta)
{
    float sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1.0) return 1.0;
    float cos_t = safe_sqrt(1.0 - sin2_t);
    float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// Unpolarised reflectance of a conductor with index η + i k, per channel (Pharr et al., section 9.3.6, written without
// complex numbers as in S. Lagarde, "Memo on Fresnel equations", 2013).
vec3 fresnel_conductor(float cos_i, vec3 eta, vec3 k)
{
    float cos2 = cos_i * cos_i;
    float sin2 = 1.0 - cos2;
    vec3 t0 = eta * eta - k * k - sin2;
    vec3 a2_plus_b2 = sqrt(t0 * t0 + 4.0 * eta * eta * k * k);
    vec3 a = sqrt(max(0.5 * (a2_plus_b2 + t0), 0.0));
    vec3 t1 = a2_plus_b2 + cos2;
    vec3 t2 = 2.0 * a * cos_i;
    vec3 rs = (t1 - t2) / (t1 + t2);
    vec3 t3 = cos2 * a2_plus_b2 + sin2 * sin2;
    vec3 t4 = t2 * sin2;
    vec3 rp = rs * (t3 - t4) / (t3 + t4);
    return 0.5 * (rp + rs);
}

vec3 fresnel_schlick(float cos_i, vec3 at_normal)
{
    float m = clamp(1.0 - cos_i, 0.0, 1.0);
    float m2 = m * m;
    return at_normal + (1.0 - at_normal) * (m2 * m2 * m);
}
