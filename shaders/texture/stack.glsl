// Volumes of texels: slices in the atlas, one below the other.
#include "texture/image.glsl"

// The texel in column, row from the bottom and slice, each wrapped to be in range.
vec4 stack_texel(Stack stack, ImageTexture slice, uint format, uvec3 at, bool outside)
{
    slice.base = stack.base + at.z * stack.slice_words;
    return outside ? vec4(0.0) : texel(slice, format, false, at.x, stack.size.y - 1u - at.y);
}

uvec3 stack_wrap(Stack stack, ivec3 at, out bvec3 outside)
{
    bool x = false;
    bool y = false;
    bool z = false;
    uvec3 inside = uvec3(wrap_index(at.x, int(stack.size.x), stack.flags & WRAP_MASK, x),
                         wrap_index(at.y, int(stack.size.y), (stack.flags >> WRAP_V_SHIFT) & WRAP_MASK, y),
                         wrap_index(at.z, int(stack.size.z), (stack.flags >> WRAP_W_SHIFT) & WRAP_MASK, z));
    outside = bvec3(x, y, z);
    return inside;
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
    bvec3 out0;
    bvec3 out1;
    if ((stack.flags & FLAG_NEAREST) != 0u) {
        uvec3 at = stack_wrap(stack, ivec3(floor(place)), out0);
        return image_value(slice, stack_texel(stack, slice, format, at, any(out0)));
    }
    vec3 corner = floor(place - 0.5);
    vec3 f = place - 0.5 - corner;
    uvec3 a = stack_wrap(stack, ivec3(corner), out0);
    uvec3 b = stack_wrap(stack, ivec3(corner) + 1, out1);
    bvec4 across = bvec4(out0.xy, out1.xy);
    vec4 below = stack_plane(stack, slice, format, uvec4(a.xy, b.xy), a.z, f.xy, across, out0.z);
    vec4 above = stack_plane(stack, slice, format, uvec4(a.xy, b.xy), b.z, f.xy, across, out1.z);
    return image_value(slice, mix(below, above, f.z));
}
