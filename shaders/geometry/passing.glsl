// What becomes of a ray at a surface of which not all is there. Switches of the variant: HAS_OPACITY, HAS_FILTER (light that
// goes through is coloured).
#include "geometry/surface.glsl"
#include "geometry/walk.glsl"
#include "geometry/quadric.glsl"
#include "base/random.glsl"
#include "detail/opacity.glsl"

// Whether a ray is stopped by a surface that is there to the part `opacity`. The draw is a hash of what is met, as the order
// in which a ray meets things depends on the trees; a sphere is met twice.
bool opacity_stops(uint key, Surface s, float opacity, vec3 direction)
{
    uint side = dot(direction, s.geometric) > 0.0 ? 1u : 0u;
    return uniform_float(hash2(hash2(key, s.instance), 2u * s.primitive + side)) < opacity;
}

// Whether a ray ends on a surface that it met: a shadow ray when nothing of its light is left; another when the surface stops
// it or colours it, which shade.comp does. From behind, nothing of a surface is there that has a front alone.
bool passing_ends(inout Passing passing, Surface s, vec3 direction)
{
    Detail detail = detail_fetch(s.material);
    if ((detail.flags & DETAIL_FRONT_ONLY) != 0u && dot(direction, s.geometric) > 0.0) return false;
    TextureContext context = surface_context(s, s.normal);
    float opacity = opacity_at(detail, context);
#ifdef ANY_HIT
    passing.through *= 1.0 - opacity;
#ifdef HAS_FILTER
    passing.through *= filter_at(detail, context);
#endif
    return max_component(passing.through) <= 0.0;
#else
#ifdef HAS_FILTER
    if (opacity < 1.0 && (detail.filter_color != vec3(1.0) || detail.filter_texture != NONE)) return true;
#endif
    return opacity_stops(passing.key, s, opacity, direction);
#endif
}

// Where a ray meets a sphere again that has let it through; other things are met once.
Hit beyond(Hit passed, float t_max, vec3 origin, vec3 direction)
{
#ifdef HAS_SPHERES
    if (passed.triangle == NONE) {
        Instance sphere = instance_fetch(passed.instance);
        float t;
        bool again = sphere_hit(object_point(sphere, origin), object_vector(sphere, direction), passed.t, t_max, t);
        if (again && sphere.kind == INSTANCE_SPHERE) return Hit(t, NONE, passed.instance);
    }
#endif
    return NO_HIT;
}

// Looks at what a ray met that may let it through: the walk ends there, or goes on as it was.
void passing_decide(inout Passing passing, inout Walk walk, Hit candidate, vec3 origin, vec3 direction)
{
    while (is_hit(candidate)) {
        Surface met = surface_at(candidate.t, candidate.triangle, candidate.instance, origin, direction);
        bool ends = passing_ends(passing, met, direction);
        if (ends) walk.hit = candidate;
#ifdef ANY_HIT
        if (ends) walk.current = REFERENCE_DONE;
#endif
        Hit again = beyond(candidate, walk.hit.t, origin, direction);
        candidate = ends ? NO_HIT : again;
    }
}
