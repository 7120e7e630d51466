// The shading normal with bumps and normal maps. Switches of the variant: HAS_BUMP, HAS_NORMAL_MAP, HAS_UV1.
#include "stages/event.glsl"
#include "detail/bump.glsl"
#include "detail/normal_map.glsl"

#if defined(HAS_UV1) && defined(HAS_BUMP)
// The surface by its second uv, where the picture of a relief is placed by that.
void parametrize(inout Base base, Surface s, bool second)
{
    mat2 back = abs(determinant(s.uv_by_uv1)) > 0.0 ? inverse(s.uv_by_uv1) : mat2(0.0);
    base.uv_by_step = second ? s.uv_by_uv1 : mat2(1.0);
    base.uv1_by_step = second ? mat2(1.0) : back;
    if (!second) return;
    mat2x3 dp = by_uv1(s, s.dpdu, s.dpdv);
    mat2x3 dn = by_uv1(s, s.dndu, s.dndv);
    mat2x3 object_dp = by_uv1(s, s.object_dpdu, s.object_dpdv);
    base.dpdu = dp[0];
    base.dpdv = dp[1];
    base.dndu = dn[0];
    base.dndv = dn[1];
    base.object_dpdu = object_dp[0];
    base.object_dpdv = object_dp[1];
}
#endif

void relieve(inout Surface s, TextureContext context, vec3 to_viewer)
{
    Detail detail = detail_fetch(s.material);
    bool relieved = false;
#ifdef HAS_NORMAL_MAP
    if (detail.normal_texture != NONE) {
        vec3 along = s.dpdu;
        vec3 across = s.dpdv;
#ifdef HAS_UV1
        if ((detail.flags & DETAIL_NORMAL_UV1) != 0u) {
            mat2x3 second = by_uv1(s, along, across);
            along = second[0];
            across = second[1];
        }
#endif
        float side = dot(cross(along, across), s.normal) < 0.0 ? -1.0 : 1.0;
        bool of_vertices = (detail.flags & DETAIL_VERTEX_TANGENTS) != 0u && s.tangent.xyz != vec3(0.0);
        s.normal = normal_map_normal(detail, context, s.normal, of_vertices ? s.tangent : vec4(along, side));
        relieved = true;
    }
#endif
#ifdef HAS_BUMP
    if (detail.height_texture != NONE) {
        Base base = Base(s.normal, s.dpdu, s.dpdv, s.dndu, s.dndv, s.object_dpdu, s.object_dpdv
#ifdef HAS_UV1
                         , mat2(1.0), mat2(1.0)
#endif
                         );
#ifdef HAS_UV1
        parametrize(base, s, (detail.flags & DETAIL_HEIGHT_UV1) != 0u);
#endif
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
