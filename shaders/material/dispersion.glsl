// Glass that bends each colour in its own way. A colour is a band of wavelengths, and a path has one of each band. An event follows one of
// them, drawn by what the path still brings of each, and the others keep what they bring the same way, by the mean of the densities
// (Wilkie et al. 2014, section 4.1). So no weight grows: smooth glass sends each colour another way, and the path has one from there.
// Switch: HAS_DISPERSION.
#include "base/sampling.glsl"
#include "base/spectrum.glsl"
#include "material/material.glsl"

// How far a band reaches to either side, less and less, in µm.
const float BAND_REACH = 0.05;
// Cauchy's formula through the index of the d line, 1 / λ² there and between the lines F and C (KHR_materials_dispersion), in µm⁻².
const float CAUCHY_D = 2.89663;
const float CAUCHY_FC = 1.90966;

// Indices of red, green and blue at the place in their bands, 0 to 1.
vec3 dispersed_indices(float index, float dispersion, float place)
{
    vec3 wavelengths = COLOR_WAVELENGTHS + BAND_REACH * tent_sample(place);
    vec3 bent = (1.0 / (wavelengths * wavelengths) - CAUCHY_D) / CAUCHY_FC;
    return max(index + (index - 1.0) * dispersion * bent, vec3(0.01));
}

// Gives glass the indices of the colours of a path, and the chances of following each. `place` is a number of the path.
void disperse(inout Bsdf b, float dispersion, vec3 throughput, float place)
{
    b.indices = dispersed_indices(b.ior, dispersion, place);
    b.disperses = dispersion > 0.0;
    float sum = throughput.x + throughput.y + throughput.z;
    b.chances = sum > 0.0 ? throughput / sum : vec3(1.0 / 3.0);
}

// What smooth glass reflects of each colour.
vec3 dispersed_mirror(Bsdf b, vec3 wo)
{
    vec3 eta = wo.z > 0.0 ? b.indices : 1.0 / b.indices;
    return vec3(fresnel_dielectric(abs(wo.z), eta.x), fresnel_dielectric(abs(wo.z), eta.y), fresnel_dielectric(abs(wo.z), eta.z));
}

vec3 dispersed_eval(Bsdf b, vec3 wo, vec3 wi)
{
#ifdef HAS_DISPERSION
    vec3 f = vec3(0.0);
    uint rounds = b.disperses ? 3u : 1u;
    for (uint i = 0u; i < rounds; ++i) {
        vec3 mask = color_mask(COLOR_RED + i);
        if (b.disperses) b.ior = dot(b.indices, mask);
        f += bsdf_eval(b, wo, wi) * (b.disperses ? mask : vec3(1.0));
    }
    return f;
#else
    return bsdf_eval(b, wo, wi);
#endif
}

// The mean over the colours that may be followed.
float dispersed_pdf(Bsdf b, vec3 wo, vec3 wi)
{
#ifdef HAS_DISPERSION
    float pdf = 0.0;
    uint rounds = b.disperses ? 3u : 1u;
    for (uint i = 0u; i < rounds; ++i) {
        vec3 mask = color_mask(COLOR_RED + i);
        if (b.disperses) b.ior = dot(b.indices, mask);
        pdf += bsdf_pdf(b, wo, wi) * (b.disperses ? dot(b.chances, mask) : 1.0);
    }
    return pdf;
#else
    return bsdf_pdf(b, wo, wi);
#endif
}

BsdfSample dispersed_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
#ifdef HAS_DISPERSION
    if (!b.disperses) return bsdf_sample(b, wo, lobe, u01);
    // Where each colour begins
    vec2 begins = vec2(b.chances.x, b.chances.x + b.chances.y);
    uint followed = uint(lobe >= begins.x) + uint(lobe >= begins.y && b.chances.z > 0.0);
    vec3 mask = color_mask(COLOR_RED + followed);
    float chance = dot(b.chances, mask);
    lobe = clamp((lobe - dot(vec3(0.0, begins), mask)) / max(chance, 1e-30), 0.0, ONE_MINUS_EPSILON);
    b.ior = dot(b.indices, mask);
    BsdfSample s = bsdf_sample(b, wo, lobe, u01);
    if (max_component(s.weight) <= 0.0) return s;
    if (s.pdf > 0.0) {
        s.pdf = dispersed_pdf(b, wo, s.wi);
        if (s.pdf <= 0.0) return BSDF_ABSORBED;
        s.weight = dispersed_eval(b, wo, s.wi) * (abs(s.wi.z) / s.pdf);
    } else if (s.through) {
        s.weight *= mask / chance;
    } else {
        vec3 reflected = dispersed_mirror(b, wo);
        s.weight = reflected / dot(b.chances, reflected);
    }
    return s;
#else
    return bsdf_sample(b, wo, lobe, u01);
#endif
}
