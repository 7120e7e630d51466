// Modified Phong: kd / π + ks (n + 2) / 2π · cosⁿ α, α from the mirror direction (Lafortune and Willems 1994).
#include "base/sampling.glsl"
#include "material/bsdf.glsl"

// Share of the diffuse lobe when a lobe is chosen.
float phong_diffuse_share(Bsdf b)
{
    float diffuse = mean_component(b.color);
    float specular = mean_component(b.specular);
    return diffuse + specular > 0.0 ? diffuse / (diffuse + specular) : 1.0;
}

// cosⁿ α, 0 beyond a right angle also for n = 0, where pow(0, 0) is undefined.
float phong_power(Bsdf b, vec3 wo, vec3 wi)
{
    float cos_alpha = dot(vec3(-wo.xy, wo.z), wi);
    return cos_alpha > 0.0 ? pow(cos_alpha, b.exponent) : 0.0;
}

vec3 phong_eval(Bsdf b, vec3 wo, vec3 wi)
{
    if (wi.z * wo.z <= 0.0) return vec3(0.0);
    float lobe = (b.exponent + 2.0) * INV_TWO_PI * phong_power(b, wo, wi);
    return b.color * INV_PI + b.specular * lobe;
}

float phong_pdf(Bsdf b, vec3 wo, vec3 wi)
{
    float share = phong_diffuse_share(b);
    float diffuse = wi.z * wo.z > 0.0 ? cosine_hemisphere_pdf(abs(wi.z)) : 0.0;
    float specular = (b.exponent + 1.0) * INV_TWO_PI * phong_power(b, wo, wi);
    return mix(specular, diffuse, share);
}

BsdfSample phong_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    vec3 wi;
    if (lobe < phong_diffuse_share(b)) {
        wi = cosine_hemisphere_sample(u01);
        wi.z = wo.z < 0.0 ? -wi.z : wi.z;
    } else {
        float cos_alpha = pow(u01.x, 1.0 / (b.exponent + 1.0));
        float sin_alpha = safe_sqrt(1.0 - cos_alpha * cos_alpha);
        vec3 around = vec3(sin_alpha * circle_point(2.0 * PI * u01.y), cos_alpha);
        wi = basis_to_world(basis_around(vec3(-wo.xy, wo.z)), around);
    }
    float pdf = phong_pdf(b, wo, wi);
    if (wi.z * wo.z <= 0.0 || pdf <= 0.0) return BSDF_ABSORBED;
    return BsdfSample(wi, phong_eval(b, wo, wi) * (abs(wi.z) / pdf), pdf, 1.0, false);
}
