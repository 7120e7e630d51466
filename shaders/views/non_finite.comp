// The view `non-finite`: samples that are not a number are magenta, infinite ones yellow, negative ones cyan, and all others a dim grey
// of what they are. The film counts the first two as samples that it left out, as it does without the view.
#define VIEW
#include "stages/film.glsl"

// One marked sample among many is seen: it is so many times as bright as white.
const float MARK = 64.0;
const vec3 MARK_NAN = vec3(MARK, 0.0, MARK);
const vec3 MARK_INFINITE = vec3(MARK, MARK, 0.0);
const vec3 MARK_NEGATIVE = vec3(0.0, MARK, MARK);
const float BRIGHTEST_GREY = 0.2;

bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }

// From 0 to BRIGHTEST_GREY, for scenes of any brightness.
float dim(vec3 radiance)
{
    float root = sqrt(mean_component(radiance));
    return BRIGHTEST_GREY * root / (1.0 + root);
}

void show(inout uvec4 word, inout PixelSums sums)
{
    vec3 radiance = uintBitsToFloat(word.xyz);
    bool nan = is_nan(radiance.x) || is_nan(radiance.y) || is_nan(radiance.z);
    vec3 shown;
    if (nan || !is_finite(radiance.x + radiance.y + radiance.z)) {
        shown = nan ? MARK_NAN : MARK_INFINITE;
        sums.left_out += 1u;
        // What denoisers are given may be of the same kind
        word.w &= ~(PATH_HAS_AOV << PATH_FLAGS_SHIFT);
    } else {
        shown = min(radiance.x, min(radiance.y, radiance.z)) < 0.0 ? MARK_NEGATIVE : vec3(dim(radiance));
    }
    word.xyz = floatBitsToUint(shown);
}
