// From a hit to the point on the surface that shading needs.
#include "shared/bindings.glsl"
#include "base/offset.glsl"
#include "geometry/instance.glsl"
#include "geometry/triangle.glsl"

struct Surface {
    vec3 position;        // world space
    float reach;          // largest of the coordinates that position was computed from
    vec3 object_position; // object space of its instance
    vec3 geometric;       // unit normal of the geometry, outward
    vec3 normal;          // unit shading normal, on the side of `geometric`
    vec3 dpdu;            // ∂p/∂u in world space, not of unit length; 0 where u has no direction
    vec3 dpdv;            // ∂p/∂v
    vec2 uv;
    vec2 uv_rate;         // what u and v grow by in a unit of length of the world
    float object_rate;    // units of object space in a unit of length of the world
    uint material;
    uint light;           // its light, or NONE
    uint instance;
    uint primitive;       // number of the triangle within its mesh, else 0
};

Vertex vertex_fetch(uint i) { return vertex_unpack(fetch_vertices(i * VERTEX_WORDS), fetch_vertices(i * VERTEX_WORDS + 1u)); }

Triangle triangle_fetch(uint i)
{
    uint w = i * ITEM_WORDS;
    return triangle_unpack(fetch_tree(w), fetch_tree(w + 1u), fetch_tree(w + 2u));
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
    s.primitive = triangle.primitive & ~PRIMITIVE_LETS_THROUGH;
    s.reach = max_component(max(abs(triangle.a), max(abs(triangle.b), abs(triangle.c))));

    // uv (0,0), (1,0), (1,1) where the mesh has none; two corners changed places where it was mirrored into the world
    bool turned = !to_world && instance.handedness < 0.0;
    vec2 uv0 = vec2(0.0);
    vec2 uv1 = turned ? vec2(1.0) : vec2(1.0, 0.0);
    vec2 uv2 = turned ? vec2(1.0, 0.0) : vec2(1.0);
    vec3 normal = geometric;
    if (instance.first_face != NONE) {
        Face face = face_unpack(fetch_faces((instance.first_face + s.primitive) * FACE_WORDS));
        Vertex a = vertex_fetch(face.vertices.x);
        Vertex b = vertex_fetch(face.vertices.y);
        Vertex c = vertex_fetch(face.vertices.z);
        if (instance.default_uv == 0u) {
            uv0 = vec2(a.u, a.v);
            uv1 = vec2(b.u, b.v);
            uv2 = vec2(c.u, c.v);
        }
        vec3 smoothed = a.normal + bary.x * (b.normal - a.normal) + bary.y * (c.normal - a.normal);
        if (dot(smoothed, smoothed) > 0.0) normal = smoothed;
    }
    vec2 du = uv1 - uv0;
    vec2 dv = uv2 - uv0;
    s.uv = uv0 + bary.x * du + bary.y * dv;
    float determinant = du.x * dv.y - du.y * dv.x;
    bool oriented = abs(determinant) >= 1e-9;
    s.dpdu = oriented ? (dv.y * ab - du.y * ac) / determinant : vec3(0.0);
    s.dpdv = oriented ? (du.x * ac - dv.x * ab) / determinant : vec3(0.0);
    if (to_world) {
        s.object_position = p;
        s.position = world_point(instance, p);
        s.reach = world_reach(instance, s.reach);
        s.dpdu = world_vector(instance, s.dpdu);
        s.dpdv = world_vector(instance, s.dpdv);
        s.object_rate = length(ab) / length(world_vector(instance, ab));
        geometric = world_normal(instance, geometric);
        normal = world_normal(instance, normal);
    } else {
        s.position = p;
        s.object_position = object_point(instance, p);
        s.object_rate = length(object_vector(instance, ab)) / length(ab);
    }
    s.uv_rate = oriented ? 1.0 / vec2(length(s.dpdu), length(s.dpdv)) : vec2(0.0);
    s.geometric = normalize_or(geometric, -direction);
    s.normal = normalize_or(normal, s.geometric);
    if (dot(s.normal, s.geometric) < 0.0) s.normal = -s.normal;
    s.material = triangle.material != NONE ? triangle.material : instance.material;
    s.light = instance.light == NONE ? NONE : instance.light + instance.light_stride * s.primitive;
    return s;
}

// A point on a unit sphere (longitude about +z from +x, latitude) or unit disk of an instance.
Surface quadric_surface(Instance instance, float t, vec3 origin, vec3 direction)
{
    Surface s;
    vec3 p = object_point(instance, origin) + t * object_vector(instance, direction);
    bool sphere = instance.kind == INSTANCE_SPHERE;
    if (sphere) p = normalize(p); else p.z = 0.0;
    s.uv = sphere ? sphere_uv(p) : disk_uv(p.xy);
    s.object_position = p;
    s.position = world_point(instance, p);
    s.reach = world_reach(instance, 1.0);
    float from_axis = length(p.xy);
    vec2 outward = from_axis > 0.0 ? p.xy / from_axis : vec2(1.0, 0.0);
    // Of length 1 in object space: where v grows, and where the angle grows
    vec3 along_v = world_vector(instance, sphere ? vec3(-p.z * outward, from_axis) : vec3(-outward, 0.0));
    vec3 along_u = world_vector(instance, vec3(-outward.y, outward.x, 0.0));
    s.dpdu = 2.0 * PI * from_axis * along_u;
    s.dpdv = sphere ? PI * along_v : along_v;
    s.object_rate = 1.0 / length(along_u);
    // A picture is seen squeezed at a pole, not blurred: there u counts as on the equator
    s.uv_rate = vec2(INV_TWO_PI, sphere ? INV_PI : 1.0) / vec2(length(along_u), length(along_v));
    s.geometric = normalize(world_normal(instance, sphere ? p : vec3(0.0, 0.0, 1.0)));
    s.normal = s.geometric;
    s.material = instance.material;
    s.light = instance.light;
    s.primitive = 0u;
    return s;
}

// The surface that a ray met: triangle and instance as in Hit.
Surface surface_at(float t, uint triangle, uint instance, vec3 origin, vec3 direction)
{
#ifdef HAS_INSTANCES
    uint owner = instance;
    if (triangle != NONE) {
        uint baked = triangle_fetch(triangle).instance;
        if (baked != NONE) owner = baked;
    }
    Instance place = instance_fetch(owner);
    Surface s;
#if defined(HAS_SPHERES) || defined(HAS_DISKS)
    if (triangle == NONE) s = quadric_surface(place, t, origin, direction);
    else
#endif
    s = triangle_surface(triangle, place, place.kind != INSTANCE_SOUP, origin, direction);
#else
    uint owner = triangle_fetch(triangle).instance;
    Surface s = triangle_surface(triangle, instance_fetch(owner), false, origin, direction);
#endif
    s.instance = owner;
    return s;
}
