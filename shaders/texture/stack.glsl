// Volumes of texels: slices in the atlas, one below the other.
#include "texture/image.glsl"

// The texel in column, row from the bottom and slice, each wrapped to be in range.
vec4 stack_texel(Stack stack, ImageTexture slice, uint format, uvec3 at, bool outside)
{
    slice.base = stack.base + at.z * stack.slice_words;
    return outside ? vec4(0.0) : texel(slice, format, false, at.x, stack.size.y - 1u - at.y);
}

// Bilinear in a slice, between two columns and two rows.
vec4 stack_plane(Stack stack, ImageTexture slice, uint format, uvec4 at, uint z, vec2 f, bvec4 outside, bool beyond)
{
    vec4 t00 = stack_texel(stack, slice, format, uvec3(at.x, at.y, z), outside.x || outside.y || beyond);
    vec4 t10 = stack_texel(stack, slice, format, uvec3(at.z, at.y, z), outside.z || outside.y || beyond);
    vec4 t01 = stack_texel(stack, slice, format, uvec3(at.x, at.w, z), outside.x || outside.w || beyond);
    vec4 t11 = stack_texel(stack, slice, format, uvec3(at.z, at.w, z), outside.z || outside.w || beyond);
    return mix(mix(t00, t10, f.x), mix(t01, t11, f.x), f.y);
}

// The texture whose Stack record starts at word w, at a point of its cube. The limit keeps the place of a wild point within an int.
vec4 stack_texture(uint w, uint format, vec3 p)
{
    Stack stack = stack_unpack(fetch_textures(w), fetch_textures(w + 1u));
    ImageTexture slice = ImageTexture(0u, stack.pitch, stack.size.xy, vec2(0.0), vec2(0.0), vec2(0.0), stack.scale, stack.flags);
    vec3 place = clamp(p, -16384.0, 16384.0) * vec3(stack.size);
    bool nearest = (stack.flags & FLAG_NEAREST) != 0u;
    vec3 from = nearest ? place : place - 0.5;
    vec3 corner = floor(from);
    vec3 f = from - corner;
    ivec3 i = ivec3(corner);
    bvec2 outside_x;
    bvec2 outside_y;
    bvec2 outside_z;
    uvec2 x = wrap_pair(i.x, int(stack.size.x), stack.flags & WRAP_MASK, outside_x);
    uvec2 y = wrap_pair(i.y, int(stack.size.y), (stack.flags >> WRAP_V_SHIFT) & WRAP_MASK, outside_y);
    uvec2 z = wrap_pair(i.z, int(stack.size.z), (stack.flags >> WRAP_W_SHIFT) & WRAP_MASK, outside_z);
    if (nearest) {
        bool outside = outside_x.x || outside_y.x || outside_z.x;
        return image_value(slice, stack_texel(stack, slice, format, uvec3(x.x, y.x, z.x), outside));
    }
    uvec4 at = uvec4(x.x, y.x, x.y, y.y);
    bvec4 across = bvec4(outside_x.x, outside_y.x, outside_x.y, outside_y.y);
    vec4 below = stack_plane(stack, slice, format, at, z.x, f.xy, across, outside_z.x);
    vec4 above = stack_plane(stack, slice, format, at, z.y, f.xy, across, outside_z.y);
    return image_value(slice, mix(below, above, f.z));
}
