// A dielectric interface over a Lambertian base of reflectance R, with all the light that goes to and fro between them. The base
// makes light uniform, so the sum of the series is closed: f = f_interface + R T(μo) T(μi) / (π η² (1 − R K)). T is what the interface
// lets through from outside; K is what it sends back of uniform light from inside, 1 − 2 ∫ T(μ) μ dμ / η² (Saunderson 1942).
#include "base/sampling.glsl"
#include "material/interface.glsl"

// R / (η² (1 − R K)).
vec3 coated_diffuse_base(Bsdf b) { return b.color / (sqr(b.ior) * (1.0 - b.color) + b.color * interface_mean(b)); }

// Chance of sampling the interface.
float coated_diffuse_chance(Bsdf b, float cos_o, vec3 base)
{
    float through = interface_through(b, cos_o);
    float diffuse = through * interface_mean(b) * mean_component(base);
    float reflected = 1.0 - through;
    return reflected + diffuse > 0.0 ? reflected / (reflected + diffuse) : 1.0;
}

CoatedValue coated_diffuse_value(Bsdf b, vec3 wo, vec3 wi)
{
    if (wo.z * wi.z <= 0.0) return CoatedValue(vec3(0.0), 0.0);
    // Both sides are alike
    wo.z = abs(wo.z);
    wi.z = abs(wi.z);
    vec3 base = coated_diffuse_base(b);
    float chance = coated_diffuse_chance(b, wo.z, base);
    CoatedValue v = interface_reflected(b, wo, wi);
    v.f += base * (INV_PI * interface_through(b, wo.z) * interface_through(b, wi.z));
    v.pdf = mix(cosine_hemisphere_pdf(wi.z), v.pdf, chance);
    return v;
}

vec3 coated_diffuse_eval(Bsdf b, vec3 wo, vec3 wi) { return coated_diffuse_value(b, wo, wi).f; }

float coated_diffuse_pdf(Bsdf b, vec3 wo, vec3 wi) { return coated_diffuse_value(b, wo, wi).pdf; }

BsdfSample coated_diffuse_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    vec3 from = vec3(wo.xy, abs(wo.z));
    float chance = coated_diffuse_chance(b, from.z, coated_diffuse_base(b));
    vec3 wi = cosine_hemisphere_sample(u01);
    if (lobe < chance) {
        vec3 mirrored = vec3(-wo.xy, wo.z);
        if (interface_is_smooth(b)) return BsdfSample(mirrored, vec3((1.0 - interface_through(b, from.z)) / chance), 0.0, 1.0, false);
        wi = reflect(-from, ggx_visible_sample(from, b.coat_alpha, u01));
        if (wi.z <= 0.0) return BSDF_ABSORBED;
    }
    wi.z = wo.z < 0.0 ? -wi.z : wi.z;
    CoatedValue v = coated_diffuse_value(b, wo, wi);
    if (v.pdf <= 0.0) return BSDF_ABSORBED;
    return BsdfSample(wi, v.f * (abs(wi.z) / v.pdf), v.pdf, 1.0, false);
}
