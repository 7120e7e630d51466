// The menu of materials: one switch a verb. Kinds that the scene does not use are left out by switches of the variant: HAS_DIFFUSE,
// HAS_DIFFUSE_TRANSMISSION, HAS_PHONG, HAS_CONDUCTOR, HAS_DIELECTRIC, HAS_COATED_DIFFUSE,
// HAS_COATED_CONDUCTOR, HAS_PRINCIPLED.
#include "material/diffuse.glsl"
#include "material/diffuse_transmission.glsl"
#include "material/phong.glsl"
#include "material/conductor.glsl"
#include "material/dielectric.glsl"
#include "material/coated_diffuse.glsl"
#include "material/coated_conductor.glsl"
#include "material/principled_verbs.glsl"
#include "material/point.glsl"

// Whether some of its samples are mirror directions.
bool bsdf_may_mirror(Bsdf b)
{
#ifdef HAS_COATED_DIFFUSE
    if (b.kind == MATERIAL_COATED_DIFFUSE) return interface_is_smooth(b);
#endif
    return bsdf_is_specular(b);
}

// Value of the BSDF, without the cosine.
vec3 bsdf_eval(Bsdf b, vec3 wo, vec3 wi)
{
    switch (b.kind) {
#ifdef HAS_DIFFUSE
    case MATERIAL_DIFFUSE: return diffuse_eval(b, wo, wi);
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
    case MATERIAL_DIFFUSE_TRANSMISSION: return diffuse_transmission_eval(b, wo, wi);
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
#ifdef HAS_COATED_DIFFUSE
    case MATERIAL_COATED_DIFFUSE: return coated_diffuse_eval(b, wo, wi);
#endif
#ifdef HAS_COATED_CONDUCTOR
    case MATERIAL_COATED_CONDUCTOR: return coated_conductor_eval(b, wo, wi);
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
#ifdef HAS_DIFFUSE_TRANSMISSION
    case MATERIAL_DIFFUSE_TRANSMISSION: return diffuse_transmission_pdf(b, wo, wi);
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
#ifdef HAS_COATED_DIFFUSE
    case MATERIAL_COATED_DIFFUSE: return coated_diffuse_pdf(b, wo, wi);
#endif
#ifdef HAS_COATED_CONDUCTOR
    case MATERIAL_COATED_CONDUCTOR: return coated_conductor_pdf(b, wo, wi);
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
#ifdef HAS_DIFFUSE_TRANSMISSION
    case MATERIAL_DIFFUSE_TRANSMISSION: return diffuse_transmission_sample(b, wo, lobe, u01);
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
#ifdef HAS_COATED_DIFFUSE
    case MATERIAL_COATED_DIFFUSE: return coated_diffuse_sample(b, wo, lobe, u01);
#endif
#ifdef HAS_COATED_CONDUCTOR
    case MATERIAL_COATED_CONDUCTOR: return coated_conductor_sample(b, wo, lobe, u01);
#endif
#ifdef HAS_PRINCIPLED
    case MATERIAL_PRINCIPLED: return principled_sample(b, wo, lobe, u01);
#endif
    default: return BSDF_ABSORBED;
    }
}
