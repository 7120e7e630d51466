// The shading normal with bumps and normal maps. Switches of the variant: HAS_BUMP, HAS_NORMAL_MAP.
#include "stages/event.glsl"
#include "detail/bump.glsl"
#include "detail/normal_map.glsl"

void relieve(inout Surface s, TextureContext context, vec3 to_viewer)
{
    Detail detail = detail_fetch(s.material);
    bool relieved = false;
#ifdef HAS_NORMAL_MAP
    if (detail.normal_texture != NONE) {
        float side = dot(cross(s.dpdu, s.dpdv), s.normal) < 0.0 ? -1.0 : 1.0;
        bool of_vertices = (detail.flags & DETAIL_VERTEX_TANGENTS) != 0u && s.tangent.xyz != vec3(0.0);
        s.normal = normal_map_normal(detail, context, s.normal, of_vertices ? s.tangent : vec4(s.dpdu, side));
        relieved = true;
    }
#endif
#ifdef HAS_BUMP
    if (detail.height_texture != NONE) {
        Base base = Base(s.normal, s.dpdu, s.dpdv, s.dndu, s.dndv, s.object_dpdu, s.object_dpdv);
        s.normal = bump_normal(detail, context, base);
        relieved = true;
    }
#endif
    if (!relieved) return;
    s.softened = (detail.flags & DETAIL_SOFT_TERMINATOR) != 0u;
    if ((detail.flags & DETAIL_VISIBLE) == 0u) return;
    float side = dot(to_viewer, s.geometric) < 0.0 ? -1.0 : 1.0;
    s.normal = side * visible_normal(side * s.normal, side * s.base_normal, to_viewer);
}

// What is left, at the edge of bumps, of light that is reflected towards wi.
float softening(Surface s, vec3 wi)
{
    return s.softened ? min(soft_terminator(dot(s.normal, s.base_normal), dot(wi, s.base_normal)), 1.0) : 1.0;
}
