//! Twins of `texture/perlin.glsl`, `texture/value_noise.glsl` and the hash of `texture/worley.glsl`. Improved noise in 3 dimensions
//! is tested against its reference, that of pbrt here.

use dapple::scene::PerlinVariant;

/// Three numbers of 32 bits from three.
pub fn pcg3d(v: [u32; 3]) -> [u32; 3] {
    let mut v = v.map(|x| x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mix = |v: &mut [u32; 3]| {
        for (to, a, b) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            v[to] = v[to].wrapping_add(v[a].wrapping_mul(v[b]));
        }
    };
    mix(&mut v);
    v = v.map(|x| x ^ x >> 16);
    mix(&mut v);
    v
}

fn sign(bit: u32) -> f64 {
    if bit == 0 { 1.0 } else { -1.0 }
}

/// The product of a gradient and an offset, scaled; `table` are the first 256 words of the texture records.
fn gradient(table: &[[u32; 4]], hash: u32, d: &[f64], classic: bool) -> f64 {
    if classic {
        let word = table[(hash & 255) as usize];
        let part = |bits: u32| f64::from(bits as u16 as i16) / 32767.0;
        let g = [part(word[2]), part(word[2] >> 16), part(word[3]), part(word[3] >> 16)];
        // x of a unit vector in three dimensions is uniform
        let (known, scale) =
            [(3, 2.0), (2, 2.0_f64.sqrt()), (3, 2.0 / 3.0_f64.sqrt()), (4, 1.0)][d.len() - 1];
        let length = g[..known].iter().map(|x| x * x).sum::<f64>().sqrt();
        return scale * d.iter().zip(g).map(|(d, g)| d * g / length).sum::<f64>();
    }
    let [a, b, c] = [hash & 1, hash & 2, hash & 4];
    match *d {
        [x] => sign(a) * 0.25 * f64::from(1 + ((hash >> 1) & 7)) * x,
        [x, y] if c == 0 => 0.6616 * (sign(a) * x + 2.0 * sign(b) * y),
        [x, y] => 0.6616 * (2.0 * sign(a) * x + sign(b) * y),
        [x, y, z, w] => {
            let [p, q, r] = [[y, z, w], [x, z, w], [x, y, w], [x, y, z]][((hash >> 3) & 3) as usize];
            0.6514 * (sign(a) * p + sign(b) * q + sign(c) * r)
        }
        // pbrt's: 12 is (x, y), 13 is (−x, y), 14 is (y, −z) and 15 is (−y, −z)
        [x, y, z] => {
            let (u, v) = match hash & 15 {
                0..=3 | 12 | 13 => (x, y),
                4..=7 => (x, z),
                _ => (y, z),
            };
            sign(a) * u + sign(b) * v
        }
        _ => unreachable!("noise has 1 to 4 dimensions"),
    }
}

/// Gradient noise by its definition: the corners of the cell, weighted.
pub fn perlin(table: &[[u32; 4]], p: &[f64], variant: PerlinVariant) -> f64 {
    let classic = variant == PerlinVariant::Classic;
    let mut sum = 0.0;
    for corner in 0..1_u32 << p.len() {
        let (mut hash, mut weight, mut d) = (0_u32, 1.0, Vec::new());
        for (k, x) in p.iter().enumerate() {
            let far = corner >> k & 1;
            let inside = x - x.floor();
            let index = (x.floor() as i64 + i64::from(far)).rem_euclid(256) as u32;
            hash = table[((hash + index) & 255) as usize][0];
            let t = inside;
            let fade =
                if classic { t * t * (3.0 - 2.0 * t) } else { t * t * t * (t * (t * 6.0 - 15.0) + 10.0) };
            weight *= if far == 1 { fade } else { 1.0 - fade };
            d.push(inside - f64::from(far));
        }
        sum += weight * gradient(table, hash, &d, classic);
    }
    sum
}

/// The lecture's noise: `length` values between ± amplitude along each axis, `frequency` of them in a unit, 3t² − 2t³ between;
/// octaves of twice the frequency and half the amplitude.
pub fn value_noise(p: &[f64], length: u32, amplitude: f64, frequency: f64, octaves: u32) -> f64 {
    let mut sum = 0.0;
    for octave in 0..octaves {
        let scaled: Vec<f64> = p.iter().map(|x| x * frequency * f64::from(1 << octave)).collect();
        for corner in 0..1_u32 << p.len() {
            let (mut weight, mut at) = (amplitude / f64::from(1 << octave), [0_u32; 3]);
            for (k, x) in scaled.iter().enumerate() {
                let far = corner >> k & 1;
                let t = x - x.floor();
                let fade = t * t * (3.0 - 2.0 * t);
                weight *= if far == 1 { fade } else { 1.0 - fade };
                at[k] = (x.floor() as i64 + i64::from(far)).rem_euclid(i64::from(length)) as u32;
            }
            let bits = pcg3d([at[0], at[1], at[2] + (octave << 20)])[0] >> 8;
            sum += weight * (f64::from(bits) / 8_388_608.0 - 1.0);
        }
    }
    sum
}
