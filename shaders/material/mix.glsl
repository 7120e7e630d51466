// A mix of two materials: each scattering event is one of the two, picked with the amount as chance, so that all that is asked
// of the event is asked of one material. Switches: HAS_MIX; MIX_DEPTH, how many mixes are one in the other.
#include "material/input.glsl"

// The material that is no mix. What is left of `pick` after a choice is used again.
uint mix_pick(uint material, TextureContext context, float pick)
{
#ifdef HAS_MIX
    for (uint level = 0u; level < MIX_DEPTH; ++level) {
        Material m = material_fetch(material);
        MixInput of = mix_input_unpack(fetch_materials(m.at + INPUT_MIX));
        float amount = material_number(of.amount, of.amount_texture, input_textured(INPUT_MIX, 0u), context);
        amount = clamp(amount, 0.0, 1.0);
        bool second = pick < amount;
        if (m.kind == MATERIAL_MIX) {
            material = second ? of.second : of.first;
            pick = second ? pick / amount : (pick - amount) / (1.0 - amount);
        }
    }
#endif
    return material;
}
