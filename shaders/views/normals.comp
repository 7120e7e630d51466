// The view `normals`: the shading normal of the first surface in world space, on the side that is seen; coordinates from -1 to 1 are
// colours from 0 to 1. Switches of the variant: HAS_BUMP, HAS_NORMAL_MAP, HAS_MIX, HAS_FOOTPRINT and those of first_surface.glsl.
#include "stages/relief.glsl"
#ifdef HAS_MIX
#include "material/mix.glsl"
#endif
#include "views/first_surface.glsl"

vec3 color_of_surface(Path path, Surface surface, WaveRay ray)
{
    bool front = dot(ray.direction, surface.geometric) < 0.0;
#if defined(HAS_BUMP) || defined(HAS_NORMAL_MAP)
    TextureContext context = context_of(surface, ray, front ? surface.normal : -surface.normal);
#ifdef HAS_MIX
    surface.material = mix_pick(surface.material, context, sample_1d(path.key, bounce_dimension(path.depth, DIMENSION_MIX)));
#endif
    relieve(surface, context, -ray.direction);
#endif
    return 0.5 + 0.5 * (front ? surface.normal : -surface.normal);
}

vec3 color_of_nothing(Path path) { return vec3(0.0); }
