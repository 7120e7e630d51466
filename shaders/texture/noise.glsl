// Improved gradient noise (Perlin 2002, Improving Noise), with the permutation of its reference: between −1 and 1, 0 at the
// points of the lattice, the same again after 256 cells.
#include "shared/bindings.glsl"

// What i and i + 1 become. The permutation is at the start of the texture records of a scene with noise: an array that a kernel
// holds is written again by lavapipe in every invocation.
uvec2 permuted(uint i) { return fetch_textures(i & 255u).xy; }

float perlin_fade(float t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

// The product of the offset p and one of twelve directions, from the centre of a cube to its edges. Four of them are there twice:
// in the noise of pbrt (util/noise.cpp) not quite the same.
float perlin_gradient(uint hash, vec3 p, bool pbrt)
{
    uint h = hash & 15u;
    bool twice = h == 12u || h == (pbrt ? 13u : 14u);
    float u = h < 8u || (pbrt && twice) ? p.x : p.y;
    float v = h < 4u || (pbrt && twice) ? p.y : twice ? p.x : p.z;
    return ((h & 1u) == 0u ? u : -u) + ((h & 2u) == 0u ? v : -v);
}

float gradient_noise(vec3 point, bool pbrt)
{
    vec3 cell = floor(point);
    vec3 p = point - cell;
    // Whole numbers modulo 256, of floats that an int may not hold
    uvec3 i = uvec3(cell - 256.0 * floor(cell * (1.0 / 256.0)));
    vec3 w = vec3(perlin_fade(p.x), perlin_fade(p.y), perlin_fade(p.z));
    uvec2 x = permuted(i.x);
    uvec2 y0 = permuted(x.x + i.y);
    uvec2 y1 = permuted(x.y + i.y);
    uvec2 h00 = permuted(y0.x + i.z);
    uvec2 h01 = permuted(y0.y + i.z);
    uvec2 h10 = permuted(y1.x + i.z);
    uvec2 h11 = permuted(y1.y + i.z);
    float x00 = mix(perlin_gradient(h00.x, p, pbrt), perlin_gradient(h10.x, p - vec3(1, 0, 0), pbrt), w.x);
    float x10 = mix(perlin_gradient(h01.x, p - vec3(0, 1, 0), pbrt), perlin_gradient(h11.x, p - vec3(1, 1, 0), pbrt), w.x);
    float x01 = mix(perlin_gradient(h00.y, p - vec3(0, 0, 1), pbrt), perlin_gradient(h10.y, p - vec3(1, 0, 1), pbrt), w.x);
    float x11 = mix(perlin_gradient(h01.y, p - vec3(0, 1, 1), pbrt), perlin_gradient(h11.y, p - vec3(1, 1, 1), pbrt), w.x);
    return mix(mix(x00, x10, w.y), mix(x01, x11, w.y), w.z);
}

float perlin_noise(vec3 point) { return gradient_noise(point, false); }
float pbrt_noise(vec3 point) { return gradient_noise(point, true); }
