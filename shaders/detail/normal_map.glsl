// Normals from a picture, and what keeps the light right where normals are not those of the geometry.
#include "detail/detail.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

// The normal of a map in the frame of tangent, bitangent and normal. Of the numbers of 8 bits, 127 and 128 are next to the
// middle: both count as 0, so that a flat map tilts nothing.
vec3 normal_map_local(Detail detail, TextureContext context)
{
    vec3 n = 2.0 * texture_evaluate(detail.normal_texture, context).rgb - 1.0;
    n.xy = mix(n.xy, vec2(0.0), lessThan(abs(n.xy), vec2(1.0 / 254.0)));
    if ((detail.flags & DETAIL_GREEN_DOWN) != 0u) n.y = -n.y;
    n.xy *= detail.strength;
    return normalize_or(n, vec3(0.0, 0.0, 1.0));
}

// `tangent` and the side of the bitangent: of the vertices, which MikkTSpace wants as they are, or along ∂p/∂u.
vec3 normal_map_normal(Detail detail, TextureContext context, vec3 normal, vec4 tangent)
{
    vec3 local = normal_map_local(detail, context);
    Basis basis = basis_along(normal, tangent.xyz);
    return normalize_or(basis.x * local.x + tangent.w * basis.y * local.y + normal * local.z, normal);
}

// A normal that is turned away from the viewer, to just before it faces away; or to where it was without bumps.
vec3 visible_normal(vec3 normal, vec3 base, vec3 to_viewer)
{
    float least = min(0.01, dot(base, to_viewer));
    float cosine = dot(normal, to_viewer);
    return cosine >= least ? normal : normalize(normal + (least - cosine) * to_viewer);
}

// How much light a bump keeps at the edge of its own shadow (Estevez, Lecocq and Stein 2019): `tilt` is the cosine of the angle
// between the normals with and without bumps, `cos_i` that of the light and the normal without.
float soft_terminator(float tilt, float cos_i)
{
    float tan2_d = (1.0 - sqr(tilt)) / max(sqr(tilt), 1e-8);
    float alpha2 = clamp(0.125 * tan2_d, 0.0, 1.0);
    float tan2_i = (1.0 - sqr(cos_i)) / max(sqr(cos_i), 1e-8);
    return 2.0 / (1.0 + sqrt(1.0 + alpha2 * tan2_i));
}
