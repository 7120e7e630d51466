// What every camera gives for a point of the film.
#include "shared/bindings.glsl"

struct CameraRay {
    vec3 origin;
    vec3 direction;
    vec3 weight;  // what the light along the ray counts for; 0 = black
    float width;  // diameter at the origin of the cone that the pixel sees, scene units
    float spread; // growth of that diameter per unit of length
};

// From camera space (right, up, along the view) to world space.
vec3 world_from_view(vec3 v) { return v.x * frame.camera_right + v.y * frame.camera_up - v.z * frame.camera_back; }

// -1 to 1 across the picture and upward, in units of half its sides: film_01 has (0, 0) at the top left.
vec2 picture_plane(vec2 film_01) { return (2.0 * film_01 - 1.0) * vec2(frame.half_x, -frame.half_y); }

// Height of a pixel in the units of half_y.
float pixel_height() { return 2.0 * frame.half_y / float(frame.film_size.y); }
