//! `shaders/texture/image.glsl`: the sRGB curve and every wrap mode.

use crate::common::probe::{Probe, Word, as_doubles, floats};
use crate::common::twins::texture;
use dapple::layout::{WRAP_BLACK, WRAP_CLAMP, WRAP_MIRROR, WRAP_REPEAT};

#[test]
fn srgb_is_decoded() {
    let glsl = "#include \"texture/image.glsl\"
        void probe(uint i) {
            store_values(i, floatBitsToUint(vec4(srgb_decode(uintBitsToFloat(fetch_points(i).xyz)), 0.0)));
        }";
    let mut inputs: Vec<Word> =
        (0..=255).map(|i| floats(i as f32 / 255.0, 0.04045, 0.040_450_1, 0.0)).collect();
    inputs.extend((0..=4096).map(|i| floats(i as f32 / 4096.0, 0.0, 1.0, 0.0)));
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (input, value) in inputs.iter().zip(&values) {
        let (input, value) = (as_doubles(*input), as_doubles(*value));
        for c in 0..3 {
            let expected = texture::srgb_decode(input[c]);
            // pow is exp2(y log2(x)) in Vulkan: 16 ulp here, a hundredth of a step of 8 bits at most
            assert!((value[c] - expected).abs() < 4e-6, "{}: {} not {expected}", input[c], value[c]);
        }
    }
    assert_eq!(as_doubles(values[0])[0], 0.0);
    assert!((as_doubles(values[255])[0] - 1.0).abs() < 1e-6);
    // Half way in sRGB is a fifth of the light
    assert!((as_doubles(values[128])[0] - 0.215_861).abs() < 4e-6);
}

#[test]
fn indices_wrap_as_documented() {
    let glsl = "#include \"texture/image.glsl\"
        void probe(uint i) {
            ivec4 p = ivec4(fetch_points(i));
            bvec2 outside;
            uvec2 at = wrap_pair(p.x, p.y, uint(p.z), outside);
            store_values(i, uvec4(at, uvec2(outside)));
        }";
    let mut inputs: Vec<Word> = Vec::new();
    for mode in [WRAP_REPEAT, WRAP_CLAMP, WRAP_MIRROR, WRAP_BLACK] {
        for n in 1..=9_i32 {
            inputs.extend((-50..=50_i32).map(|i| [i as u32, n as u32, mode, 0]));
        }
        // The largest picture and the wildest uv that image_place lets through
        for n in [3, 255, 1000, 4096, 16_384_i32] {
            for turn in [-1000, -7, 0, 9, 1000] {
                inputs.extend([-1, 0, 1, n - 1].map(|i| [(turn * n + i) as u32, n as u32, mode, 0]));
            }
        }
    }
    let values = Probe::new().both(glsl, &inputs, inputs.len(), inputs.len());
    for (input, value) in inputs.iter().zip(&values) {
        let [i, n, mode, _] = *input;
        let [(at, outside), (next, outside_next)] =
            [0, 1].map(|step| texture::wrap_index(i as i32 + step, n as i32, mode));
        let expected = [at as u32, next as u32, u32::from(outside), u32::from(outside_next)];
        assert_eq!(*value, expected, "{} of {n}, mode {mode}", i as i32);
    }
}
