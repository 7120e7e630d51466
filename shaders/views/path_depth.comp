// The view `path-depth`: the number of scattering events of a path, as heat from 0 to `max_depth`. Samples that are not finite are left
// out as in the picture.
#define VIEW
#include "stages/film.glsl"
#include "views/heat.glsl"

void show(inout uvec4 word, inout PixelSums sums)
{
    vec3 radiance = uintBitsToFloat(word.xyz);
    if (!is_finite(radiance.x + radiance.y + radiance.z)) return;
    float events = float(word.w & PATH_DEPTH_MASK);
    word.xyz = floatBitsToUint(heat(events / float(max(frame.max_depth, 1u))));
}
