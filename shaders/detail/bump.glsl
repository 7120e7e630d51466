// Bump mapping (Blinn 1978): the normal of the surface Q = P + h n for a height h that is given as a texture.
// Q_u × Q_v = P_u × P_v + h_v (P_u × n) + h_u (n × P_v), but for the bend of the surface itself, h ∂n/∂u and h ∂n/∂v.
#include "detail/detail.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

// The surface without bumps; derivatives by u and v, of the second set where the picture of the height is placed by that (HAS_UV1).
struct Base {
    vec3 normal;
    vec3 dpdu;
    vec3 dpdv;
    vec3 dndu;
    vec3 dndv;
    vec3 object_dpdu;
    vec3 object_dpdv;
#ifdef HAS_UV1
    mat2 uv_by_step;  // by how much the first set changes
    mat2 uv1_by_step; // and the second
#endif
};

// A height and its derivatives by u and v.
struct Slope { float height; float du; float dv; };

float bump_height(Detail detail, TextureContext context, Base base, vec2 uv_step)
{
#ifdef HAS_UV1
    context.uv += base.uv_by_step * uv_step;
    context.uv1 += base.uv1_by_step * uv_step;
#else
    context.uv += uv_step;
#endif
    context.position += uv_step.x * base.dpdu + uv_step.y * base.dpdv;
    context.object_position += uv_step.x * base.object_dpdu + uv_step.y * base.object_dpdv;
    return detail.height * mean_component(texture_height(detail.height_texture, context).rgb);
}

// uv of a step of one along each axis.
mat2 bump_steps(Detail detail, TextureContext context, Base base)
{
    if (detail.derivative != DERIVATIVE_CENTRAL) return mat2(detail.step_x, detail.step_y);
    // Half a pixel; or as little as positions, which are floats, can tell in a height
    vec3 size = abs(context.position);
    float way = max(0.5 * context.footprint, max(max_component(size), 1e-3) * (1.0 / 4096.0));
    return mat2(way / max(length(base.dpdu), 1e-20), 0.0, 0.0, way / max(length(base.dpdv), 1e-20));
}

// Rule by rule: where the height is looked up, in steps, and what it adds to the derivatives by a step, and to the height.
Slope bump_slope(Detail detail, TextureContext context, Base base)
{
    mat2 steps = bump_steps(detail, context, base);
    vec2 uv = context.uv;
#ifdef HAS_UV1
    if ((detail.flags & DETAIL_HEIGHT_UV1) != 0u) uv = context.uv1;
#endif
    vec2 inside = fract(inverse(steps) * uv + detail.steps_at_zero);
    bool kernel = detail.derivative == DERIVATIVE_KERNEL;
    bool forward = detail.derivative == DERIVATIVE_FORWARD;
    uint count = kernel ? 9u : forward ? 3u : 4u;
    vec2 by_step = vec2(0.0);
    float height = 0.0;
    for (uint i = 0u; i < count; ++i) {
        // Pairs of opposite places, along the first axis and then the second
        float side = (i & 1u) == 0u ? -1.0 : 1.0;
        vec2 axis = i < 2u ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
        vec2 at = side * axis;
        vec2 weight = 0.5 * at;
        float share = 0.25;
        if (detail.derivative == DERIVATIVE_BILINEAR) {
            // Between two texels of a row or column the height is a straight line
            at = axis * ((side < 0.0 ? 0.0 : 1.0) - inside);
            weight = side * axis;
            share = 0.5 * (1.0 - abs(dot(at, axis)));
        }
        if (kernel) {
            at = vec2(i % 3u, i / 3u) - 1.0;
            weight = at / 6.0;
            share = i == 4u ? 1.0 : 0.0;
        }
        if (forward) {
            at = vec2(i == 1u, i == 2u);
            weight = i == 0u ? vec2(-1.0) : at;
            share = i == 0u ? 1.0 : 0.0;
        }
        float h = bump_height(detail, context, base, steps * at);
        by_step += weight * h;
        height += share * h;
    }
    vec2 by_uv = by_step * inverse(steps);
    return Slope(height, by_uv.x, by_uv.y);
}

// Normal of the surface with bumps, on the side of `base.normal`, not of unit length.
vec3 bump_cross(Base base, Slope slope, bool curvature)
{
    // Along the surface: what is left of ∂p/∂u and ∂p/∂v, so that a flat map leaves the normal as it is
    vec3 n = base.normal;
    vec3 p_u = base.dpdu - n * dot(n, base.dpdu);
    vec3 p_v = base.dpdv - n * dot(n, base.dpdv);
    float side = dot(cross(p_u, p_v), n) < 0.0 ? -1.0 : 1.0;
    if (!curvature) return side * (cross(p_u, p_v) + slope.dv * cross(p_u, n) + slope.du * cross(n, p_v));
    vec3 q_u = p_u + slope.du * n + slope.height * base.dndu;
    vec3 q_v = p_v + slope.dv * n + slope.height * base.dndv;
    vec3 q = side * cross(q_u, q_v);
    return dot(q, n) < 0.0 ? -q : q;
}

vec3 bump_normal(Detail detail, TextureContext context, Base base)
{
    Slope slope = bump_slope(detail, context, base);
    return normalize_or(bump_cross(base, slope, (detail.flags & DETAIL_CURVATURE) != 0u), base.normal);
}
