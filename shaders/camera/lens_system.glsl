// A camera with a lens of several elements (Kolb, Mitchell and Hanrahan 1995, section 3).
#include "base/random.glsl"
#include "base/spectrum.glsl"
#include "camera/lens_trace.glsl"
#include "camera/ray.glsl"

// 1 / λ² of red, green and blue, in µm⁻².
const vec3 LENS_INVERSE_SQUARES = 1.0 / (COLOR_WAVELENGTHS * COLOR_WAVELENGTHS);

// Where on the plane of the last vertex light for a film point may come through: a corner, and the way to the other.
// The bounds are made for points on the x axis of the film and turned to where the point is.
PupilBounds pupil_bounds_at(float film_radius)
{
    uint interval = min(uint(film_radius * frame.pupil_scale), PUPIL_INTERVALS - 1u);
    return pupil_bounds_unpack(fetch_lens(frame.pupil_bounds + interval));
}

CameraRay lens_system_sample(vec2 film_01, vec2 lens_u01, SampleKey key)
{
    // The picture stands upside down on the film
    vec2 film = -picture_plane(film_01);
    float film_radius = length(film);
    PupilBounds bounds = pupil_bounds_at(film_radius);
    vec2 along = film_radius > 0.0 ? film / film_radius : vec2(1.0, 0.0);
    vec2 pupil = mix(bounds.low, bounds.high, lens_u01);
    pupil = vec2(pupil.x * along.x - pupil.y * along.y, pupil.x * along.y + pupil.y * along.x);
#ifdef LENS_DISPERSION
    // One colour a path
    vec3 color = color_mask(COLOR_RED + min(uint(3.0 * sample_1d(key, DIMENSION_WAVELENGTH)), 2u)) * 3.0;
    float inverse_square = dot(color, LENS_INVERSE_SQUARES) / 3.0;
#else
    vec3 color = vec3(1.0);
    float inverse_square = 0.0;
#endif
    vec3 direction = normalize(vec3(pupil - film, frame.lens_rear));
    LensRay ray = lens_trace(vec3(film, 0.0), direction, inverse_square);
    // cos⁴θ / Z² over the density, which is 1 / area
    vec2 size = bounds.high - bounds.low;
    float cosine = direction.z * direction.z;
    float weight = ray.weight * frame.lens_weight * size.x * size.y * cosine * cosine;
    bool passes = weight > 0.0;
    vec3 origin = passes ? ray.origin * frame.lens_unit : vec3(0.0);
    vec3 view = passes ? normalize(ray.direction) : vec3(0.0, 0.0, 1.0);
    return CameraRay(frame.camera_position + world_from_view(origin), world_from_view(view),
                     passes ? color * weight : vec3(0.0), 0.0, pixel_height() * frame.lens_spread);
}
