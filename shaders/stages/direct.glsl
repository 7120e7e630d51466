// Light that a surface gets straight from a lamp or the environment. Switches of the variant: GEOMETRIC_VETO, HAS_MEDIUM.
#include "stages/event.glsl"
#include "material/material.glsl"
#include "material/dispersion.glsl"
#include "material/medium.glsl"
#include "light/light.glsl"
#include "stages/relief.glsl"

// Part of the way to a light that a shadow ray goes: what is nearer to the light than the rest, as its own box in the tree, is
// not looked at (pbrt-v4 has 1 - 10^-4).
const float SHADOW_END = 1.0 - 1.0 / 16384.0;

// Sends a shadow ray to a light and puts what it may bring into the shadow queue.
void sample_direct_light(Path path, Surface surface, Bsdf bsdf, Basis basis, vec3 wo, bool last, uint slot, uint next)
{
    float pick = sample_1d(path.key, bounce_dimension(path.depth, DIMENSION_LIGHT_PICK));
    LightSample light = light_sample(surface.position, pick, sample_2d(path.key, bounce_dimension(path.depth, DIMENSION_LIGHT)));
    vec3 wi = basis_to_local(basis, light.wi);
    vec3 f = dispersed_eval(bsdf, wo, wi) * abs(wi.z);
    if (!(light.pdf > 0.0) || max_component(f) <= 0.0) return;
#if defined(HAS_BUMP) || defined(HAS_NORMAL_MAP)
    if (wo.z * wi.z > 0.0) f *= softening(surface, light.wi);
#endif
    float side = dot(light.wi, surface.geometric);
    if (wo.z * wi.z > 0.0 && !may_reflect(surface, side)) return;
#ifdef GEOMETRIC_VETO
    if (side * wi.z <= 0.0) return;
#endif
#ifdef HAS_MEDIUM
    // A light from infinity is left as it is: no way out of the glass is free.
    bool through = wo.z * wi.z < 0.0;
    uint medium = through ? medium_beyond(path.medium, bsdf, surface.material, side) : path.medium;
    if (!light.infinite) light.radiance *= medium_transmittance(medium, distance(surface.position, light.point));
#endif
    // The path ends here when `last`: then the BSDF will not look for the light.
    float weight = light.delta || last ? 1.0 : power_heuristic(light.pdf, dispersed_pdf(bsdf, wo, wi));
    vec3 radiance = limited(path.throughput * f * light.radiance * (weight / light.pdf), path.depth + 1u);
    vec3 origin = ray_origin(surface, side);
    vec3 target = offset_ray_origin(light.point, light.normal, light.reach);
    vec3 direction = light.infinite ? light.wi : target - origin;
    store_shadows(slot * SHADOW_WORDS, uvec4(floatBitsToUint(origin), floatBitsToUint(light.infinite ? FAR : SHADOW_END)));
    store_shadows(slot * SHADOW_WORDS + 1u, uvec4(floatBitsToUint(direction), 0u));
    store_shadows(slot * SHADOW_WORDS + 2u, uvec4(floatBitsToUint(radiance), 0u));
    queue_append(QUEUE_SHADOWS, next, direction, slot);
}
