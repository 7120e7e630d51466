// Numbers that marble and wood are made of.
#include "shared/bindings.glsl"
#include "texture/octaves.glsl"

// A wave along y that noise bends (pbrt, MarbleTexture); its mean where the pixel is wider than it. The variation is at word w.
float veins_marble(uint w, vec3 p, float width, float noise)
{
    float wave = sin(p.y + node_number_unpack(fetch_textures(w)).number * noise);
    return 0.5 + 0.5 * wave * octave_weight(resolved_octaves(width * (0.5 / PI)));
}

// Frequencies of the noise that bends wood.
const vec3 WOOD_BEND = vec3(0.3, 0.3, 0.08);

// Rings of width 1 about the z axis: light wood that darkens and ends at a line. The variation is at word w, fibres come from
// noise that is drawn out along z.
float veins_wood(uint w, vec3 p, float width, vec2 noise)
{
    float variation = node_number_unpack(fetch_textures(w)).number;
    float ring = length(p.xy + variation * noise);
    float place = ring - floor(ring);
    float late = smoothstep(0.2, 0.85, place) * (1.0 - smoothstep(0.9, 1.0, place));
    // 0.425 is the mean over a ring
    float rings = mix(0.425, late, octave_weight(resolved_octaves(width)));
    float fibres = perlin_noise(p * vec3(24.0, 24.0, 0.75)) * octave_weight(resolved_octaves(24.0 * width));
    return clamp(0.1 + 0.7 * rings + 0.2 * fibres, 0.0, 1.0);
}
