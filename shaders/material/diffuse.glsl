// Lambertian reflection.
#include "base/sampling.glsl"
#include "material/generated/inputs.glsl"

vec3 diffuse_eval(Diffuse m, vec3 wo, vec3 wi)
{
    return wi.z * wo.z > 0.0 ? m.color * INV_PI : vec3(0.0);
}

float diffuse_pdf(Diffuse m, vec3 wo, vec3 wi)
{
    return wi.z * wo.z > 0.0 ? cosine_hemisphere_pdf(abs(wi.z)) : 0.0;
}

BsdfSample diffuse_sample(Diffuse m, vec3 wo, float lobe, vec2 u01)
{
    vec3 wi = cosine_hemisphere_sample(u01);
    float pdf = cosine_hemisphere_pdf(wi.z);
    wi.z = wo.z < 0.0 ? -wi.z : wi.z;
    return BsdfSample(wi, pdf > 0.0 ? m.color : vec3(0.0), pdf, 1.0, false);
}
