// The first rays: one a slot of the wave. Switch of the variant: MOVING_CAMERA.
#include "stages/wave.glsl"
#include "camera/camera.glsl"
#include "camera/pixel_filter.glsl"
#ifdef MOVING_CAMERA
#include "geometry/instance.glsl"
#include "geometry/motion.glsl"
#endif

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
    FilterSample f = filter_sample(sample_pixel(key, DIMENSION_PIXEL));
    vec2 position = vec2(place.pixel) + 0.5 + f.offset * frame.filter_radius;
    CameraRay ray = camera_sample(position / vec2(frame.film_size), key);
#ifdef MOVING_CAMERA
    time_begin(key);
    ray = camera_ray_in_world(ray);
#endif
    ray_store(slot, WaveRay(ray.origin, ray.width, ray.direction, ray.spread));
    uint flags = f.negative ? PATH_NEGATIVE : 0u;
    Path path = Path(ray.weight, 0.0, vec3(0.0), 0u, 0u, flags, frame.camera_medium, 1.0, key);
    path_store(slot, path);
    path_store_medium(slot, path);
    // Tiles at the edge reach beyond the window: those slots are not queued, and the film leaves them out. What the camera lets
    // through nothing of is not queued either: it stays black, and counts.
    bool lit = ray.weight.x + ray.weight.y + ray.weight.z > 0.0;
    queue[queue_place(QUEUE_PATHS, 0u, 0u, slot)] = place.inside && lit ? slot : NONE;
}
