// Modified Phong: kd / π + ks (n + 2) / 2π · cosⁿ α, α from the mirror direction (Lafortune and Willems 1994).
#include "base/sampling.glsl"
#include "material/generated/inputs.glsl"

// Share of the diffuse lobe when a lobe is chosen.
float phong_diffuse_share(Phong m)
{
    float diffuse = mean_component(m.diffuse);
    float specular = mean_component(m.specular);
    return diffuse + specular > 0.0 ? diffuse / (diffuse + specular) : 1.0;
}

// cosⁿ α, 0 beyond a right angle also for n = 0, where pow(0, 0) is undefined.
float phong_power(Phong m, vec3 wo, vec3 wi)
{
    float cos_alpha = dot(vec3(-wo.xy, wo.z), wi);
    return cos_alpha > 0.0 ? pow(cos_alpha, m.exponent) : 0.0;
}

vec3 phong_eval(Phong m, vec3 wo, vec3 wi)
{
    if (wi.z * wo.z <= 0.0) return vec3(0.0);
    float lobe = (m.exponent + 2.0) * INV_TWO_PI * phong_power(m, wo, wi);
    return m.diffuse * INV_PI + m.specular * lobe;
}

float phong_pdf(Phong m, vec3 wo, vec3 wi)
{
    float share = phong_diffuse_share(m);
    float diffuse = wi.z * wo.z > 0.0 ? cosine_hemisphere_pdf(abs(wi.z)) : 0.0;
    float specular = (m.exponent + 1.0) * INV_TWO_PI * phong_power(m, wo, wi);
    return mix(specular, diffuse, share);
}

BsdfSample phong_sample(Phong m, vec3 wo, float lobe, vec2 u01)
{
    vec3 wi;
    if (lobe < phong_diffuse_share(m)) {
        wi = cosine_hemisphere_sample(u01);
        wi.z = wo.z < 0.0 ? -wi.z : wi.z;
    } else {
        float cos_alpha = pow(u01.x, 1.0 / (m.exponent + 1.0));
        float sin_alpha = safe_sqrt(1.0 - cos_alpha * cos_alpha);
        vec3 around = vec3(sin_alpha * circle_point(2.0 * PI * u01.y), cos_alpha);
        wi = basis_to_world(basis_around(vec3(-wo.xy, wo.z)), around);
    }
    float pdf = phong_pdf(m, wo, wi);
    if (wi.z * wo.z <= 0.0 || pdf <= 0.0) return BSDF_ABSORBED;
    return BsdfSample(wi, phong_eval(m, wo, wi) * (abs(wi.z) / pdf), pdf, 1.0, false);
}
