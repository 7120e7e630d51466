// A dielectric interface over metal. Light is bent on its way in, meets the GGX lobe of the metal, and is bent on its way out:
// f = f_interface + T(μo) T(μi) f_metal(wo', wi') / (η² (1 − R K)). R is what the facet of the metal reflects, and K stands for what
// the interface sends back: 1 / (1 − R K) is the light that goes to and fro. K = 1 − e(μo) e(μi), where e is such that white metal sends
// out in all what the series does, for each direction; light goes both ways alike. Where both are smooth, e² is the transmittance
// 1 − F of the interface, and the whole F + T² R / (1 − R F), which is exact. A rough interface widens the lobe
// (coated_conductor_widths).
#include "material/conductor.glsl"
#include "material/interface.glsl"

// e of a direction outside.
float coated_conductor_leaving(Bsdf b, float cos_o)
{
#ifdef HAS_INTERFACE_TABLES
    if (!bsdf_is_smooth(b)) return interface_table(b.inner_table, cos_o, interface_width(b.alpha));
#endif
    return safe_sqrt(1.0 - fresnel_dielectric(cos_o, b.ior));
}

// Chance of sampling the interface; `below` is the direction of view under it.
float coated_conductor_chance(Bsdf b, float cos_o, vec3 below)
{
    float through = interface_through(b, cos_o);
    float metal = through * mean_component(conductor_fresnel(b, below.z));
    float reflected = 1.0 - through;
    return reflected + metal > 0.0 ? reflected / (reflected + metal) : 1.0;
}

CoatedValue coated_conductor_value(Bsdf b, vec3 wo, vec3 wi)
{
    if (wo.z * wi.z <= 0.0 || bsdf_is_smooth(b)) return CoatedValue(vec3(0.0), 0.0);
    // Both sides are alike
    wo.z = abs(wo.z);
    wi.z = abs(wi.z);
    vec3 below_o = interface_below(b, wo);
    vec3 below_i = interface_below(b, wi);
    float chance = coated_conductor_chance(b, wo.z, below_o);
    vec3 r = conductor_fresnel(b, dot(below_o, normalize(below_o + below_i)));
    float leaving = coated_conductor_leaving(b, wo.z) * coated_conductor_leaving(b, wi.z);
    float through = interface_through(b, wo.z) * interface_through(b, wi.z) / sqr(b.ior);
    CoatedValue v = interface_reflected(b, wo, wi);
    v.f += conductor_eval(b, below_o, below_i) * through / max(mix(vec3(1.0), vec3(leaving), r), 1e-6);
    v.pdf = mix(conductor_pdf(b, below_o, below_i) * wi.z / (sqr(b.ior) * below_i.z), v.pdf, chance);
    return v;
}

vec3 coated_conductor_eval(Bsdf b, vec3 wo, vec3 wi) { return coated_conductor_value(b, wo, wi).f; }

float coated_conductor_pdf(Bsdf b, vec3 wo, vec3 wi) { return coated_conductor_value(b, wo, wi).pdf; }

BsdfSample coated_conductor_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    vec3 from = vec3(wo.xy, abs(wo.z));
    vec3 mirrored = vec3(-wo.xy, wo.z);
    vec3 below = interface_below(b, from);
    float reflected = 1.0 - interface_through(b, from.z);
    if (bsdf_is_smooth(b)) {
        vec3 r = conductor_fresnel(b, below.z);
        return BsdfSample(mirrored, reflected + sqr(1.0 - reflected) * r / max(1.0 - r * reflected, 1e-6), 0.0, 1.0, false);
    }
    float chance = coated_conductor_chance(b, from.z, below);
    vec3 wi;
    if (lobe < chance) {
        if (interface_is_smooth(b)) return BsdfSample(mirrored, vec3(reflected / chance), 0.0, 1.0, false);
        wi = reflect(-from, ggx_visible_sample(from, b.coat_alpha, u01));
    } else {
        vec3 back = reflect(-below, ggx_visible_sample(below, b.alpha, u01));
        vec2 across = back.xy * b.ior;
        // What is beyond the critical angle is among the light that goes to and fro
        if (dot(across, across) >= 1.0 || back.z <= 0.0) return BSDF_ABSORBED;
        wi = vec3(across, safe_sqrt(1.0 - dot(across, across)));
    }
    if (wi.z <= 0.0) return BSDF_ABSORBED;
    wi.z = wo.z < 0.0 ? -wi.z : wi.z;
    CoatedValue v = coated_conductor_value(b, wo, wi);
    if (v.pdf <= 0.0) return BSDF_ABSORBED;
    return BsdfSample(wi, v.f * (abs(wi.z) / v.pdf), v.pdf, 1.0, false);
}
