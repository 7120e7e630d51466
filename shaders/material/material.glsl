// The menu of materials: record and textures to a Bsdf, and one switch a verb. Kinds that the scene does not use are
// left out by switches of the variant: HAS_DIFFUSE, HAS_PHONG, HAS_CONDUCTOR, HAS_DIELECTRIC.
#include "shared/bindings.glsl"
#include "material/diffuse.glsl"
#include "material/phong.glsl"
#include "material/conductor.glsl"
#include "material/dielectric.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

Material material_fetch(uint i)
{
    uint w = i * MATERIAL_WORDS;
    return material_unpack(fetch_materials(w), fetch_materials(w + 1u), fetch_materials(w + 2u), fetch_materials(w + 3u),
                           fetch_materials(w + 4u), fetch_materials(w + 5u), fetch_materials(w + 6u));
}

// A colour or number that a texture may drive.
vec3 textured_color(vec3 constant, uint texture_reference, TextureContext context)
{
    return texture_reference == NONE ? constant : max(texture_evaluate(texture_reference, context).rgb, vec3(0.0));
}

float textured_number(float constant, uint texture_reference, TextureContext context)
{
    return texture_reference == NONE ? constant : max(mean_component(texture_evaluate(texture_reference, context).rgb), 0.0);
}

vec3 material_emission(Material m, TextureContext context)
{
#ifdef TEXTURED_EMISSION
    return textured_color(vec3(1.0), m.emission_texture, context) * m.emission;
#else
    return m.emission;
#endif
}

Bsdf material_bsdf(Material m, TextureContext context)
{
    Bsdf b = Bsdf(m.kind, m.mode, m.color, m.specular, m.k, m.ior, m.exponent, vec2(m.alpha_u, m.alpha_v));
#ifdef TEXTURED_COLOR
    b.color = textured_color(m.color, m.color_texture, context);
    if (m.kind != MATERIAL_UNLIT) b.color = clamp(b.color, 0.0, 1.0);
#endif
#ifdef TEXTURED_SPECULAR
    b.specular = textured_color(m.specular, m.specular_texture, context);
#endif
#ifdef TEXTURED_EXPONENT
    b.exponent = max(textured_number(m.exponent, m.exponent_texture, context), 0.0);
#endif
#ifdef TEXTURED_ALPHA
    b.alpha.x = clamp(textured_number(m.alpha_u, m.alpha_u_texture, context), 0.0, 1.0);
    b.alpha.y = clamp(textured_number(m.alpha_v, m.alpha_v_texture, context), 0.0, 1.0);
#endif
    // Glass that bends nothing has no half vectors, whatever its roughness.
    if (m.kind == MATERIAL_DIELECTRIC && abs(m.ior - 1.0) < 1e-4) b.alpha = vec2(0.0);
    // A lobe that is smooth in one direction only has no density: keep it just rough.
    if (!bsdf_is_smooth(b)) b.alpha = max(b.alpha, 1e-4);
#ifdef HAS_PHONG
    if (m.kind == MATERIAL_PHONG) phong_normalise(b);
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
    default: return BSDF_ABSORBED;
    }
}
