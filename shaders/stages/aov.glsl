// What denoisers are given beside the colour. Switch of the variant: MOVING_CAMERA.
#include "stages/wave.glsl"
#include "geometry/surface.glsl"
#include "material/generated/inputs.glsl"
#ifdef MOVING_CAMERA
#include "geometry/motion.glsl"
#endif

// Where the camera is at the time of the path.
vec3 camera_position()
{
#ifdef MOVING_CAMERA
    Motion motion = motion_fetch(frame.camera_motion);
    return motion.open_position + path_time * (motion.close_position - motion.open_position);
#else
    return frame.camera_position;
#endif
}

// Albedo, depth and normal of the first surface that is neither mirror nor clear glass. The light that it sends out counts
// as albedo up to 1; the normal is on the side from which it is seen.
void write_aov(uint slot, inout Path path, Surface surface, Bsdf bsdf, vec3 emitted, vec3 facing_normal)
{
    vec3 albedo = bsdf.kind == MATERIAL_DIELECTRIC ? vec3(1.0) : bsdf.color;
    if (bsdf_has_parts(bsdf.kind)) albedo += bsdf.specular;
    albedo = clamp(albedo + emitted, 0.0, 1.0);
    float depth = distance(camera_position(), surface.position);
    store_aovs(slot * AOV_WORDS, uvec4(floatBitsToUint(albedo), floatBitsToUint(depth)));
    store_aovs(slot * AOV_WORDS + 1u, uvec4(floatBitsToUint(facing_normal), 0u));
    path.flags |= PATH_HAS_AOV;
}
