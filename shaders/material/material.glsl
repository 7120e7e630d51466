// The menu of materials: record and textures to a Bsdf, and one switch a verb. Kinds that the scene does not use are
// left out by switches of the variant: HAS_DIFFUSE, HAS_PHONG, HAS_CONDUCTOR, HAS_DIELECTRIC, HAS_PRINCIPLED. ANISOTROPIC says
// that some roughness has two widths.
#include "material/diffuse.glsl"
#include "material/phong.glsl"
#include "material/conductor.glsl"
#include "material/dielectric.glsl"
#include "material/principled_inputs.glsl"
#include "material/principled_verbs.glsl"
#include "material/input.glsl"

vec3 material_emission(Material m, TextureContext context) { return material_color(m, INPUT_EMISSION, context); }

// GGX widths. What is rougher in one direction than smooth is just rough in the other, as a lobe that is smooth in one direction
// only has no density.
vec2 material_alpha(Material m, TextureContext context)
{
    vec2 alpha = material_numbers(m, INPUT_ROUGHNESS, context);
#ifndef ANISOTROPIC
    alpha = alpha.xx;
#endif
    if (input_textured(INPUT_ROUGHNESS, 0u) || input_textured(INPUT_ROUGHNESS, 1u)) {
        alpha = min(alpha, vec2(1.0));
        if ((m.flags & MATERIAL_SQUARED) != 0u) alpha *= alpha;
    }
    return max(alpha.x, alpha.y) < BSDF_SMOOTH ? alpha : max(alpha, 1e-4);
}

// The number that kinds call by other names: index of refraction, exponent.
float material_index(Material m, TextureContext context)
{
    float index = material_numbers(m, INPUT_INDEX, context).x;
    // What a texture says is kept where the kinds can take it
    if (m.kind == MATERIAL_DIELECTRIC && input_textured(INPUT_INDEX, 0u)) index = clamp(index, 0.01, 100.0);
    return index;
}

Bsdf material_bsdf(Material m, TextureContext context)
{
    Bsdf b;
    b.kind = m.kind;
    b.mode = m.mode;
    b.color = material_color(m, INPUT_COLOR, context);
    if (m.kind != MATERIAL_UNLIT && input_textured(INPUT_COLOR, 0u)) b.color = min(b.color, vec3(1.0));
    b.specular = material_color(m, INPUT_SPECULAR, context);
    b.alpha = material_alpha(m, context);
    b.ior = material_index(m, context);
    b.exponent = b.ior;
#ifdef HAS_DIELECTRIC
    // Glass that bends nothing has no half vectors, whatever its roughness.
    if (m.kind == MATERIAL_DIELECTRIC && abs(b.ior - 1.0) < 1e-4) b.alpha = vec2(0.0);
#endif
#ifdef HAS_METAL_INDEX
    b.k = material_color(m, INPUT_ABSORPTION, context);
    if (m.kind == MATERIAL_CONDUCTOR && m.mode == FRESNEL_INDEX) conductor_index(b);
#endif
#ifdef HAS_PHONG
    if (m.kind == MATERIAL_PHONG) phong_normalise(b);
#endif
#ifdef HAS_PRINCIPLED
    if (m.kind == MATERIAL_PRINCIPLED) material_principled(b, m, context);
#endif
    return b;
}

// Value of the BSDF, without the cosine.
vec3 bsdf_eval(Bsdf b, vec3 wo, vec3 wi)
{
    switch (b.kind) {
#ifdef HAS_DIFFUSE
    case MATERIAL_DIFFUSE: return diffuse_eval(b, wo, wi);
#endif
#ifdef HAS_PHONG
    case MATERIAL_PHONG: return phong_eval(b, wo, wi);
#endif
#ifdef HAS_CONDUCTOR
    case MATERIAL_CONDUCTOR: return conductor_eval(b, wo, wi);
#endif
#ifdef HAS_DIELECTRIC
    case MATERIAL_DIELECTRIC: return dielectric_eval(b, wo, wi);
#endif
#ifdef HAS_PRINCIPLED
    case MATERIAL_PRINCIPLED: return principled_eval(b, wo, wi);
#endif
    default: return vec3(0.0);
    }
}

// Density with which bsdf_sample chooses wi, over solid angle.
float bsdf_pdf(Bsdf b, vec3 wo, vec3 wi)
{
    switch (b.kind) {
#ifdef HAS_DIFFUSE
    case MATERIAL_DIFFUSE: return diffuse_pdf(b, wo, wi);
#endif
#ifdef HAS_PHONG
    case MATERIAL_PHONG: return phong_pdf(b, wo, wi);
#endif
#ifdef HAS_CONDUCTOR
    case MATERIAL_CONDUCTOR: return conductor_pdf(b, wo, wi);
#endif
#ifdef HAS_DIELECTRIC
    case MATERIAL_DIELECTRIC: return dielectric_pdf(b, wo, wi);
#endif
#ifdef HAS_PRINCIPLED
    case MATERIAL_PRINCIPLED: return principled_pdf(b, wo, wi);
#endif
    default: return 0.0;
    }
}

BsdfSample bsdf_sample(Bsdf b, vec3 wo, float lobe, vec2 u01)
{
    switch (b.kind) {
#ifdef HAS_DIFFUSE
    case MATERIAL_DIFFUSE: return diffuse_sample(b, wo, lobe, u01);
#endif
#ifdef HAS_PHONG
    case MATERIAL_PHONG: return phong_sample(b, wo, lobe, u01);
#endif
#ifdef HAS_CONDUCTOR
    case MATERIAL_CONDUCTOR: return conductor_sample(b, wo, lobe, u01);
#endif
#ifdef HAS_DIELECTRIC
    case MATERIAL_DIELECTRIC: return dielectric_sample(b, wo, lobe, u01);
#endif
#ifdef HAS_PRINCIPLED
    case MATERIAL_PRINCIPLED: return principled_sample(b, wo, lobe, u01);
#endif
    default: return BSDF_ABSORBED;
    }
}
