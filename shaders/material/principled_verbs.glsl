// The verbs of the principled model: value and density of all lobes together, and a sample of one of them.
#include "material/principled.glsl"

struct PrincipledValue { vec3 f; float pdf; };

// Reflection and transmission by facets, with the chance of sampling them.
PrincipledValue principled_facets(Bsdf b, vec3 wo, vec3 wi, float chance)
{
    bool reflected = wo.z * wi.z > 0.0;
    bool thin = b.mode == DIELECTRIC_THIN;
#ifndef HAS_TRANSMISSION
    if (!reflected) return PrincipledValue(vec3(0.0), 0.0);
#endif
    // Through a sheet, light goes on as if it had been reflected and then mirrored by it
    vec3 w = thin && !reflected ? vec3(wi.xy, -wi.z) : wi;
    vec3 m = dielectric_half(b, wo, w);
    if (m.z == 0.0) return PrincipledValue(vec3(0.0), 0.0);
    float eta = principled_eta(b, wo);
    float cos_o = abs(dot(wo, m));
    vec3 up = wo.z < 0.0 ? vec3(-1.0) : vec3(1.0);
    float visible = ggx_visible_pdf(wo * up, dot(wo * up, m) < 0.0 ? -m : m, b.alpha);
    float f = ggx_distribution(m, b.alpha) * ggx_masking_shadowing(wo, w, b.alpha) / abs(4.0 * wo.z * w.z);
    float jacobian = 1.0 / (4.0 * cos_o);
    float part = principled_facet_chance(b, cos_o, eta);
    if (reflected) return PrincipledValue(principled_reflected(b, cos_o, eta) * f, chance * part * visible * jacobian);
    if (!thin) {
        float bent = abs(dot(wi, m)) / sqr(dot(wi, m) + dot(wo, m) / eta);
        f *= 4.0 * bent * cos_o / (eta * eta);
        jacobian = bent;
    }
    return PrincipledValue(principled_through(b, cos_o, eta) * f, chance * (1.0 - part) * visible * jacobian);
}

PrincipledValue principled_value(Bsdf b, vec3 wo, vec3 wi)
{
    float turn = principled_turn(b, wo);
    wo.z *= turn;
    wi.z *= turn;
    if (wo.z * wi.z == 0.0) return PrincipledValue(vec3(0.0), 0.0);
    bool reflected = wo.z * wi.z > 0.0;
    vec3 chances = principled_chances(b, wo);
    PrincipledValue v = principled_facets(b, wo, wi, chances.z);
    if (reflected) {
        vec2 base_o = principled_base(b, wo);
        float diffuse = principled_diffuse(b, wo) * base_o.x * principled_base(b, wi).x / max(base_o.y, 1e-6);
        v.f += diffuse * INV_PI * b.color;
        v.pdf += chances.x * cosine_hemisphere_pdf(abs(wi.z));
    }
#ifdef HAS_SHEEN
    v.f *= 1.0 - max(principled_sheen(b, wo), principled_sheen(b, wi));
    if (reflected && principled_outside(b, wo)) v.f += b.sheen * sheen_value(wo, wi, b.sheen_roughness);
#endif
#ifdef HAS_CLEARCOAT
    v.f *= (1.0 - principled_coat(b, wo)) * (1.0 - principled_coat(b, wi));
    vec3 m = wo + wi;
    if (reflected && principled_outside(b, wo)) {
        m = normalize(m);
        float f = ggx_distribution(m, b.coat_alpha) * ggx_masking_shadowing(wo, wi, b.coat_alpha) / (4.0 * wo.z * wi.z);
        float cos_o = dot(wo, m);
        v.f += b.coat * f * fresnel_schlick(cos_o, vec3(COAT_F0));
        v.pdf += chances.y * ggx_visible_pdf(wo, m, b.coat_alpha) / (4.0 * cos_o);
    }
#endif
    return v;
}

vec3 principled_eval(Bsdf b, vec3 wo, vec3 wi) { return principled_value(b, wo, wi).f; }

float principled_pdf(Bsdf b, vec3 wo, vec3 wi) { return principled_value(b, wo, wi).pdf; }

BsdfSample principled_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    float turn = principled_turn(b, wo);
    vec3 from = vec3(wo.xy, wo.z * turn);
    float side = from.z < 0.0 ? -1.0 : 1.0;
    vec3 chances = principled_chances(b, from);
    vec3 wi = cosine_hemisphere_sample(u01) * vec3(1.0, 1.0, side);
    float eta = 1.0;
    if (lobe >= chances.x) {
        bool coat = lobe < chances.x + chances.y;
        vec3 m = ggx_visible_sample(from * side, coat ? b.coat_alpha : b.alpha, u01) * side;
        wi = reflect(-from, m);
#ifdef HAS_TRANSMISSION
        float cos_o = abs(dot(from, m));
        float ratio = principled_eta(b, from);
        float left = (lobe - chances.x - chances.y) / max(chances.z, 1e-6);
        if (!coat && left >= principled_facet_chance(b, cos_o, ratio)) {
            float cos_t = safe_sqrt(1.0 - (1.0 - sqr(cos_o)) / sqr(ratio));
            bool thin = b.mode == DIELECTRIC_THIN;
            wi = thin ? vec3(wi.xy, -wi.z) : normalize(-from / ratio + (cos_o / ratio - cos_t) * m);
            eta = thin ? 1.0 : ratio;
            if (wi.z * from.z >= 0.0) return BSDF_ABSORBED;
        } else
#endif
        if (wi.z * from.z <= 0.0) return BSDF_ABSORBED;
    }
    wi.z *= turn;
    PrincipledValue v = principled_value(b, wo, wi);
    if (v.pdf <= 0.0) return BSDF_ABSORBED;
    bool through = wi.z * wo.z < 0.0;
    return BsdfSample(wi, v.f * (abs(wi.z) / v.pdf), v.pdf, through ? eta : 1.0, through);
}
