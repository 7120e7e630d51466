// What a material is made of: a head, and colours and numbers that textures may drive.
// TEXTURED_INPUTS is a switch of the variant: two bits for each INPUT_…, for a colour or the first number, and for the second.
#include "shared/bindings.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

#ifndef TEXTURED_INPUTS
#define TEXTURED_INPUTS 0u
#endif

struct Material {
    uint kind;  // MATERIAL_…
    uint mode;  // FRESNEL_…, or DIELECTRIC_…
    uint flags; // MATERIAL_…
    float dispersion; // 1 / Abbe number
    uint at;    // word of its head
};

Material material_fetch(uint i)
{
    MaterialHead head = material_head_unpack(fetch_materials(i * MATERIAL_WORDS));
    return Material(head.kind, head.mode, head.flags, head.dispersion, i * MATERIAL_WORDS);
}

// Whether a texture drives an input, or one of its two numbers, of some material of the scene. Where none does, drivers
// see a constant, and leave the textures out.
bool input_textured(uint place, uint which) { return ((TEXTURED_INPUTS >> (2u * place + which)) & 1u) != 0u; }

// A number of a BSDF of the table: what a texture gives is kept in its range.
float bsdf_number(float value, uint which, float least, float most)
{
    return input_textured(INPUT_INDEX, which) ? clamp(value, least, most) : value;
}

vec3 material_color(Material m, uint place, TextureContext context)
{
    ColorInput of = color_input_unpack(fetch_materials(m.at + place));
    if (!input_textured(place, 0u) || of.texture == NONE) return of.value;
    return of.value * max(texture_evaluate(of.texture, context).rgb, vec3(0.0));
}

// A number of a material: the mean of a texture's red, green and blue.
float material_number(float value, uint texture_reference, bool textured, TextureContext context)
{
    if (!textured || texture_reference == NONE) return value;
    return value * max(mean_component(texture_evaluate(texture_reference, context).rgb), 0.0);
}

vec2 material_numbers(Material m, uint place, TextureContext context)
{
    NumberInputs of = number_inputs_unpack(fetch_materials(m.at + place));
    return vec2(material_number(of.first, of.first_texture, input_textured(place, 0u), context),
                material_number(of.second, of.second_texture, input_textured(place, 1u), context));
}
