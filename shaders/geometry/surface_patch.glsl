// From a hit on a bilinear patch to the point on the surface that shading needs.
#include "geometry/instance.glsl"
#include "geometry/patch.glsl"
#include "geometry/surface_point.glsl"

// A normal of any length and its derivatives by the u and v of the patch.
struct PatchNormal { vec3 n; vec3 du; vec3 dv; };

PatchNormal patch_normal(Instance instance, BilinearPatch record, Bilinear b, vec2 uv)
{
    vec3 dpdu = bilinear_du(b, uv);
    vec3 dpdv = bilinear_dv(b, uv);
    // ∂²p/∂u² = ∂²p/∂v² = 0
    PatchNormal flat_normal = PatchNormal(cross(dpdu, dpdv), cross(dpdu, b.twist), cross(b.twist, dpdv));
    if (record.has_normals == 0u) return flat_normal;
    PatchNormals corners = patch_fetch_normals(instance.root);
    Bilinear n = bilinear_patch(corners.n00, corners.n10, corners.n01, corners.n11);
    return PatchNormal(bilinear_point(n, uv), bilinear_du(n, uv), bilinear_dv(n, uv));
}

// Texture coordinates at uv, and the derivatives of something by them from those by u and v; 0 where they have no direction.
struct PatchUv { vec2 uv; vec2 du; vec2 dv; float determinant; };

PatchUv patch_uv(BilinearPatch record, vec2 uv)
{
    vec2 du = mix(record.uv10 - record.uv00, record.uv11 - record.uv01, uv.y);
    vec2 dv = mix(record.uv01 - record.uv00, record.uv11 - record.uv10, uv.x);
    vec2 at = mix(mix(record.uv00, record.uv10, uv.x), mix(record.uv01, record.uv11, uv.x), uv.y);
    float determinant = du.x * dv.y - du.y * dv.x;
    return PatchUv(at, du, dv, abs(determinant) >= 1e-9 ? determinant : 0.0);
}

vec3 by_texture_u(PatchUv t, vec3 du, vec3 dv) { return t.determinant == 0.0 ? vec3(0.0) : (t.dv.y * du - t.du.y * dv) / t.determinant; }
vec3 by_texture_v(PatchUv t, vec3 du, vec3 dv) { return t.determinant == 0.0 ? vec3(0.0) : (t.du.x * dv - t.dv.x * du) / t.determinant; }

Surface patch_surface(Instance instance, float t, vec3 origin, vec3 direction)
{
    BilinearPatch record = patch_fetch(instance.root);
    vec3 o = object_point(instance, origin);
    vec3 d = object_vector(instance, direction);
    vec2 uv = bilinear_nearest(patch_from(record, o), normalize(d), t * length(d) / record.size).uv;
    Bilinear b = bilinear_patch(record.p00, record.p10, record.p01, record.p11);
    Surface s;
    s.object_position = record.size * bilinear_point(b, uv);
    s.position = world_point(instance, s.object_position);
    s.reach = world_reach(instance, 2.0 * record.size);
    vec3 dpdu = record.size * bilinear_du(b, uv);
    vec3 dpdv = record.size * bilinear_dv(b, uv);
    PatchUv texture_uv = patch_uv(record, uv);
    s.uv = texture_uv.uv;
    s.object_dpdu = by_texture_u(texture_uv, dpdu, dpdv);
    s.object_dpdv = by_texture_v(texture_uv, dpdu, dpdv);
    s.dpdu = world_vector(instance, s.object_dpdu);
    s.dpdv = world_vector(instance, s.object_dpdv);
    s.uv_rate = texture_uv.determinant == 0.0 ? vec2(0.0) : 1.0 / vec2(length(s.dpdu), length(s.dpdv));
    vec3 across = max_component(abs(dpdu)) > 0.0 ? dpdu : dpdv;
    s.object_rate = length(across) / length(world_vector(instance, across));
    s.geometric = normalize_or(world_normal(instance, cross(bilinear_du(b, uv), bilinear_dv(b, uv))), -direction);
    PatchNormal n = patch_normal(instance, record, b, uv);
    vec3 normal = world_normal(instance, n.n);
    s.normal = normalize_or(normal, s.geometric);
    s.dndu = unit_derivative(normal, world_normal(instance, by_texture_u(texture_uv, n.du, n.dv)));
    s.dndv = unit_derivative(normal, world_normal(instance, by_texture_v(texture_uv, n.du, n.dv)));
    if (dot(s.normal, s.geometric) < 0.0) {
        s.normal = -s.normal;
        s.dndu = -s.dndu;
        s.dndv = -s.dndv;
    }
    s.tangent = vec4(0.0);
    s.material = instance.material;
    s.light = instance.light;
    s.primitive = 0u;
    plain_corners(s);
    return s;
}
