// What a texture of the user's own has at hand: noise, cells, and sums of noise whose octaves fade where a pixel of a width in the
// space of p cannot resolve them.
#include "texture/octaves.glsl"
#include "texture/worley.glsl"

#define LIBRARY_SUM(name, shaped, mean) \
    float name(vec3 p, float width, uint octaves) \
    { \
        float resolved = resolved_octaves(width); \
        float amplitude = 1.0; \
        float sum = 0.0; \
        float whole = 0.0; \
        for (uint i = 0u; i < octaves; ++i) { \
            float weight = octave_weight(resolved); \
            sum += amplitude * (weight * shaped(perlin_noise(p)) + (1.0 - weight) * mean); \
            whole += amplitude; \
            amplitude *= 0.5; \
            resolved -= 1.0; \
            p *= 2.0; \
        } \
        return sum / max(whole, 1e-20); \
    }
LIBRARY_SUM(fbm_noise, octave_plain, 0.0)
LIBRARY_SUM(turbulence_noise, octave_creased, 0.2)
