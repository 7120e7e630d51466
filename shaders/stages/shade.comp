// One scattering event of every path in the queue: emission, light sampling, and the next direction.
// Switches of the variant: HAS_ENVIRONMENT, HAS_LIGHTS, HAS_GLASS, HAS_MEDIUM, HAS_DISPERSION, HAS_FRONT_ONLY, HAS_MIX, HAS_FOOTPRINT, ROULETTE, GEOMETRIC_VETO,
// TRANSPARENT_FILM and those of the menus.
#include "stages/direct.glsl"
#include "stages/scatter.glsl"
#ifdef HAS_FILTER
#include "stages/filter.glsl"
#endif
#ifdef HAS_MIX
#include "material/mix.glsl"
#endif
#include "stages/aov.glsl"

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

// One event; true when the path goes on.
bool shade(uint slot, inout Path path, inout WaveRay ray, uvec4 hit, uint next)
{
    if (hit.w == HIT_MISS) {
        shade_miss(path, ray.direction);
        return false;
    }
    Surface surface = surface_at(uintBitsToFloat(hit.x), hit.y, hit.z, ray.origin, ray.direction);
#ifdef HAS_FILTER
    if (passes_through(path, surface, ray.direction)) {
        store_hits(slot, uvec4(hit.xyz, HIT_PASSED));
        return true;
    }
#endif
    path.flags |= PATH_COVERED;
    bool front = dot(ray.direction, surface.geometric) < 0.0;
    vec3 facing_normal = front ? surface.normal : -surface.normal;
    TextureContext context = context_of(surface, ray, facing_normal);
    Material material = material_fetch(surface.material);
    Material shining = material;
#ifdef HAS_FRONT_ONLY
    surface.front_only = (material.flags & MATERIAL_FRONT_ONLY) != 0u;
#endif
#ifdef HAS_MIX
    // A mix is one of its materials for the whole event, but for the light that it sends out.
    surface.material = mix_pick(surface.material, context, sample_1d(path.key, bounce_dimension(path.depth, DIMENSION_MIX)));
    material = material_fetch(surface.material);
#endif
#ifdef HAS_MEDIUM
    // Glass around the glass that a path has left is known by its boundary, met from behind.
    if (path.medium == NONE && !front && medium_is_inside(material.kind, material.mode)) path.medium = surface.material;
    path.throughput *= medium_transmittance(path.medium, distance(ray.origin, surface.position));
#endif
#if defined(HAS_BUMP) || defined(HAS_NORMAL_MAP)
    relieve(surface, context, -ray.direction);
    facing_normal = front ? surface.normal : -surface.normal;
#endif
    Bsdf bsdf = material_bsdf(material, context);
#ifdef HAS_DISPERSION
    // A lens with dispersion has drawn the colour from the same number: what is left of it is the place in the band
    float place = fract(3.0 * sample_1d(path.key, DIMENSION_WAVELENGTH));
    disperse(bsdf, material.dispersion, path.throughput, place);
#endif
    vec3 emitted = vec3(0.0);
    if (front || (shining.flags & MATERIAL_TWO_SIDED) != 0u) {
        // What a bounce finds is what light sampling would have found: lamps are sampled at points
        emitted = material_emission(shining, path.pdf > 0.0 ? sharp(context) : context);
        float pdf = path.pdf > 0.0 && surface.light != NONE ? light_pdf(surface.light, ray.origin, surface.position, surface.geometric) : 0.0;
        add_emission(path, emitted, pdf);
    }
    if (bsdf.kind == MATERIAL_UNLIT) path.radiance += limited(path.throughput * bsdf.color, path.depth);
    bool specular = bsdf_is_specular(bsdf);
    if ((path.flags & PATH_HAS_AOV) == 0u && !specular) write_aov(slot, path, surface, bsdf, emitted, facing_normal);
    if (path.depth >= frame.max_depth || bsdf.kind == MATERIAL_UNLIT) return false;

    Basis basis = basis_along(surface.normal, surface.dpdu);
    vec3 wo = basis_to_local(basis, -ray.direction);
#ifdef GEOMETRIC_VETO
    // A normal that is turned away from the viewer shows the side that is not seen
    if ((wo.z > 0.0) != front) return false;
#endif
    bool last = !specular && path.diffuse_depth >= frame.diffuse_bounces;
#if defined(HAS_LIGHTS) || defined(HAS_ENVIRONMENT)
    if (!specular) sample_direct_light(path, surface, bsdf, basis, wo, last, slot, next);
#endif
    return scatter(path, surface, bsdf, basis, wo, last, ray);
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
    time_begin(path.key);
    bool goes_on = hit.w >= HIT_LONG || (path.flags & PATH_WAITS) != 0u;
    if (!goes_on) {
        goes_on = shade(slot, path, ray, hit, taken.next_half);
        path_store(slot, path);
#ifdef HAS_GLASS
        path_store_medium(slot, path);
#endif
        if (goes_on) ray_store(slot, ray);
    }
    if (goes_on) queue_append(QUEUE_PATHS, taken.next_half, ray.direction, slot);
}
