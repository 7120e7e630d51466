// What stands for shade.comp in the views of the first surface that a camera ray meets: each path ends there, with a colour in
// place of its radiance. Surfaces that let rays through are passed as ever. Switch of the variant: HAS_FILTER.
#include "stages/wave.glsl"
#include "geometry/surface.glsl"
#ifdef HAS_FILTER
#include "stages/filter.glsl"
#endif

// Colours of a view, linear, from 0 to 1.
vec3 color_of_surface(Path path, Surface surface, WaveRay ray);
vec3 color_of_nothing(Path path);

// True when the path goes on.
bool look(uint slot, inout Path path, WaveRay ray, uvec4 hit)
{
    if (hit.w == HIT_MISS) {
        path.radiance = color_of_nothing(path);
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
    path.radiance = color_of_surface(path, surface, ray);
    return false;
}

void main()
{
    Taken taken = queue_take(QUEUE_PATHS);
    uint slot = taken.slot;
    if (slot == NONE) return;
    // A path waits while its ray is too long for one dispatch.
    uvec4 hit = fetch_hits(slot);
    WaveRay ray = ray_load(slot);
    Path path = path_load(slot);
    time_begin(path.key);
    bool goes_on = hit.w >= HIT_LONG;
    if (!goes_on) {
        goes_on = look(slot, path, ray, hit);
        path_store(slot, path);
    }
    if (goes_on) queue_append(QUEUE_PATHS, taken.next_half, ray.direction, slot);
}
