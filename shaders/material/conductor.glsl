// Metal: a mirror, or GGX microfacets. HAS_METAL_INDEX switches metal by its index of refraction on.
#include "material/bsdf.glsl"
#include "material/fresnel.glsl"
#include "material/ggx.glsl"

#ifdef HAS_METAL_INDEX
// Metal by its index of refraction: what it reflects head-on is its colour for those who want one.
void conductor_index(inout Bsdf b)
{
    b.specular = clamp(b.specular, 0.01, 100.0);
    b.k = min(b.k, vec3(100.0));
    vec3 below = b.specular - 1.0;
    vec3 above = b.specular + 1.0;
    b.color = (below * below + b.k * b.k) / (above * above + b.k * b.k);
}
#endif

// k of metal whose η is 1: R = k² / (4 + k²) at normal incidence.
vec3 conductor_k(vec3 reflectance)
{
    vec3 r = clamp(reflectance, 0.0, 0.9999);
    return 2.0 * sqrt(r) / sqrt(1.0 - r);
}

vec3 conductor_fresnel(Bsdf b, float cos_i)
{
    if (b.mode == FRESNEL_NONE) return b.color;
    if (b.mode == FRESNEL_SCHLICK) return fresnel_schlick(cos_i, b.color);
    vec3 eta = vec3(1.0);
    vec3 k = conductor_k(b.color);
#ifdef HAS_METAL_INDEX
    if (b.mode == FRESNEL_INDEX) {
        eta = b.specular;
        k = b.k;
    }
#endif
    return fresnel_conductor(cos_i, eta, k);
}

vec3 conductor_eval(Bsdf b, vec3 wo, vec3 wi)
{
    vec3 m = wo + wi;
    if (bsdf_is_smooth(b) || wi.z * wo.z <= 0.0 || dot(m, m) == 0.0) return vec3(0.0);
    m = normalize(m);
    float scale = ggx_distribution(m, b.alpha) * ggx_masking_shadowing(wo, wi, b.alpha) / (4.0 * abs(wo.z * wi.z));
    return conductor_fresnel(b, abs(dot(wo, m))) * scale;
}

float conductor_pdf(Bsdf b, vec3 wo, vec3 wi)
{
    vec3 m = wo + wi;
    if (bsdf_is_smooth(b) || wi.z * wo.z <= 0.0 || dot(m, m) == 0.0) return 0.0;
    m = normalize(m);
    m = m.z * wo.z < 0.0 ? -m : m;
    vec3 up = wo.z < 0.0 ? vec3(1.0, 1.0, -1.0) : vec3(1.0);
    return ggx_visible_pdf(wo * up, m * up, b.alpha) / (4.0 * abs(dot(wo, m)));
}

BsdfSample conductor_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    if (bsdf_is_smooth(b)) {
        return BsdfSample(vec3(-wo.xy, wo.z), conductor_fresnel(b, abs(wo.z)), 0.0, 1.0, false);
    }
    vec3 up = wo.z < 0.0 ? vec3(1.0, 1.0, -1.0) : vec3(1.0);
    vec3 m = ggx_visible_sample(wo * up, b.alpha, u01) * up;
    vec3 wi = reflect(-wo, m);
    float pdf = conductor_pdf(b, wo, wi);
    if (wi.z * wo.z <= 0.0 || pdf <= 0.0) return BSDF_ABSORBED;
    return BsdfSample(wi, conductor_eval(b, wo, wi) * (abs(wi.z) / pdf), pdf, 1.0, false);
}
