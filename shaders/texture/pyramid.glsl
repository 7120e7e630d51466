// Pictures with a pyramid of levels, each half as large as the one below (Williams 1983, Pyramidal Parametrics): what a wide pixel
// sees of a picture is its mean there.
#include "texture/image.glsl"

// The picture with a level of its pyramid in its place.
ImageTexture level_of(ImageTexture image, uint w, uint level)
{
    ImageLevel l = image_level_unpack(fetch_textures(w + IMAGE_TEXTURE_WORDS + level));
    image.base = l.base;
    image.pitch = l.pitch;
    image.size = l.size;
    return image;
}

// The two levels whose texels are about as wide as the pixel, both bilinear, mixed. The first may be the picture itself.
vec4 image_texture_trilinear(uint w, uint format, TextureContext context)
{
    ImageTexture image = image_texture_fetch(w);
    vec2 st = image_place(image, context.uv);
    vec2 width = max(abs(image.uv_column0) * context.uv_footprint.x, abs(image.uv_column1) * context.uv_footprint.y);
    vec2 texels = width * vec2(image.size);
    uint last = (image.flags >> LEVELS_SHIFT) - 1u;
    float level = min(log2(max(max(texels.x, texels.y), 1.0)), float(last));
    uint fine = uint(level);
    vec4 near = picture_lookup(level_of(image, w, fine), format, fine > 0u, false, st);
    vec4 far = picture_lookup(level_of(image, w, min(fine + 1u, last)), format, true, false, st);
    return image_value(image, mix(near, far, level - float(fine)));
}
