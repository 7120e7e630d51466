// From a hit on a triangle to the point on the surface that shading needs.
#include "shared/bindings.glsl"
#include "base/offset.glsl"
#include "geometry/instance.glsl"
#include "geometry/triangle.glsl"
#include "geometry/surface_point.glsl"
#include "texture/corners.glsl"

Vertex vertex_fetch(uint i) { return vertex_unpack(fetch_vertices(i * VERTEX_WORDS), fetch_vertices(i * VERTEX_WORDS + 1u)); }

Triangle triangle_fetch(uint i)
{
    uint w = i * ITEM_WORDS;
    return triangle_unpack(fetch_tree(w), fetch_tree(w + 1u), fetch_tree(w + 2u));
}

// What only textures ask, from `extra` of the face, or what it is without. du and dv are the edges of the first uv.
void corners_surface(inout Surface s, uint extra, vec2 bary, vec2 du, vec2 dv)
{
    plain_corners(s);
    if (extra == NONE) return;
#ifdef HAS_VERTEX_COLOR
    s.vertex_color = corner_color(extra, bary);
#endif
#ifdef HAS_UV1
    CornerUvs of = corner_uvs(extra);
    mat2 edges = mat2(of.b - of.a, of.c - of.a);
    s.uv1 = corner_uv(of, bary);
    s.uv_by_uv1 = abs(determinant(edges)) >= 1e-9 ? mat2(du, dv) * inverse(edges) : mat2(0.0);
#endif
}

// A point on a triangle: `to_world` is true when the triangle is in object space.
Surface triangle_surface(uint index, Instance instance, bool to_world, vec3 origin, vec3 direction)
{
    Surface s;
    Triangle triangle = triangle_fetch(index);
    vec3 o = to_world ? object_point(instance, origin) : origin;
    vec3 d = to_world ? object_vector(instance, direction) : direction;
    float t;
    vec2 bary;
    triangle_hit(triangle.a, triangle.b, triangle.c, triangle_ray(o, d), FAR, t, bary);
    vec3 ab = triangle.b - triangle.a;
    vec3 ac = triangle.c - triangle.a;
    vec3 p = triangle.a + bary.x * ab + bary.y * ac;
    vec3 geometric = cross(ab, ac);
    s.primitive = triangle.primitive & ~(PRIMITIVE_LETS_THROUGH | PRIMITIVE_FRONT_ONLY);
    s.reach = max_component(max(abs(triangle.a), max(abs(triangle.b), abs(triangle.c))));

    // uv (0,0), (1,0), (1,1) where the mesh has none; two corners changed places where it was mirrored into the world
    bool turned = !to_world && instance.handedness < 0.0;
    vec2 uv0 = vec2(0.0);
    vec2 uv1 = turned ? vec2(1.0) : vec2(1.0, 0.0);
    vec2 uv2 = turned ? vec2(1.0, 0.0) : vec2(1.0);
    vec3 normal = geometric;
    vec3 normal_b = vec3(0.0);
    vec3 normal_c = vec3(0.0);
    s.tangent = vec4(0.0);
    uint extra = NONE;
    if (instance.first_face != NONE) {
        Face face = face_unpack(fetch_faces((instance.first_face + s.primitive) * FACE_WORDS));
        extra = face.extra;
        Vertex a = vertex_fetch(face.vertices.x);
        Vertex b = vertex_fetch(face.vertices.y);
        Vertex c = vertex_fetch(face.vertices.z);
        if ((instance.flags & INSTANCE_DEFAULT_UV) == 0u) {
            uv0 = vec2(a.u, a.v);
            uv1 = vec2(b.u, b.v);
            uv2 = vec2(c.u, c.v);
        }
        vec3 smoothed = a.normal + bary.x * (b.normal - a.normal) + bary.y * (c.normal - a.normal);
        if (dot(smoothed, smoothed) > 0.0) {
            normal = smoothed;
            normal_b = b.normal - a.normal;
            normal_c = c.normal - a.normal;
        }
        s.tangent.xyz = a.tangent + bary.x * (b.tangent - a.tangent) + bary.y * (c.tangent - a.tangent);
        // All corners of a triangle have the side of their bitangents alike: two in length where it is the other
        s.tangent.w = dot(a.tangent, a.tangent) > 2.0 ? -1.0 : 1.0;
    }
    vec2 du = uv1 - uv0;
    vec2 dv = uv2 - uv0;
    s.uv = uv0 + bary.x * du + bary.y * dv;
    corners_surface(s, extra, bary, du, dv);
    float determinant = du.x * dv.y - du.y * dv.x;
    bool oriented = abs(determinant) >= 1e-9;
    s.dpdu = oriented ? (dv.y * ab - du.y * ac) / determinant : vec3(0.0);
    s.dpdv = oriented ? (du.x * ac - dv.x * ab) / determinant : vec3(0.0);
    s.dndu = oriented ? (dv.y * normal_b - du.y * normal_c) / determinant : vec3(0.0);
    s.dndv = oriented ? (du.x * normal_c - dv.x * normal_b) / determinant : vec3(0.0);
    if (to_world) {
        s.object_position = p;
        s.position = world_point(instance, p);
        s.reach = world_reach(instance, s.reach);
        s.object_dpdu = s.dpdu;
        s.object_dpdv = s.dpdv;
        s.dpdu = world_vector(instance, s.dpdu);
        s.dpdv = world_vector(instance, s.dpdv);
        s.object_rate = length(ab) / length(world_vector(instance, ab));
        geometric = world_normal(instance, geometric);
        normal = world_normal(instance, normal);
        s.dndu = world_normal(instance, s.dndu);
        s.dndv = world_normal(instance, s.dndv);
        s.tangent = vec4(world_vector(instance, s.tangent.xyz), s.tangent.w * instance.handedness);
    } else {
        s.position = p;
        s.object_position = object_point(instance, p);
        s.object_dpdu = object_vector(instance, s.dpdu);
        s.object_dpdv = object_vector(instance, s.dpdv);
        s.object_rate = length(object_vector(instance, ab)) / length(ab);
    }
    s.uv_rate = oriented ? 1.0 / vec2(length(s.dpdu), length(s.dpdv)) : vec2(0.0);
    s.geometric = normalize_or(geometric, -direction);
    s.dndu = unit_derivative(normal, s.dndu);
    s.dndv = unit_derivative(normal, s.dndv);
    s.normal = normalize_or(normal, s.geometric);
    if (dot(s.normal, s.geometric) < 0.0) {
        s.normal = -s.normal;
        s.dndu = -s.dndu;
        s.dndv = -s.dndv;
    }
    s.material = triangle.material != NONE ? triangle.material : instance.material;
    uint own = (instance.flags & INSTANCE_TRIANGLE_LIGHTS) != 0u ? s.primitive : 0u;
    s.light = instance.light == NONE ? NONE : instance.light + own;
    return s;
}
