// What layers are at one point. Switches: HAS_METAL_INDEX, HAS_INTERFACE_TABLES.
#include "material/conductor.glsl"
#include "material/input.glsl"

void material_interface(inout Bsdf b, Material m, vec2 alpha)
{
    InterfaceInput of = interface_input_unpack(fetch_materials(m.at + INPUT_INTERFACE));
    b.through_table = of.through_table;
    b.inner_table = of.inner_table;
    b.through_mean = of.through_mean;
    b.coat_alpha = alpha;
}

// A rough interface tilts light by 1 − 1/η of the slope of a facet on its way in, and again on its way out, where the metal turns it
// by twice the slope: variances of slopes add, α² + (1 − 1/η)² α_interface² / 2.
void coated_conductor_widths(inout Bsdf b)
{
    if (max(b.coat_alpha.x, b.coat_alpha.y) < BSDF_SMOOTH) return;
    vec2 wider = (1.0 - 1.0 / b.ior) * b.coat_alpha;
    b.alpha = max(sqrt(b.alpha * b.alpha + 0.5 * wider * wider), vec2(BSDF_SMOOTH));
}

// The index of the metal is that in air, of which the interface leaves 1 / η.
void coated_conductor_index(inout Bsdf b)
{
#ifdef HAS_METAL_INDEX
    if (b.mode == FRESNEL_EXACT) {
        b.specular = vec3(1.0);
        b.k = conductor_k(b.color);
        b.mode = FRESNEL_INDEX;
    } else if (b.mode == FRESNEL_INDEX) {
        conductor_index(b);
    }
    b.specular /= b.ior;
    b.k /= b.ior;
#endif
}
