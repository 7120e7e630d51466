// Film point and lens point to a ray in world space: pinhole, or a thin lens whose focus is a plane.
#include "camera/ray.glsl"
#include "camera/opening.glsl"

CameraRay thin_lens_sample(vec2 film_01, vec2 lens_u01, vec2 pick)
{
    // Through the centre of the lens, with unit depth
    vec2 plane = picture_plane(film_01);
    vec3 through = plane.x * frame.camera_right + plane.y * frame.camera_up - frame.camera_back;
    float spread = pixel_height() * inversesqrt(dot(through, through));
#ifdef HAS_LENS
    // From a point on the lens to where that ray meets the plane of focus
    vec2 unit = opening_sample(lens_u01, pick);
    vec2 lens = unit * frame.lens_radius;
    vec3 offset = lens.x * frame.camera_right + lens.y * frame.camera_up;
#ifdef FOCUS_PLANE
    // It meets n · p = d at d / (n · through); behind the camera, or nowhere, is right as well
    float depth_inverse = dot(frame.focus_plane, vec3(plane, 1.0));
    vec3 direction = normalize(through - offset * depth_inverse);
#else
    float depth_inverse = 1.0 / frame.focus_distance;
    vec3 direction = normalize(through * frame.focus_distance - offset);
#endif
#ifdef CAT_EYE
    // Where the ray crosses the second opening, in radii
    vec2 second = unit + (plane - lens * depth_inverse) * frame.cat_eye;
    vec3 weight = vec3(dot(second, second) <= 1.0 ? 1.0 : 0.0);
#else
    vec3 weight = vec3(1.0);
#endif
    return CameraRay(frame.camera_position + offset, direction, weight, 0.0, spread);
#else
    return CameraRay(frame.camera_position, normalize(through), vec3(1.0), 0.0, spread);
#endif
}
