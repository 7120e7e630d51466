// The one place that moves a ray off the surface that it starts on.
#include "base/math.glsl"

// Moves `p` to the side of the unit normal `n` by a few units in the last place, at least 2^-16 near the origin
// (Wächter and Binder, Ray Tracing Gems, chapter 6).
vec3 offset_ray_origin(vec3 p, vec3 n)
{
    ivec3 steps = ivec3(256.0 * n);
    vec3 moved = intBitsToFloat(floatBitsToInt(p) + ivec3(p.x < 0.0 ? -steps.x : steps.x,
                                                          p.y < 0.0 ? -steps.y : steps.y,
                                                          p.z < 0.0 ? -steps.z : steps.z));
    vec3 near = p + n * (1.0 / 65536.0);
    return vec3(abs(p.x) < 1.0 / 32.0 ? near.x : moved.x,
                abs(p.y) < 1.0 / 32.0 ? near.y : moved.y,
                abs(p.z) < 1.0 / 32.0 ? near.z : moved.z);
}
