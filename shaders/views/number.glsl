// Colours of numbers: each of the first 16,777,215 has three bytes of its own, from which it can be told.
#include "shared/layout.glsl"

vec3 color_of_number(uint number)
{
    uint bits = (number + 1u) * NUMBER_FACTOR;
    return vec3(uvec3(bits >> 16, bits >> 8, bits) & 255u) * (1.0 / 255.0);
}
