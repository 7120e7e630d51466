// Lambertian on both sides: what is reflected and what goes through leave in all directions alike, as with paper and leaves. There
// is no inside: light is not bent, and radiance not scaled.
#include "base/sampling.glsl"
#include "material/generated/inputs.glsl"

// Chance of reflection when a side is chosen.
float diffuse_transmission_reflected(DiffuseTransmission m)
{
    float reflected = max_component(m.color);
    float through = max_component(m.transmittance);
    return reflected + through > 0.0 ? reflected / (reflected + through) : 1.0;
}

vec3 diffuse_transmission_eval(DiffuseTransmission m, vec3 wo, vec3 wi)
{
    return (wi.z * wo.z > 0.0 ? m.color : m.transmittance) * INV_PI;
}

float diffuse_transmission_pdf(DiffuseTransmission m, vec3 wo, vec3 wi)
{
    float reflected = diffuse_transmission_reflected(m);
    return (wi.z * wo.z > 0.0 ? reflected : 1.0 - reflected) * cosine_hemisphere_pdf(abs(wi.z));
}

BsdfSample diffuse_transmission_sample(DiffuseTransmission m, vec3 wo, float lobe, vec2 u01)
{
    float reflected = diffuse_transmission_reflected(m);
    bool through = lobe >= reflected;
    vec3 wi = cosine_hemisphere_sample(u01);
    if ((wo.z < 0.0) != through) wi.z = -wi.z;
    float pdf = diffuse_transmission_pdf(m, wo, wi);
    if (pdf <= 0.0) return BSDF_ABSORBED;
    vec3 weight = through ? m.transmittance / (1.0 - reflected) : m.color / reflected;
    return BsdfSample(wi, weight, pdf, 1.0, through);
}
