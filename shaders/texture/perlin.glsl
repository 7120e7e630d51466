// Gradient noise in 1 to 4 dimensions, improved (2002) and classic (Perlin 1985, An Image Synthesizer), scaled so that no choice
// of gradients could leave −1 to 1. Improved noise in 3 dimensions is that of the reference, in texture/noise.glsl.
#include "shared/bindings.glsl"
#include "texture/noise.glsl"

// A point between the points of the lattice: its cell modulo 256, where it is in the cell, and the weights of the far ends.
struct Lattice {
    uvec4 cell;
    vec4 inside;
    vec4 weight;
};

Lattice lattice_of(vec4 point, bool classic)
{
    Lattice l;
    vec4 cell = floor(point);
    l.inside = point - cell;
    l.cell = uvec4(cell - 256.0 * floor(cell * (1.0 / 256.0)));
    vec4 t = l.inside;
    l.weight = classic ? t * t * (3.0 - 2.0 * t) : t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    return l;
}

// Random gradients: of a vector that has no preferred direction in 4 dimensions, the first few have none in theirs, and x of a unit
// vector in 3 dimensions is uniform.
float classic_gradient(uint hash, vec4 p, uint dimensions)
{
    uvec4 word = fetch_textures(hash & 255u);
    vec4 g = vec4(unpackSnorm2x16(word.z), unpackSnorm2x16(word.w));
    if (dimensions == 1u) return 2.0 * normalize(g.xyz).x * p.x;
    if (dimensions == 2u) return 1.41421356 * dot(normalize(g.xy), p.xy);
    if (dimensions == 3u) return 1.15470054 * dot(normalize(g.xyz), p.xyz);
    return dot(normalize(g), p);
}

// Eight slopes either way; the eight directions (±1, ±2) and (±2, ±1); the 32 from the centre of a hypercube to its edges.
float improved_gradient(uint hash, vec4 p, uint dimensions)
{
    float signs = (hash & 1u) == 0u ? 1.0 : -1.0;
    float other = (hash & 2u) == 0u ? 1.0 : -1.0;
    if (dimensions == 1u) return signs * 0.25 * (1.0 + float((hash >> 1) & 7u)) * p.x;
    if (dimensions == 2u) return (hash & 4u) == 0u ? 0.6616 * (signs * p.x + 2.0 * other * p.y) : 0.6616 * (2.0 * signs * p.x + other * p.y);
    float third = (hash & 4u) == 0u ? 1.0 : -1.0;
    uint without = (hash >> 3) & 3u;
    vec3 q = without == 0u ? p.yzw : without == 1u ? p.xzw : without == 2u ? p.xyw : p.xyz;
    return 0.6514 * (signs * q.x + other * q.y + third * q.z);
}

float lattice_gradient(uint hash, vec4 p, uint dimensions, bool classic)
{
    return classic ? classic_gradient(hash, p, dimensions) : improved_gradient(hash, p, dimensions);
}

// The two ends of an edge along the last axis.
vec2 lattice_ends(uint hash, uint cell, vec4 p, uint dimensions, bool classic)
{
    uvec2 h = permuted(hash + cell);
    vec4 last = vec4(equal(uvec4(dimensions), uvec4(1, 2, 3, 4)));
    return vec2(lattice_gradient(h.x, p, dimensions, classic), lattice_gradient(h.y, p - last, dimensions, classic));
}

float perlin_1(vec4 point, bool classic)
{
    Lattice l = lattice_of(point, classic);
    vec2 ends = lattice_ends(0u, l.cell.x, l.inside, 1u, classic);
    return mix(ends.x, ends.y, l.weight.x);
}

float perlin_2(vec4 point, bool classic)
{
    Lattice l = lattice_of(point, classic);
    uvec2 x = permuted(l.cell.x);
    vec2 near = lattice_ends(x.x, l.cell.y, l.inside, 2u, classic);
    vec2 far = lattice_ends(x.y, l.cell.y, l.inside - vec4(1, 0, 0, 0), 2u, classic);
    vec2 ends = mix(near, far, l.weight.x);
    return mix(ends.x, ends.y, l.weight.y);
}

vec2 lattice_face(Lattice l, uint hash, vec4 p, bool classic)
{
    uvec2 y = permuted(hash + l.cell.y);
    vec2 near = lattice_ends(y.x, l.cell.z, p, 3u, classic);
    vec2 far = lattice_ends(y.y, l.cell.z, p - vec4(0, 1, 0, 0), 3u, classic);
    return mix(near, far, l.weight.y);
}

float perlin_3(vec4 point, bool classic)
{
    Lattice l = lattice_of(point, classic);
    uvec2 x = permuted(l.cell.x);
    vec2 near = lattice_face(l, x.x, l.inside, classic);
    vec2 far = lattice_face(l, x.y, l.inside - vec4(1, 0, 0, 0), classic);
    vec2 ends = mix(near, far, l.weight.x);
    return mix(ends.x, ends.y, l.weight.z);
}

vec2 lattice_cube_face(Lattice l, uint hash, vec4 p, bool classic)
{
    uvec2 z = permuted(hash + l.cell.z);
    vec2 near = lattice_ends(z.x, l.cell.w, p, 4u, classic);
    vec2 far = lattice_ends(z.y, l.cell.w, p - vec4(0, 0, 1, 0), 4u, classic);
    return mix(near, far, l.weight.z);
}

vec2 lattice_cube(Lattice l, uint hash, vec4 p, bool classic)
{
    uvec2 y = permuted(hash + l.cell.y);
    vec2 near = lattice_cube_face(l, y.x, p, classic);
    vec2 far = lattice_cube_face(l, y.y, p - vec4(0, 1, 0, 0), classic);
    return mix(near, far, l.weight.y);
}

float perlin_4(vec4 point, bool classic)
{
    Lattice l = lattice_of(point, classic);
    uvec2 x = permuted(l.cell.x);
    vec2 near = lattice_cube(l, x.x, l.inside, classic);
    vec2 far = lattice_cube(l, x.y, l.inside - vec4(1, 0, 0, 0), classic);
    vec2 ends = mix(near, far, l.weight.x);
    return mix(ends.x, ends.y, l.weight.w);
}

float noise_improved_1(vec4 p) { return perlin_1(p, false); }
float noise_improved_2(vec4 p) { return perlin_2(p, false); }
float noise_improved_3(vec4 p) { return perlin_noise(p.xyz); }
float noise_improved_4(vec4 p) { return perlin_4(p, false); }
float noise_pbrt_3(vec4 p) { return pbrt_noise(p.xyz); }
float noise_classic_1(vec4 p) { return perlin_1(p, true); }
float noise_classic_2(vec4 p) { return perlin_2(p, true); }
float noise_classic_3(vec4 p) { return perlin_3(p, true); }
float noise_classic_4(vec4 p) { return perlin_4(p, true); }
