// Film point and lens point to a ray in world space: pinhole, or a thin lens whose focus is a plane.
#include "shared/bindings.glsl"
#include "base/sampling.glsl"

struct CameraRay { vec3 origin; vec3 direction; };

// film_01: position on the film, (0, 0) at the top left.
CameraRay thin_lens_sample(vec2 film_01, vec2 lens_u01)
{
    // Through the centre of the lens, with unit depth
    vec2 plane = (2.0 * film_01 - 1.0) * vec2(frame.tan_x, -frame.tan_y);
    vec3 through = plane.x * frame.camera_right + plane.y * frame.camera_up - frame.camera_back;
#ifdef HAS_LENS
    // From a point on the lens to where that ray meets the plane of focus
    vec2 lens = frame.blades == 0u ? disk_sample(lens_u01) : polygon_sample(lens_u01, frame.blades, frame.blade_rotation);
    lens *= frame.lens_radius;
    vec3 offset = lens.x * frame.camera_right + lens.y * frame.camera_up;
    return CameraRay(frame.camera_position + offset, normalize(through * frame.focus_distance - offset));
#else
    return CameraRay(frame.camera_position, normalize(through));
#endif
}
