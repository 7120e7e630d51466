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

// Two neighbours i and i + 1, which may be outside 0..n, to indices inside; `outside` says where the picture is black.
uvec2 wrap_pair(int i, int n, uint mode, out bvec2 outside)
{
    // Division is not exact on every device: the quotient may be off by one
    int turns = int(floor(float(i) / float(n)));
    int rest = i - turns * n;
    int off = rest < 0 ? -1 : rest >= n ? 1 : 0;
    turns += off;
    rest = clamp(rest - off * n, 0, n - 1);
    bool last = rest == n - 1;
    ivec2 both = ivec2(i, i + 1);
    ivec2 inside = ivec2(rest, last ? 0 : rest + 1);
    outside = bvec2(false);
    if (mode == WRAP_MIRROR) {
        bvec2 turned = bvec2((turns & 1) != 0, ((last ? turns + 1 : turns) & 1) != 0);
        inside = mix(inside, n - 1 - inside, turned);
    } else if (mode != WRAP_REPEAT) {
        inside = clamp(both, 0, n - 1);
        if (mode == WRAP_BLACK) outside = notEqual(both, inside);
    }
    return uvec2(inside);
}

#ifdef OCTAHEDRAL_PICTURES
// Beyond an edge of an octahedral map comes the row along that edge, turned about its middle.
ivec2 octahedral_place(ivec2 at, ivec2 size)
{
    if (at.x < 0 || at.x >= size.x) at = ivec2(at.x < 0 ? -1 - at.x : 2 * size.x - 1 - at.x, size.y - 1 - at.y);
    if (at.y < 0 || at.y >= size.y) at = ivec2(size.x - 1 - at.x, at.y < 0 ? -1 - at.y : 2 * size.y - 1 - at.y);
    return at;
}

// The same for four neighbours, of which i is the first.
void octahedral_places(ivec2 i, ivec2 size, out uvec4 column, out uvec4 row)
{
    uvec2 p00 = uvec2(octahedral_place(i, size));
    uvec2 p10 = uvec2(octahedral_place(i + ivec2(1, 0), size));
    uvec2 p01 = uvec2(octahedral_place(i + ivec2(0, 1), size));
    uvec2 p11 = uvec2(octahedral_place(i + ivec2(1, 1), size));
    column = uvec4(p00.x, p10.x, p01.x, p11.x);
    row = uvec4(p00.y, p10.y, p01.y, p11.y);
}
#endif

// uv of the surface to that of the picture. The limit keeps the place of a wild uv within what an int holds.
vec2 image_place(ImageTexture image, vec2 uv)
{
    return clamp(image.uv_column0 * uv.x + image.uv_column1 * uv.y + image.uv_offset, -16384.0, 16384.0);
}

// Texel centres are at (i + ½) / n, and each of the four texels is wrapped by itself; or the texel that the place is in.
vec4 picture_lookup(ImageTexture image, uint format, bool coarse, bool nearest, vec2 st)
{
    vec2 size = vec2(image.size);
    vec2 p = vec2(st.x, 1.0 - st.y) * size - 0.5;
    // Rows are counted from the top, but [0, 1) is inside: v = 0 is in the last row, v = 1 is not in the first
    if (nearest) p = vec2(floor(st.x * size.x), size.y - 1.0 - floor(st.y * size.y));
    vec2 corner = floor(p);
    vec2 f = p - corner;
    ivec2 i = ivec2(corner);
    bvec2 outside_x;
    bvec2 outside_y;
    uvec2 x = wrap_pair(i.x, int(image.size.x), image.flags & WRAP_MASK, outside_x);
    uvec2 y = wrap_pair(i.y, int(image.size.y), (image.flags >> WRAP_V_SHIFT) & WRAP_MASK, outside_y);
    uvec4 column = x.xyxy;
    uvec4 row = y.xxyy;
#ifdef OCTAHEDRAL_PICTURES
    if ((image.flags & FLAG_OCTAHEDRAL) != 0u) octahedral_places(i, ivec2(image.size), column, row);
#endif
    vec4 t00 = outside_x.x || outside_y.x ? vec4(0.0) : texel(image, format, coarse, column.x, row.x);
    if (nearest) return t00;
    vec4 t10 = outside_x.y || outside_y.x ? vec4(0.0) : texel(image, format, coarse, column.y, row.y);
    vec4 t01 = outside_x.x || outside_y.y ? vec4(0.0) : texel(image, format, coarse, column.z, row.z);
    vec4 t11 = outside_x.y || outside_y.y ? vec4(0.0) : texel(image, format, coarse, column.w, row.w);
    return mix(mix(t00, t10, f.x), mix(t01, t11, f.x), f.y);
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
    bool nearest = (image.flags & FLAG_NEAREST) != 0u;
    return image_value(image, picture_lookup(image, format, false, nearest, image_place(image, context.uv)));
}
