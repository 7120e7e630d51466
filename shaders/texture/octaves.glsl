// Sums of octaves of noise. Those that a pixel cannot resolve fade to their mean (after pbrt, FBm and Turbulence).
#include "shared/bindings.glsl"
#include "texture/perlin.glsl"

// How many octaves, each of twice the frequency, a pixel of a width resolves, whose first has a period of about 1.
float resolved_octaves(float width) { return width > 0.0 ? -1.0 - log2(width) : 1e9; }
// How much is left of the octave that is followed by so many more.
float octave_weight(float resolved) { return smoothstep(0.3, 0.7, resolved); }

float octave_plain(float n) { return n; }
float octave_creased(float n) { return abs(n); }
float octave_ridged(float n) { return (1.0 - abs(n)) * (1.0 - abs(n)); }

// The sum whose record is at word w: of `shaped` of a noise, whose mean is `mean`.
#define NOISE_SUM(name, noise, shaped, mean) \
    float name(uint w, vec4 p, float width) \
    { \
        NoiseSum record = noise_sum_unpack(fetch_textures(w)); \
        float resolved = resolved_octaves(width); \
        float rate = log2(record.lacunarity); \
        float amplitude = record.scale; \
        float sum = 0.0; \
        uint i = 0u; \
        for (; i < record.octaves && resolved > 0.3; ++i) { \
            float weight = octave_weight(resolved); \
            sum += amplitude * (weight * shaped(noise(p)) + (1.0 - weight) * mean); \
            amplitude *= record.gain; \
            p *= record.lacunarity; \
            resolved -= rate; \
        } \
        if (mean != 0.0) { \
            for (; i < record.octaves; ++i) { \
                sum += amplitude * mean; \
                amplitude *= record.gain; \
            } \
        } \
        return sum; \
    }

// A sum to a colour: of terms of either sign, of terms that are not negative, and as it is.
vec4 texture_signed(float sum, vec4 low, vec4 high) { return mix(low, high, clamp(0.5 + 0.5 * sum, 0.0, 1.0)); }
vec4 texture_positive(float sum, vec4 low, vec4 high) { return mix(low, high, clamp(sum, 0.0, 1.0)); }
vec4 texture_raw(float sum, vec4 low, vec4 high) { return mix(low, high, sum); }
