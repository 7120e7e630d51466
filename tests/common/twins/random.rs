//! Twins of `base/random.glsl`.

/// The inverse of `hash` (C. Wellons, "Prospecting for hash functions", 2018: lowbias32_r).
pub fn hash_inverse(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x4302_1123);
    x ^= (x >> 15) ^ (x >> 30);
    x = x.wrapping_mul(0x1d69_e2a5);
    x ^ (x >> 16)
}

pub fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

pub fn hash2(a: u32, b: u32) -> u32 {
    hash(a ^ hash(b).wrapping_add(0x9e37_79b9))
}

/// Nested uniform scrambling of a number whose most significant bit comes first, as it is written in pbrt-v4, section
/// 8.6.3 (FastOwenScrambler).
pub fn fast_owen(v: u32, seed: u32) -> u32 {
    let mut v = v.reverse_bits();
    v ^= v.wrapping_mul(0x3d20_adea);
    v = v.wrapping_add(seed);
    v = v.wrapping_mul((seed >> 16) | 1);
    v ^= v.wrapping_mul(0x0552_6c56);
    v ^= v.wrapping_mul(0x53a2_2864);
    v.reverse_bits()
}

/// Both dimensions of point `index` of Sobol's sequence, by 32 direction numbers each.
pub fn sobol(index: u32) -> [u32; 2] {
    let (mut x, mut y) = (0, 0);
    let (mut van_der_corput, mut direction) = (1_u32 << 31, 1_u32 << 31);
    for bit in 0..32 {
        if index >> bit & 1 != 0 {
            x ^= van_der_corput;
            y ^= direction;
        }
        van_der_corput >>= 1;
        direction ^= direction >> 1;
    }
    [x, y]
}

pub fn sobol_2d(index: u32, seed: u32) -> [u32; 2] {
    // The order of the points is scrambled as if the index were a fraction of 32 bits
    let [x, y] = sobol(fast_owen(index, seed));
    [fast_owen(x, hash(seed ^ 0x68bc_21eb)), fast_owen(y, hash(seed ^ 0x02e5_be93))]
}
