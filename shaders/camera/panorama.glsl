// Cameras without a lens that are no perspective: parallel rays, all directions, a circle of directions.
#include "base/math.glsl"
#include "camera/ray.glsl"

CameraRay orthographic_sample(vec2 film_01)
{
    vec2 plane = picture_plane(film_01);
    vec3 origin = frame.camera_position + plane.x * frame.camera_right + plane.y * frame.camera_up;
    return CameraRay(origin, -frame.camera_back, vec3(1.0), pixel_height(), 0.0);
}

// Longitude to the right and latitude up, the view in the middle.
CameraRay equirectangular_sample(vec2 film_01)
{
    vec2 longitude = circle_point((2.0 * film_01.x - 1.0) * PI);
    vec2 latitude = circle_point((0.5 - film_01.y) * PI);
    vec3 view = vec3(latitude.x * longitude.y, latitude.y, latitude.x * longitude.x);
    // The root of the solid angle of the pixel
    vec2 step = vec2(2.0 * PI, PI) / vec2(frame.film_size);
    float spread = sqrt(step.x * step.y * max(latitude.x, 0.0));
    return CameraRay(frame.camera_position, world_from_view(view), vec3(1.0), 0.0, spread);
}

// half_x and half_y are in radii of the circle that the picture shows.
CameraRay fisheye_sample(vec2 film_01)
{
    vec2 plane = picture_plane(film_01);
    float r = length(plane);
#ifdef FISHEYE_EQUISOLID
    // sin(θ / 2) = r sin(fov / 4); without an arc sine, which drivers round to 4 digits
    float half_sine = min(r * frame.fisheye_scale, 1.0);
    float sine = 2.0 * half_sine * safe_sqrt(1.0 - half_sine * half_sine);
    float cosine = 1.0 - 2.0 * half_sine * half_sine;
    float spread = pixel_height() * 2.0 * frame.fisheye_scale;
#else
    vec2 bent = circle_point(r * frame.fisheye_scale);
    float cosine = bent.x;
    float sine = bent.y;
    float spread = pixel_height() * frame.fisheye_scale;
#endif
    vec2 across = r > 0.0 ? plane * (sine / r) : vec2(0.0);
    vec3 direction = normalize(world_from_view(vec3(across, cosine)));
    return CameraRay(frame.camera_position, direction, vec3(r <= 1.0 ? 1.0 : 0.0), 0.0, spread);
}
