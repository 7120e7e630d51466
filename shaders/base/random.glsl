// Random numbers as a function of (pixel, sample, dimension, seed): no state.
// SAMPLER is a switch of the variant; its values are those of src/prepare/variant.rs.
#include "base/math.glsl"

// The key of a sample's numbers.
struct SampleKey { uint pixel; uint index; uvec2 strata; };

// A hash with low bias (C. Wellons, "Prospecting for hash functions", 2018: lowbias32).
uint hash(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

uint hash2(uint a, uint b) { return hash(a ^ (hash(b) + 0x9e3779b9u)); }

// 24 bits to [0, 1).
float uniform_float(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

SampleKey sample_key(uvec2 pixel, uint index, uint seed, uvec2 strata)
{
    return SampleKey(hash2(hash2(pixel.x, pixel.y), seed), index, strata);
}

// Owen scrambling of a number whose least significant bit comes first (Laine and Karras 2011, constants of
// N. Vegdahl 2021, as listed in pbrt-v4, section 8.6.3).
uint owen_hash(uint v, uint seed)
{
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
}

// The second dimension of Sobol's sequence, least significant bit first: the Pascal matrix modulo 2, which is a sum
// over supersets of the bit index (Lucas's theorem), done in five steps.
uint pascal_product(uint i)
{
    i ^= (i >> 1) & 0x55555555u;
    i ^= (i >> 2) & 0x33333333u;
    i ^= (i >> 4) & 0x0f0f0f0fu;
    i ^= (i >> 8) & 0x00ff00ffu;
    i ^= (i >> 16) & 0x0000ffffu;
    return i;
}

// Point `index` of a two-dimensional Owen-scrambled Sobol sequence in an order of its own (Burley 2020).
uvec2 sobol_2d(uint index, uint seed)
{
    uint i = bitfieldReverse(owen_hash(bitfieldReverse(index), seed));
    uint x = owen_hash(i, hash(seed ^ 0x68bc21ebu));
    uint y = owen_hash(pascal_product(i), hash(seed ^ 0x02e5be93u));
    return uvec2(bitfieldReverse(x), bitfieldReverse(y));
}

// A permutation of 0..n: a hash that permutes the next power of two, walked along its cycle until it is back
// in range (Kensler 2013). It gives up after 32 steps, which happens for less than one index in 2^32.
uint permute(uint i, uint n, uint seed)
{
    uint mask = n - 1u;
    mask |= mask >> 1;
    mask |= mask >> 2;
    mask |= mask >> 4;
    mask |= mask >> 8;
    mask |= mask >> 16;
    for (uint walk = 0u; walk < 32u; ++walk) {
        // Rounds of steps that can be undone within the mask, each with other bits of the seed
        uint bits = seed;
        for (uint turn = 0u; turn < 4u; ++turn) {
            i = ((i ^ bits) * ((bits >> 15) | 1u)) & mask;
            i ^= i >> (1u + (turn & 1u));
            bits = ((bits >> 9) | (bits << 23)) * 0x6935fa69u;
        }
        if (i < n) break;
    }
    return i % n;
}

vec2 random_2d(SampleKey key, uint dimension)
{
    uint a = hash2(key.pixel + dimension * 0x9e3779b9u, key.index);
    return vec2(uniform_float(a), uniform_float(hash(a ^ 0x5bd1e995u)));
}

// The cell of sample `index`, in an order that starts anew, shuffled, every strata.x · strata.y samples.
uvec2 stratum(SampleKey key, uint dimension)
{
    uint cells = key.strata.x * key.strata.y;
    uint seed = hash2(key.pixel + dimension, key.index / cells);
    uint cell = permute(key.index % cells, cells, seed);
    return uvec2(cell % key.strata.x, cell / key.strata.x);
}

// Two numbers in [0, 1) for a dimension of a sample.
vec2 sample_2d(SampleKey key, uint dimension)
{
#if SAMPLER == SAMPLER_SOBOL
    uvec2 bits = sobol_2d(key.index, hash(key.pixel + dimension * 0x9e3779b9u));
    return vec2(uniform_float(bits.x), uniform_float(bits.y));
#elif SAMPLER == SAMPLER_STRATIFIED
    vec2 jittered = vec2(stratum(key, dimension)) + random_2d(key, dimension);
    return min(jittered / vec2(key.strata), vec2(ONE_MINUS_EPSILON));
#else
    return random_2d(key, dimension);
#endif
}

float sample_1d(SampleKey key, uint dimension) { return sample_2d(key, dimension).x; }

// Where in its pixel a sample lies, in [0, 1)²: the one dimension in which `center` and `regular` differ from `random`.
vec2 sample_pixel(SampleKey key, uint dimension)
{
#if SAMPLER == SAMPLER_CENTER
    return vec2(0.5);
#elif SAMPLER == SAMPLER_REGULAR
    uint cell = key.index % (key.strata.x * key.strata.y);
    return (vec2(cell % key.strata.x, cell / key.strata.x) + 0.5) / vec2(key.strata);
#else
    return sample_2d(key, dimension);
#endif
}

// Dimensions of the camera, then of each bounce.
const uint DIMENSION_PIXEL = 0u;
const uint DIMENSION_LENS = 1u;
const uint DIMENSION_TIME = 2u;
const uint DIMENSION_OPENING = 6u;
const uint DIMENSION_WAVELENGTH = 7u;
const uint DIMENSION_BOUNCES = 8u;
const uint DIMENSIONS_A_BOUNCE = 8u;
const uint DIMENSION_LIGHT_PICK = 0u;
const uint DIMENSION_LIGHT = 1u;
const uint DIMENSION_LOBE = 2u;
const uint DIMENSION_BSDF = 3u;
const uint DIMENSION_ROULETTE = 4u;
const uint DIMENSION_MIX = 5u;

uint bounce_dimension(uint depth, uint which) { return DIMENSION_BOUNCES + depth * DIMENSIONS_A_BOUNCE + which; }
