// The first rays: one a slot of the wave. Switch of the variant: MOVING_CAMERA.
#include "stages/wave.glsl"
#include "base/sampling.glsl"
#include "camera/camera.glsl"
#ifdef MOVING_CAMERA
#include "geometry/instance.glsl"
#include "geometry/motion.glsl"
#endif

// Where on the film a sample lies, in pixels: the filter is sampled in proportion to its value.
vec2 film_position(SlotPlace place, SampleKey key)
{
    vec2 u01 = sample_pixel(key, DIMENSION_PIXEL);
#if FILTER == FILTER_BOX
    vec2 offset = 2.0 * u01 - 1.0;
#elif FILTER == FILTER_TENT
    vec2 offset = vec2(tent_sample(u01.x), tent_sample(u01.y));
#elif FILTER == FILTER_GAUSSIAN
    vec2 offset = vec2(gaussian_sample(u01.x), gaussian_sample(u01.y));
#else
    vec2 offset = vec2(blackman_harris_sample(u01.x), blackman_harris_sample(u01.y));
#endif
    return vec2(place.pixel) + 0.5 + offset * frame.filter_radius;
}

#ifdef MOVING_CAMERA
// A camera that moves makes its rays in its own space.
CameraRay camera_ray_in_world(CameraRay ray)
{
    Place place = motion_place(motion_fetch(frame.camera_motion), path_time);
    ray.origin = affine_point(place.row0, place.row1, place.row2, ray.origin);
    ray.direction = normalize(affine_vector(place.row0, place.row1, place.row2, ray.direction));
    return ray;
}
#endif

void main()
{
    uint slot = interleaved_group() * WORKGROUP + gl_LocalInvocationIndex;
    if (slot >= frame.slot_count) return;
    // The wave starts with the first part of a half of the path queue full; advance.comp takes its turn before the round.
    if (slot == 0u) {
        counters[COUNTER_TURN] = 1u;
        for (uint b = 0u; b < QUEUE_BINS; ++b) {
            counters[queue_counter(QUEUE_PATHS, 0u, b)] = b == 0u ? frame.slot_count : 0u;
            counters[queue_counter(QUEUE_SHADOWS, 0u, b)] = 0u;
        }
    }
    SlotPlace place = slot_place(slot);
    SampleKey key = sample_key(place.pixel, place.sample_index, frame.seed, frame.strata);
    CameraRay ray = camera_sample(film_position(place, key) / vec2(frame.film_size), key);
#ifdef MOVING_CAMERA
    time_begin(key);
    ray = camera_ray_in_world(ray);
#endif
    ray_store(slot, WaveRay(ray.origin, ray.width, ray.direction, ray.spread));
    Path path = Path(ray.weight, 0.0, vec3(0.0), 0u, 0u, 0u, frame.camera_medium, 1.0, key);
    path_store(slot, path);
    path_store_medium(slot, path);
    // Tiles at the edge reach beyond the window: those slots are not queued, and the film leaves them out. What the camera lets
    // through nothing of is not queued either: it stays black, and counts.
    bool lit = ray.weight.x + ray.weight.y + ray.weight.z > 0.0;
    queue[queue_place(QUEUE_PATHS, 0u, 0u, slot)] = place.inside && lit ? slot : NONE;
}
