// The menu of cameras. CAMERA is a switch of the variant; its values are those of src/prepare/variant.rs.
#include "base/random.glsl"
#include "camera/ray.glsl"
#if CAMERA == CAMERA_LENS
#include "camera/lens_system.glsl"
#elif CAMERA == CAMERA_PERSPECTIVE
#include "camera/thin_lens.glsl"
#else
#include "camera/panorama.glsl"
#endif

// film_01: position on the film, (0, 0) at the top left of the picture.
CameraRay camera_sample(vec2 film_01, SampleKey key)
{
#if CAMERA == CAMERA_LENS
    return lens_system_sample(film_01, sample_2d(key, DIMENSION_LENS), key);
#elif CAMERA == CAMERA_ORTHOGRAPHIC
    return orthographic_sample(film_01);
#elif CAMERA == CAMERA_EQUIRECTANGULAR
    return equirectangular_sample(film_01);
#elif CAMERA == CAMERA_FISHEYE
    return fisheye_sample(film_01);
#else
    vec2 pick = OPENING == OPENING_PICTURE ? sample_2d(key, DIMENSION_OPENING) : vec2(0.0);
    return thin_lens_sample(film_01, sample_2d(key, DIMENSION_LENS), pick);
#endif
}
