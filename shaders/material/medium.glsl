// What fills the inside of glass: a path carries the material that it is inside of, or NONE.
#include "material/material.glsl"

vec3 medium_absorption(uint medium)
{
    return color_input_unpack(fetch_materials(medium * MATERIAL_WORDS + INPUT_ABSORPTION)).value;
}

// Beer's law along a way in the glass of a material, or in none.
vec3 medium_transmittance(uint medium, float way)
{
    return medium == NONE ? vec3(1.0) : exp(-medium_absorption(medium) * way);
}

// Whether a material is the boundary of glass with an inside.
bool medium_is_inside(uint kind, uint mode)
{
    return (kind == MATERIAL_DIELECTRIC || kind == MATERIAL_PRINCIPLED) && mode == DIELECTRIC_SOLID;
}

// The medium behind a surface that is met in `medium`, for a direction through it; `side` is its cosine with the geometric
// normal. A sheet has the same on both sides.
uint medium_beyond(uint medium, Bsdf b, uint material, float side)
{
    if (!medium_is_inside(b.kind, b.mode)) return medium;
    return side < 0.0 ? material : NONE;
}
