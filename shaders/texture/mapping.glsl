// Switch of the variant: HAS_UV1.
// Texture coordinates in place of those of the surface: each function gives the context with a uv and the width of the pixel in u and v.
#include "shared/bindings.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"

Mapping mapping_fetch(uint w)
{
    return mapping_unpack(fetch_textures(w), fetch_textures(w + 1u), fetch_textures(w + 2u), fetch_textures(w + 3u));
}

vec3 mapped_point(Mapping m, vec3 p) { return vec3(dot(m.row0, vec4(p, 1.0)), dot(m.row1, vec4(p, 1.0)), dot(m.row2, vec4(p, 1.0))); }

// A width there, along the axis that grows most.
float mapped_width(Mapping m, float width) { return width * max(length(m.row0.xyz), max(length(m.row1.xyz), length(m.row2.xyz))); }

// Normals go by the inverse transpose.
vec3 mapped_normal(Mapping m, vec3 n)
{
    return vec3(dot(cross(m.row1.xyz, m.row2.xyz), n), dot(cross(m.row2.xyz, m.row0.xyz), n), dot(cross(m.row0.xyz, m.row1.xyz), n));
}

TextureContext context_with(TextureContext context, vec2 uv, vec2 width)
{
    context.uv = uv;
    context.uv_footprint = width;
    return context;
}

TextureContext mapped_uv(Mapping m, vec3 p, float width, TextureContext context) { return context; }

#ifdef HAS_UV1
TextureContext mapped_uv1(Mapping m, vec3 p, float width, TextureContext context)
{
    return context_with(context, context.uv1, context.uv1_footprint);
}
#endif

// Longitude in turns; on the axis, where it has none, what the scene says.
float longitude(Mapping m, vec2 p) { return p == vec2(0.0) ? m.pole_u : turns(p); }

TextureContext mapped_spherical(Mapping m, vec3 p, float width, TextureContext context)
{
    p = mapped_point(m, p);
    // At a pole a picture is seen squeezed, not blurred: there u counts as on the equator
    float angle = mapped_width(m, width) / max(length(p), 1e-30);
    vec2 uv = vec2(longitude(m, p.xy), latitude_v(p.z, length(p.xy)));
    return context_with(context, uv, angle * vec2(INV_TWO_PI, INV_PI));
}

TextureContext mapped_cylindrical(Mapping m, vec3 p, float width, TextureContext context)
{
    p = mapped_point(m, p);
    float wide = mapped_width(m, width);
    return context_with(context, vec2(longitude(m, p.xy), p.z), wide * vec2(INV_TWO_PI / max(length(p.xy), 1e-30), 1.0));
}

TextureContext mapped_planar(Mapping m, vec3 p, float width, TextureContext context)
{
    return context_with(context, mapped_point(m, p).xy, width * vec2(length(m.row0.xyz), length(m.row1.xyz)));
}

// A face is upright seen from outside, with y up; on top z is at the lower edge, below at the upper.
TextureContext mapped_cube(Mapping m, vec3 p, float width, TextureContext context)
{
    p = mapped_point(m, p);
    vec3 size = abs(p);
    bool along_x = size.x >= size.y && size.x >= size.z;
    bool along_y = !along_x && size.y >= size.z;
    float side = (along_x ? p.x : along_y ? p.y : p.z) < 0.0 ? -1.0 : 1.0;
    float far = max(max_component(size), 1e-30);
    vec2 face = along_x ? vec2(-side * p.z, p.y) : along_y ? vec2(p.x, -side * p.z) : vec2(side * p.x, p.y);
    return context_with(context, 0.5 + 0.5 * face / far, vec2(0.5 * mapped_width(m, width) / far));
}

// Planes across x, y and z, upright seen from the side that the surface faces.
TextureContext mapped_x(Mapping m, vec3 p, float width, vec3 normal, TextureContext context)
{
    p = mapped_point(m, p);
    float side = mapped_normal(m, normal).x < 0.0 ? -1.0 : 1.0;
    return context_with(context, vec2(-side * p.z, p.y), vec2(mapped_width(m, width)));
}

TextureContext mapped_y(Mapping m, vec3 p, float width, vec3 normal, TextureContext context)
{
    p = mapped_point(m, p);
    float side = mapped_normal(m, normal).y < 0.0 ? -1.0 : 1.0;
    return context_with(context, vec2(p.x, -side * p.z), vec2(mapped_width(m, width)));
}

TextureContext mapped_z(Mapping m, vec3 p, float width, vec3 normal, TextureContext context)
{
    p = mapped_point(m, p);
    float side = mapped_normal(m, normal).z < 0.0 ? -1.0 : 1.0;
    return context_with(context, vec2(side * p.x, p.y), vec2(mapped_width(m, width)));
}

vec4 triplanar_mix(Mapping m, vec3 normal, vec4 x, vec4 y, vec4 z)
{
    // By the largest: the power of a small number may be 0, and a pow of 0 is not defined
    vec3 n = abs(mapped_normal(m, normal));
    n = n / max(max_component(n), 1e-30);
    vec3 weight = exp2(m.sharpness * log2(max(n, 1e-6)));
    return (x * weight.x + y * weight.y + z * weight.z) / (weight.x + weight.y + weight.z);
}

// Overlap and blend: a picture holds 1 + ω turns, of which the part beyond one turn is faded into the beginning. The place of a
// point in the first turn, and a turn later.
TextureContext seam_turn(TextureContext context, float blend, float turn)
{
    context.uv.x = (context.uv.x - floor(context.uv.x) + turn) / (1.0 + blend);
    context.uv_footprint.x /= 1.0 + blend;
    return context;
}

vec4 seam_mix(TextureContext context, float blend, vec4 start, vec4 end)
{
    float share = clamp((context.uv.x - floor(context.uv.x)) / blend, 0.0, 1.0);
    return mix(end, start, share * share * (3.0 - 2.0 * share));
}
