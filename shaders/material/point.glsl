// What a material is at one point: record and textures to a Bsdf. Switches of the variant: those of the menu, HAS_METAL_INDEX, and
// ANISOTROPIC, which says that some roughness has two widths.
#include "material/coated_inputs.glsl"
#include "material/conductor.glsl"
#include "material/principled_inputs.glsl"
#include "material/input.glsl"
#include "material/generated/inputs.glsl"

vec3 material_emission(Material m, TextureContext context) { return material_color(m, INPUT_EMISSION, context); }

// GGX widths. What is rougher in one direction than smooth is just rough in the other, as a lobe that is smooth in one direction
// only has no density.
vec2 material_alpha(Material m, uint place, uint squared, TextureContext context)
{
    vec2 alpha = material_numbers(m, place, context);
#ifndef ANISOTROPIC
    alpha = alpha.xx;
#endif
    if (input_textured(place, 0u) || input_textured(place, 1u)) {
        alpha = min(alpha, vec2(1.0));
        if ((m.flags & squared) != 0u) alpha *= alpha;
    }
    return max(alpha.x, alpha.y) < BSDF_SMOOTH ? alpha : max(alpha, 1e-4);
}

Bsdf material_bsdf(Material m, TextureContext context)
{
    Bsdf b;
    b.kind = m.kind;
    b.mode = m.mode;
    b.color = material_color(m, INPUT_COLOR, context);
    if (m.kind != MATERIAL_UNLIT && input_textured(INPUT_COLOR, 0u)) b.color = min(b.color, vec3(1.0));
    b.specular = material_color(m, INPUT_SPECULAR, context);
    b.alpha = material_alpha(m, INPUT_ROUGHNESS, MATERIAL_SQUARED, context);
    b.numbers = material_numbers(m, INPUT_INDEX, context);
    b.ior = b.numbers.x;
    // What a texture says is kept where glass can take it
    if (m.kind == MATERIAL_DIELECTRIC && input_textured(INPUT_INDEX, 0u)) b.ior = clamp(b.ior, 0.01, 100.0);
#ifdef HAS_DIELECTRIC
    // Glass that bends nothing has no half vectors, whatever its roughness.
    if (m.kind == MATERIAL_DIELECTRIC && abs(b.ior - 1.0) < 1e-4) b.alpha = vec2(0.0);
#endif
#ifdef HAS_METAL_INDEX
    b.k = material_color(m, INPUT_ABSORPTION, context);
    if (m.kind == MATERIAL_CONDUCTOR && m.mode == FRESNEL_INDEX) conductor_index(b);
#endif
    if (bsdf_has_parts(m.kind)) bsdf_normalise(b);
#ifdef HAS_COATED_DIFFUSE
    if (m.kind == MATERIAL_COATED_DIFFUSE) material_interface(b, m, b.alpha);
#endif
#ifdef HAS_COATED_CONDUCTOR
    if (m.kind == MATERIAL_COATED_CONDUCTOR) {
        material_interface(b, m, material_alpha(m, INPUT_CLEARCOAT, MATERIAL_INTERFACE_SQUARED, context));
        coated_conductor_widths(b);
        coated_conductor_index(b);
    }
#endif
#ifdef HAS_PRINCIPLED
    if (m.kind == MATERIAL_PRINCIPLED) material_principled(b, m, context);
#endif
    return b;
}
