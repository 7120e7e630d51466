//! The permutation and the gradients of noise.

/// Of the reference implementation of improved noise (Perlin 2002).
const PERMUTATION: [u32; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99,
    37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27,
    166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244,
    102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130,
    116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147,
    118, 126, 255, 82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119,
    248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110,
    79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179,
    162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204, 176,
    115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78,
    66, 215, 61, 156, 180,
];

/// The words of `permuted` in `texture/noise.glsl`: what i and i + 1 become; and those of `classic_gradient` in
/// `texture/perlin.glsl`: a vector in four dimensions that has no preferred direction, in signed parts of 16 bits.
pub(super) fn words() -> impl Iterator<Item = [u32; 4]> {
    let mut random = 0x853c_49e6_748f_ea9b;
    (0..256).map(move |i| {
        let [x, y, z, w] = gradient(&mut random).map(|v| u32::from((v * 32767.0).round() as i16 as u16));
        [PERMUTATION[i], PERMUTATION[(i + 1) & 255], x | y << 16, z | w << 16]
    })
}

/// Uniform in the unit ball, and not so near to the axis of z and w that 16 bits would tell few directions of x and y.
fn gradient(random: &mut u64) -> [f64; 4] {
    loop {
        let v = [(); 4].map(|()| uniform(random));
        let [x, y, z, w] = v.map(|v| v * v);
        if x + y + z + w <= 1.0 && x + y > 1e-3 {
            return v;
        }
    }
}

/// From −1 to 1: the upper half of a linear congruential generator (Knuth's MMIX).
fn uniform(random: &mut u64) -> f64 {
    *random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*random >> 32) as f64 * (2.0 / 4_294_967_295.0) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_there_once() {
        let mut sorted = PERMUTATION;
        sorted.sort_unstable();
        assert!((0..256).eq(sorted));
    }
}
