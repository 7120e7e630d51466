// What the principled model is at one point. Switches: HAS_TRANSMISSION, HAS_CLEARCOAT, HAS_SHEEN.
#include "material/bsdf.glsl"
#include "material/input.glsl"
#include "material/sheen.glsl"

void material_principled(inout Bsdf b, Material m, TextureContext context)
{
    // There is no mirror among the lobes: what is smoother is just rough, and bends light a little
    b.alpha = max(b.alpha, vec2(BSDF_SMOOTH));
    vec2 index = material_numbers(m, INPUT_INDEX, context);
    b.ior = clamp(index.x, 1.001, 100.0);
    b.weight = min(index.y, 1.0);
    vec2 kind = min(material_numbers(m, INPUT_METALLIC, context), vec2(1.0));
    b.metallic = kind.x;
    b.transmission = 0.0;
#ifdef HAS_TRANSMISSION
    b.transmission = kind.y;
#endif
#ifdef HAS_CLEARCOAT
    vec2 coat = min(material_numbers(m, INPUT_CLEARCOAT, context), vec2(1.0));
    b.coat = coat.x;
    b.coat_alpha = max(coat.yy * coat.yy, vec2(BSDF_SMOOTH));
#endif
#ifdef HAS_SHEEN
    b.sheen = min(material_color(m, INPUT_SHEEN, context), vec3(1.0));
    b.sheen_roughness = clamp(material_numbers(m, INPUT_SHEEN_ROUGHNESS, context).x, SHEEN_LEAST_ROUGHNESS, 1.0);
#endif
}
