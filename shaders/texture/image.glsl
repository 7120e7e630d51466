// Pictures in the atlas: our own wrapping and filtering, so that a value does not depend on a driver.
#include "shared/bindings.glsl"
#include "texture/context.glsl"

ImageTexture image_texture_fetch(uint w)
{
    return image_texture_unpack(fetch_textures(w), fetch_textures(w + 1u), fetch_textures(w + 2u));
}

// IEC 61966-2-1.
vec3 srgb_decode(vec3 c)
{
    vec3 low = c * (1.0 / 12.92);
    vec3 high = pow((c + 0.055) * (1.0 / 1.055), vec3(2.4));
    return vec3(c.x <= 0.04045 ? low.x : high.x, c.y <= 0.04045 ? low.y : high.y, c.z <= 0.04045 ? low.z : high.z);
}

uint lane_of(uvec4 word, uint lane)
{
    uint low = lane == 0u ? word.x : word.y;
    uint high = lane == 2u ? word.z : word.w;
    return lane < 2u ? low : high;
}

vec4 halves_of(uvec4 word, uint x)
{
    uvec2 halves = (x & 1u) == 0u ? word.xy : word.zw;
    return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

// The texel in column x and row y (row 0 on top), both in range; the generated code knows the TEXELS_… format.
// Levels of a pyramid above the picture itself are `coarse`: halves, where the picture is bytes.
vec4 texel(ImageTexture image, uint format, bool coarse, uint x, uint y)
{
    if (format == TEXELS_RGBA32F) return uintBitsToFloat(fetch_texels(image.base + y * image.pitch + x));
    if (format == TEXELS_RGBA16F) {
        return halves_of(fetch_texels(image.base + y * image.pitch + (x >> 1)), x);
    }
    uvec4 word = fetch_texels(image.base + (y >> (coarse ? 0u : 1u)) * image.pitch + (x >> 1));
    if (coarse) return halves_of(word, x);
    vec4 value = unpackUnorm4x8(lane_of(word, (x & 1u) + 2u * (y & 1u)));
    if (format == TEXELS_RGBA8_SRGB) value.rgb = srgb_decode(value.rgb);
    return value;
}

// A texel index outside 0..n to one inside; `outside` is set where the picture is black.
uint wrap_index(int i, int n, uint mode, inout bool outside)
{
    // Division is not exact on every device: the quotient may be off by one
    int turns = int(floor(float(i) / float(n)));
    int rest = i - turns * n;
    int off = rest < 0 ? -1 : rest >= n ? 1 : 0;
    turns += off;
    rest = clamp(rest - off * n, 0, n - 1);
    if (mode == WRAP_REPEAT) return uint(rest);
    if (mode == WRAP_MIRROR) return uint((turns & 1) == 0 ? rest : n - 1 - rest);
    outside = outside || (mode == WRAP_BLACK && (i < 0 || i >= n));
    return uint(clamp(i, 0, n - 1));
}

#ifdef OCTAHEDRAL_PICTURES
// Beyond an edge of an octahedral map comes the row along that edge, turned about its middle.
ivec2 octahedral_place(ivec2 at, ivec2 size)
{
    if (at.x < 0 || at.x >= size.x) at = ivec2(at.x < 0 ? -1 - at.x : 2 * size.x - 1 - at.x, size.y - 1 - at.y);
    if (at.y < 0 || at.y >= size.y) at = ivec2(size.x - 1 - at.x, at.y < 0 ? -1 - at.y : 2 * size.y - 1 - at.y);
    return at;
}
#endif

vec4 wrapped_texel(ImageTexture image, uint format, bool coarse, ivec2 at)
{
    bool outside = false;
#ifdef OCTAHEDRAL_PICTURES
    if ((image.flags & FLAG_OCTAHEDRAL) != 0u) at = octahedral_place(at, ivec2(image.size));
#endif
    uint x = wrap_index(at.x, int(image.size.x), image.flags & WRAP_MASK, outside);
    uint y = wrap_index(at.y, int(image.size.y), (image.flags >> WRAP_V_SHIFT) & WRAP_MASK, outside);
    return outside ? vec4(0.0) : texel(image, format, coarse, x, y);
}

// uv of the surface to that of the picture. The limit keeps the place of a wild uv within what an int holds.
vec2 image_place(ImageTexture image, vec2 uv)
{
    return clamp(image.uv_column0 * uv.x + image.uv_column1 * uv.y + image.uv_offset, -16384.0, 16384.0);
}

// Texel centres are at (i + ½) / n, and each of the four texels is wrapped by itself.
vec4 bilinear_lookup(ImageTexture image, uint format, bool coarse, vec2 st)
{
    vec2 p = vec2(st.x, 1.0 - st.y) * vec2(image.size) - 0.5;
    vec2 corner = floor(p);
    vec2 f = p - corner;
    ivec2 i = ivec2(corner);
    vec4 top = mix(wrapped_texel(image, format, coarse, i), wrapped_texel(image, format, coarse, i + ivec2(1, 0)), f.x);
    i.y += 1;
    vec4 bottom = mix(wrapped_texel(image, format, coarse, i), wrapped_texel(image, format, coarse, i + ivec2(1, 0)), f.x);
    return mix(top, bottom, f.y);
}

vec4 image_lookup(ImageTexture image, uint format, vec2 uv)
{
    vec2 st = image_place(image, uv);
    if ((image.flags & FLAG_NEAREST) != 0u) {
        // Rows are counted from the top, but [0, 1) is inside: v = 0 is in the last row, v = 1 is not in the first
        ivec2 at = ivec2(floor(st * vec2(image.size)));
        return wrapped_texel(image, format, false, ivec2(at.x, int(image.size.y) - 1 - at.y));
    }
    return bilinear_lookup(image, format, false, st);
}

// Channel, inversion and factor of a texture. Alpha is kept.
vec4 image_value(ImageTexture image, vec4 value)
{
    uint channel = (image.flags >> CHANNEL_SHIFT) & CHANNEL_MASK;
    if (channel == CHANNEL_R) value.rgb = value.rrr;
    if (channel == CHANNEL_G) value.rgb = value.ggg;
    if (channel == CHANNEL_B) value.rgb = value.bbb;
    if (channel == CHANNEL_A) value.rgb = value.aaa;
    if ((image.flags & FLAG_INVERT) != 0u) value.rgb = 1.0 - value.rgb;
    return vec4(value.rgb * image.scale, value.a);
}

// The texture whose record starts at word w.
vec4 image_texture(uint w, uint format, TextureContext context)
{
    ImageTexture image = image_texture_fetch(w);
    return image_value(image, image_lookup(image, format, context.uv));
}
