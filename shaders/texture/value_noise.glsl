// Value noise: random values at the points of a lattice, smooth between them, and octaves of it (cheap tricks, perlin noise).
#include "shared/bindings.glsl"
#include "texture/octaves.glsl"
#include "texture/worley.glsl"

// The lattice point before x, modulo n. Division is not exact on every device: the quotient may be off by one.
uint lattice_point(float x, float n)
{
    float rest = x - n * floor(x / n);
    rest = rest < 0.0 ? rest + n : rest >= n ? rest - n : rest;
    return uint(clamp(rest, 0.0, n - 1.0));
}

uint lattice_next(uint i, uint n) { return i + 1u == n ? 0u : i + 1u; }

// Uniform from −1 to 1.
float lattice_value(uint x, uint y, uint z, uint octave)
{
    return float(pcg3d(uvec3(x, y, z + (octave << 20))).x >> 8u) * (1.0 / 8388608.0) - 1.0;
}

float lattice_line(uint x, uint next, float t, uint y, uint z, uint octave)
{
    return mix(lattice_value(x, y, z, octave), lattice_value(next, y, z, octave), t);
}

// One octave of amplitude 1 in 1 to 3 dimensions; p is in cells of the lattice of n points.
float value_octave(vec3 p, uint n, uint octave, uint dimensions)
{
    vec3 corner = floor(p);
    vec3 t = p - corner;
    t = t * t * (3.0 - 2.0 * t);
    uint x0 = lattice_point(corner.x, float(n));
    uint x1 = lattice_next(x0, n);
    if (dimensions == 1u) return lattice_line(x0, x1, t.x, 0u, 0u, octave);
    uint y0 = lattice_point(corner.y, float(n));
    uint y1 = lattice_next(y0, n);
    uint z0 = dimensions == 2u ? 0u : lattice_point(corner.z, float(n));
    float near = mix(lattice_line(x0, x1, t.x, y0, z0, octave), lattice_line(x0, x1, t.x, y1, z0, octave), t.y);
    if (dimensions == 2u) return near;
    uint z1 = lattice_next(z0, n);
    float far = mix(lattice_line(x0, x1, t.x, y0, z1, octave), lattice_line(x0, x1, t.x, y1, z1, octave), t.y);
    return mix(near, far, t.z);
}

// The sum whose record is at word w. An octave that is not resolved fades to its mean, 0.
float value_noise(uint w, vec3 p, float width, uint dimensions)
{
    ValueLattice record = value_lattice_unpack(fetch_textures(w));
    p *= record.frequency;
    float resolved = resolved_octaves(width * record.frequency);
    float amplitude = record.amplitude;
    float sum = 0.0;
    for (uint i = 0u; i < record.octaves && resolved > 0.3; ++i) {
        sum += amplitude * octave_weight(resolved) * value_octave(p, record.points, i, dimensions);
        amplitude *= 0.5;
        p *= 2.0;
        resolved -= 1.0;
    }
    return sum;
}
