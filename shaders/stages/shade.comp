// One scattering event of every path in the queue: emission, light sampling, and the next direction.
// Switches of the variant: HAS_ENVIRONMENT, HAS_LIGHTS, HAS_MEDIUM, ROULETTE, GEOMETRIC_VETO,
// TRANSPARENT_FILM and those of the menus.
#include "stages/wave.glsl"
#include "base/offset.glsl"
#include "geometry/surface.glsl"
#include "material/material.glsl"
#include "material/medium.glsl"
#include "light/light.glsl"
#include "stages/aov.glsl"

// Indirect light of a sample may be limited (firefly_clamp); direct light is not.
vec3 limited(vec3 radiance, uint depth)
{
    float most = max_component(radiance);
    bool clamped = frame.firefly_clamp > 0.0 && depth > 1u && most > frame.firefly_clamp;
    return clamped ? radiance * (frame.firefly_clamp / most) : radiance;
}

// Light that the ray met by itself, weighted against light sampling having found it.
void add_emission(inout Path path, vec3 radiance, float light_sampling_pdf)
{
    float weight = path.pdf > 0.0 ? power_heuristic(path.pdf, light_sampling_pdf) : 1.0;
    path.radiance += limited(path.throughput * radiance * weight, path.depth);
}

void shade_miss(inout Path path, vec3 direction)
{
#ifdef TRANSPARENT_FILM
    if ((path.flags & PATH_COVERED) == 0u) return;
#endif
#ifdef HAS_ENVIRONMENT
    add_emission(path, environment_radiance(direction), path.pdf > 0.0 ? environment_light_pdf(direction) : 0.0);
#endif
}

// Part of the way to a light that a shadow ray goes: what is nearer to the light than the rest, as its own box in the tree, is
// not looked at (pbrt-v4 has 1 - 10^-4).
const float SHADOW_END = 1.0 - 1.0 / 16384.0;

// Where a ray leaves a surface; `side` is its cosine with the geometric normal.
vec3 ray_origin(Surface surface, float side)
{
    return offset_ray_origin(surface.position, side < 0.0 ? -surface.geometric : surface.geometric, surface.reach);
}

// Sends a shadow ray to a light and puts what it may bring into the shadow queue.
void sample_direct_light(Path path, Surface surface, Bsdf bsdf, Basis basis, vec3 wo, bool last, uint slot, uint next)
{
    float pick = sample_1d(path.key, bounce_dimension(path.depth, DIMENSION_LIGHT_PICK));
    LightSample light = light_sample(surface.position, pick, sample_2d(path.key, bounce_dimension(path.depth, DIMENSION_LIGHT)));
    vec3 wi = basis_to_local(basis, light.wi);
    vec3 f = bsdf_eval(bsdf, wo, wi) * abs(wi.z);
    if (!(light.pdf > 0.0) || max_component(f) <= 0.0) return;
    float side = dot(light.wi, surface.geometric);
#ifdef GEOMETRIC_VETO
    if (side * wi.z <= 0.0) return;
#endif
#ifdef HAS_MEDIUM
    // A light from infinity is left as it is: no way out of the glass is free.
    bool through = bsdf.kind == MATERIAL_DIELECTRIC && wo.z * wi.z < 0.0;
    uint medium = through ? medium_beyond(bsdf, surface.material, side) : path.medium;
    if (!light.infinite) light.radiance *= medium_transmittance(medium, distance(surface.position, light.point));
#endif
    // The path ends here when `last`: then the BSDF will not look for the light.
    float weight = light.delta || last ? 1.0 : power_heuristic(light.pdf, bsdf_pdf(bsdf, wo, wi));
    vec3 radiance = limited(path.throughput * f * light.radiance * (weight / light.pdf), path.depth + 1u);
    vec3 origin = ray_origin(surface, side);
    vec3 target = offset_ray_origin(light.point, light.normal, light.reach);
    vec3 direction = light.infinite ? light.wi : target - origin;
    store_shadows(slot * SHADOW_WORDS, uvec4(floatBitsToUint(origin), floatBitsToUint(light.infinite ? FAR : SHADOW_END)));
    store_shadows(slot * SHADOW_WORDS + 1u, uvec4(floatBitsToUint(direction), 0u));
    store_shadows(slot * SHADOW_WORDS + 2u, uvec4(floatBitsToUint(radiance), 0u));
    queue_append(QUEUE_SHADOWS, next, direction, slot);
}

// Chooses the next direction; false when the path ends.
bool scatter(inout Path path, Surface surface, Bsdf bsdf, Basis basis, vec3 wo, inout WaveRay ray)
{
    float lobe = sample_1d(path.key, bounce_dimension(path.depth, DIMENSION_LOBE));
    BsdfSample s = bsdf_sample(bsdf, wo, lobe, sample_2d(path.key, bounce_dimension(path.depth, DIMENSION_BSDF)));
    vec3 wi = basis_to_world(basis, s.wi);
    float side = dot(wi, surface.geometric);
    if (max_component(s.weight) <= 0.0) return false;
#ifdef GEOMETRIC_VETO
    if (side * s.wi.z <= 0.0) return false;
#endif
    path.throughput *= s.weight;
    path.pdf = s.pdf;
    if (s.pdf > 0.0) path.diffuse_depth += 1u;
#ifdef HAS_DIELECTRIC
    if (s.through) {
        path.eta_scale *= s.eta * s.eta;
        path.medium = medium_beyond(bsdf, surface.material, side);
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
    ray = WaveRay(ray_origin(surface, side), wi);
    return true;
}

// One event; true when the path goes on.
bool shade(uint slot, inout Path path, inout WaveRay ray, uvec4 hit, uint next)
{
    if (hit.w == HIT_MISS) {
        shade_miss(path, ray.direction);
        return false;
    }
    path.flags |= PATH_COVERED;
    Surface surface = surface_at(uintBitsToFloat(hit.x), hit.y, hit.z, ray.origin, ray.direction);
    bool front = dot(ray.direction, surface.geometric) < 0.0;
    Material material = material_fetch(surface.material);
#ifdef HAS_MEDIUM
    // Glass around the glass that a path has left is known by its boundary, met from behind.
    bool from_inside = !front && material.kind == MATERIAL_DIELECTRIC && material.mode == DIELECTRIC_SOLID;
    if (path.medium == NONE && from_inside) path.medium = surface.material;
    path.throughput *= medium_transmittance(path.medium, distance(ray.origin, surface.position));
#endif
    vec3 facing_normal = front ? surface.normal : -surface.normal;
    TextureContext context =
        TextureContext(surface.position, surface.object_position, surface.uv, facing_normal, 0.0, 0.0);
    Bsdf bsdf = material_bsdf(material, context);
    vec3 emitted = vec3(0.0);
    if (front || material.two_sided != 0u) {
        emitted = material_emission(material, context);
        float pdf = 0.0;
        if (path.pdf > 0.0 && surface.light != NONE) pdf = light_pdf(surface.light, ray.origin, surface.position, surface.geometric);
        add_emission(path, emitted, pdf);
    }
    if (bsdf.kind == MATERIAL_UNLIT) path.radiance += limited(path.throughput * bsdf.color, path.depth);
    bool specular = bsdf_is_specular(bsdf);
    if ((path.flags & PATH_HAS_AOV) == 0u && !specular) write_aov(slot, path, surface, bsdf, emitted, facing_normal);
    if (path.depth >= frame.max_depth || bsdf.kind == MATERIAL_UNLIT) return false;

    Basis basis = basis_along(surface.normal, surface.dpdu);
    vec3 wo = basis_to_local(basis, -ray.direction);
    bool last = !specular && path.diffuse_depth >= frame.diffuse_bounces;
#if defined(HAS_LIGHTS) || defined(HAS_ENVIRONMENT)
    if (!specular) sample_direct_light(path, surface, bsdf, basis, wo, last, slot, next);
#endif
    return !last && scatter(path, surface, bsdf, basis, wo, ray);
}

void main()
{
    Taken taken = queue_take(QUEUE_PATHS);
    uint slot = taken.slot;
    if (slot == NONE) return;
    // A path waits while its own ray or its last shadow ray is too long for one dispatch.
    uvec4 hit = fetch_hits(slot);
    WaveRay ray = ray_load(slot);
    Path path = path_load(slot);
    bool goes_on = hit.w >= HIT_LONG || (path.flags & PATH_WAITS) != 0u;
    if (!goes_on) {
        goes_on = shade(slot, path, ray, hit, taken.next_half);
        path_store(slot, path);
#ifdef HAS_DIELECTRIC
        path_store_medium(slot, path);
#endif
        if (goes_on) ray_store(slot, ray);
    }
    if (goes_on) queue_append(QUEUE_PATHS, taken.next_half, ray.direction, slot);
}
