// How much of a surface is there.
#include "detail/detail.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

float opacity_at(Detail detail, TextureContext context)
{
    float value = detail.opacity;
    if (detail.opacity_texture != NONE) value *= mean_component(texture_opacity(detail.opacity_texture, context).rgb);
    return detail.cutoff < 0.0 ? clamp(value, 0.0, 1.0) : value >= detail.cutoff ? 1.0 : 0.0;
}

// What is left of light that goes through where the surface is not there.
vec3 filter_at(Detail detail, TextureContext context)
{
    if (detail.filter_texture == NONE) return detail.filter_color;
    return detail.filter_color * clamp(texture_opacity(detail.filter_texture, context).rgb, 0.0, 1.0);
}
