// Clear material: smooth, GGX-rough (Walter et al. 2007; pbrt-v4, section 9.7), or a thin sheet. Radiance is scaled by
// 1 / η² when it goes through.
#include "material/bsdf.glsl"
#include "material/fresnel.glsl"
#include "material/ggx.glsl"

// Index on the far side over index on the side of w.
float dielectric_eta(Bsdf b, vec3 w) { return w.z > 0.0 ? b.ior : 1.0 / b.ior; }

// The half vector of reflection or refraction, on the +z side; 0 when there is none.
vec3 dielectric_half(Bsdf b, vec3 wo, vec3 wi)
{
    float eta = wo.z * wi.z > 0.0 ? 1.0 : dielectric_eta(b, wo);
    vec3 m = wi * eta + wo;
    if (dot(m, m) == 0.0 || wi.z == 0.0 || wo.z == 0.0) return vec3(0.0);
    m = normalize(m);
    m = m.z < 0.0 ? -m : m;
    bool backfacing = dot(m, wi) * wi.z < 0.0 || dot(m, wo) * wo.z < 0.0;
    return backfacing ? vec3(0.0) : m;
}

vec3 dielectric_eval(Bsdf b, vec3 wo, vec3 wi)
{
    if (bsdf_is_smooth(b)) return vec3(0.0);
    vec3 m = dielectric_half(b, wo, wi);
    if (m.z == 0.0) return vec3(0.0);
    float eta = dielectric_eta(b, wo);
    float reflectance = fresnel_dielectric(abs(dot(wo, m)), eta);
    float common_part = ggx_distribution(m, b.alpha) * ggx_masking_shadowing(wo, wi, b.alpha);
    if (wo.z * wi.z > 0.0) return vec3(reflectance * common_part / abs(4.0 * wo.z * wi.z));
    float denominator = sqr(dot(wi, m) + dot(wo, m) / eta) * abs(wi.z * wo.z);
    return vec3((1.0 - reflectance) * common_part * abs(dot(wi, m) * dot(wo, m) / denominator) / (eta * eta));
}

float dielectric_pdf(Bsdf b, vec3 wo, vec3 wi)
{
    if (bsdf_is_smooth(b)) return 0.0;
    vec3 m = dielectric_half(b, wo, wi);
    if (m.z == 0.0) return 0.0;
    float eta = dielectric_eta(b, wo);
    float reflectance = fresnel_dielectric(abs(dot(wo, m)), eta);
    vec3 up = wo.z < 0.0 ? vec3(-1.0) : vec3(1.0);
    float visible = ggx_visible_pdf(wo * up, dot(wo * up, m) < 0.0 ? -m : m, b.alpha);
    if (wo.z * wi.z > 0.0) return reflectance * visible / (4.0 * abs(dot(wo, m)));
    float jacobian = abs(dot(wi, m)) / sqr(dot(wi, m) + dot(wo, m) / eta);
    return (1.0 - reflectance) * visible * jacobian;
}

BsdfSample dielectric_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    bool smooth_surface = bsdf_is_smooth(b);
    float side = wo.z < 0.0 ? -1.0 : 1.0;
    vec3 m = smooth_surface ? vec3(0.0, 0.0, side) : ggx_visible_sample(wo * side, b.alpha, u01) * side;
    float cos_o = abs(dot(wo, m));
    float eta = dielectric_eta(b, wo);
    bool thin = b.mode == DIELECTRIC_THIN;
    float reflectance = fresnel_dielectric(cos_o, thin ? b.ior : eta);
    // Light goes to and fro in a thin sheet: R + T² R / (1 − R²).
    if (thin && reflectance < 1.0) reflectance += sqr(1.0 - reflectance) * reflectance / (1.0 - sqr(reflectance));

    if (lobe < reflectance) {
        vec3 wi = reflect(-wo, m);
        if (smooth_surface) return BsdfSample(wi, vec3(1.0), 0.0, 1.0, false);
        float pdf = dielectric_pdf(b, wo, wi);
        if (wi.z * wo.z <= 0.0 || pdf <= 0.0) return BSDF_ABSORBED;
        return BsdfSample(wi, dielectric_eval(b, wo, wi) * (abs(wi.z) / pdf), pdf, 1.0, false);
    }
    if (thin) return BsdfSample(-wo, vec3(1.0), 0.0, 1.0, true);
    float cos_t = safe_sqrt(1.0 - (1.0 - sqr(cos_o)) / sqr(eta));
    vec3 wi = normalize(-wo / eta + (cos_o / eta - cos_t) * m);
    if (smooth_surface) return BsdfSample(wi, vec3(1.0 / sqr(eta)), 0.0, eta, true);
    float pdf = dielectric_pdf(b, wo, wi);
    if (wi.z * wo.z >= 0.0 || pdf <= 0.0) return BSDF_ABSORBED;
    return BsdfSample(wi, dielectric_eval(b, wo, wi) * (abs(wi.z) / pdf), pdf, eta, true);
}
