// The next direction of a path. Switches of the variant: HAS_BUMP, HAS_NORMAL_MAP, HAS_GLASS, HAS_FOOTPRINT, ROULETTE, GEOMETRIC_VETO.
#include "stages/event.glsl"
#include "stages/relief.glsl"
#include "material/material.glsl"
#include "material/dispersion.glsl"
#include "material/medium.glsl"

#ifdef HAS_FOOTPRINT
// The cone of a ray that has come to a surface and goes on from there, by the bend of the surface itself and not of its bumps.
void bend_cone(inout WaveRay ray, Surface surface, BsdfSample s, vec3 wo)
{
    Cone cone = cone_after(Cone(ray.width, ray.spread), distance(ray.origin, surface.position));
    float k = mean_curvature(surface.dpdu, surface.dpdv, surface.dndu, surface.dndv);
    if (dot(ray.direction, surface.geometric) > 0.0) k = -k;
    float cos_i = max(abs(wo.z), LEAST_SLANT);
    float cos_t = max(abs(s.wi.z), LEAST_SLANT);
    cone = s.through ? cone_refracted(cone, k, s.eta, cos_i, cos_t) : cone_reflected(cone, k);
    float spread = clamp(cone.spread, -MOST_SPREAD, MOST_SPREAD);
    ray.width = cone.width;
    ray.spread = s.pdf > 0.0 ? max(spread, SAMPLE_SPREAD * inversesqrt(PI * s.pdf)) : spread;
}
#endif

// Chooses the next direction; false when the path ends. The last event goes on in mirror directions alone.
bool scatter(inout Path path, Surface surface, Bsdf bsdf, Basis basis, vec3 wo, bool last, inout WaveRay ray)
{
    if (last && !bsdf_may_mirror(bsdf)) return false;
    float lobe = sample_1d(path.key, bounce_dimension(path.depth, DIMENSION_LOBE));
    BsdfSample s = dispersed_sample(bsdf, wo, lobe, sample_2d(path.key, bounce_dimension(path.depth, DIMENSION_BSDF)));
    vec3 wi = basis_to_world(basis, s.wi);
    float side = dot(wi, surface.geometric);
    if (max_component(s.weight) <= 0.0 || !s.through && !may_reflect(surface, side)) return false;
    if (last && s.pdf > 0.0) return false;
#ifdef GEOMETRIC_VETO
    if (side * s.wi.z <= 0.0) return false;
#endif
#if defined(HAS_BUMP) || defined(HAS_NORMAL_MAP)
    if (!s.through && s.pdf > 0.0) s.weight *= softening(surface, wi);
#endif
    path.throughput *= s.weight;
    path.pdf = s.pdf;
    if (s.pdf > 0.0) path.diffuse_depth += 1u;
#ifdef HAS_GLASS
    if (s.through) {
        path.eta_scale *= s.eta * s.eta;
        path.medium = medium_beyond(path.medium, bsdf, surface.material, side);
    }
#endif
    path.depth += 1u;
#ifdef ROULETTE
    float survival = max_component(path.throughput) * path.eta_scale;
    if (path.depth > 2u && survival < 1.0) {
        if (sample_1d(path.key, bounce_dimension(path.depth - 1u, DIMENSION_ROULETTE)) >= survival) return false;
        path.throughput /= survival;
    }
#endif
#ifdef HAS_FOOTPRINT
    bend_cone(ray, surface, s, wo);
#endif
    ray.origin = ray_origin(surface, side);
    ray.direction = wi;
    return true;
}
