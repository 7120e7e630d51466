// From a hit to the point on the surface that shading needs.
#include "geometry/surface_triangle.glsl"
#include "geometry/surface_quadric.glsl"
#include "texture/context.glsl"

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
    Instance place = instance_fetch(owner);
    Surface s = triangle_surface(triangle, place, false, origin, direction);
#endif
    s.instance = owner;
    s.base_normal = s.normal;
    s.object_normal = object_normal(place, s.normal);
    s.softened = false;
    return s;
}

// What a texture is told of a surface, without the width of a pixel.
TextureContext surface_context(Surface s, vec3 normal)
{
    TextureContext context = context_at(s.position, s.uv, normal);
    context.object_position = s.object_position;
    context.object_normal = s.object_normal;
#ifdef HAS_VERTEX_COLOR
    context.vertex_color = s.vertex_color;
#endif
#ifdef HAS_UV1
    context.uv1 = s.uv1;
#endif
    return context;
}
