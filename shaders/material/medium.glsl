// What fills the inside of glass: a path carries the material that it is inside of, or NONE.
#include "material/bsdf.glsl"
#include "shared/bindings.glsl"

// Beer's law along a way in the glass of a material, or in none.
vec3 medium_transmittance(uint medium, float way)
{
    return medium == NONE ? vec3(1.0) : exp(-uintBitsToFloat(fetch_materials(medium * MATERIAL_WORDS + 2u).xyz) * way);
}

// The medium behind a boundary of glass, for a direction through it; `side` is its cosine with the geometric normal.
uint medium_beyond(Bsdf b, uint material, float side) { return b.mode != 1u && side < 0.0 ? material : NONE; }
