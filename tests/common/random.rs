//! Random inputs of tests, the same in every run.

/// SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn u32(&mut self) -> u32 {
        (self.u64() >> 32) as u32
    }

    /// In [0, 1), a multiple of 2⁻²⁴, as `uniform_float` of the shaders gives.
    pub fn f32(&mut self) -> f32 {
        (self.u32() >> 8) as f32 / 16_777_216.0
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.f32()
    }

    /// A point of a cube about the origin.
    pub fn cube(&mut self, half: f32) -> [f32; 3] {
        [self.between(-half, half), self.between(-half, half), self.between(-half, half)]
    }

    /// A unit vector.
    pub fn direction(&mut self) -> [f32; 3] {
        loop {
            let v = self.cube(1.0);
            let l2 = v.iter().map(|c| c * c).sum::<f32>();
            if (1e-3..=1.0).contains(&l2) {
                return v.map(|c| c / l2.sqrt());
            }
        }
    }
}
