//! `shaders/material`: every lobe against its own density, reciprocity and energy.

use super::lobe::{Lobe, bsdf, check_reciprocity, check_samples, directions, samples};
use crate::common::twins::fresnel;
use crate::common::twins::math::{cross, dot, normalize};
use crate::common::twins::sampling::{DISK_ERROR, disk_inverse, turn, turns_apart};
use dapple::layout::{
    DIELECTRIC_THIN, FRESNEL_EXACT, FRESNEL_INDEX, FRESNEL_NONE, FRESNEL_SCHLICK, MATERIAL_CONDUCTOR,
    MATERIAL_DIELECTRIC,
};
use dapple::scene::{BSDFS, InputNumber};

/// Every BSDF of the table with its defaults, and as bright as it can be with the least and the most of its numbers; but roundings
/// that a power above 100 makes larger are more than these tests allow.
fn rows() -> impl Iterator<Item = Lobe> {
    BSDFS.iter().flat_map(|row| {
        let color = |i: usize| row.colors.get(i).map_or(0.0, |color| color.default);
        let number = |of: fn(&InputNumber) -> f32| {
            [0, 1].map(|i| row.numbers.get(i).map_or(0.0, |number| of(number).min(100.0)))
        };
        let lobe = |[color, specular]: [f32; 2], numbers| Lobe {
            name: row.name,
            kind: bsdf(row.name),
            mode: DIELECTRIC_THIN,
            color: [color; 3],
            specular: [specular; 3],
            numbers,
            ..Lobe::default()
        };
        let bright = [0, 1].map(|i| if i < row.colors.len() { 1.0 / row.colors.len() as f32 } else { 0.0 });
        [
            lobe([color(0), color(1)], number(|number| number.default)),
            lobe(bright, number(|number| number.least)),
            lobe(bright, number(|number| number.most)),
        ]
    })
}

fn lobes() -> Vec<Lobe> {
    let white = [1.0; 3];
    let phong =
        Lobe { kind: bsdf("phong"), color: [0.3, 0.5, 0.2], specular: [0.7, 0.5, 0.4], ..Lobe::default() };
    let metal = Lobe { kind: MATERIAL_CONDUCTOR, mode: FRESNEL_NONE, color: white, ..Lobe::default() };
    let glass = Lobe { kind: MATERIAL_DIELECTRIC, ior: 1.5, ..Lobe::default() };
    let paper = Lobe { kind: bsdf("diffuse_transmission"), mode: DIELECTRIC_THIN, ..Lobe::default() };
    let own = vec![
        Lobe { name: "paper", color: [0.2, 0.5, 0.1], specular: [0.6, 0.3, 0.9], ..paper },
        Lobe { name: "paper that only lets through", specular: white, ..paper },
        Lobe { name: "diffuse", kind: bsdf("diffuse"), color: [0.2, 0.5, 1.0], ..Lobe::default() },
        Lobe { name: "phong 0", numbers: [0.0; 2], ..phong },
        Lobe { name: "phong 1", numbers: [1.0, 0.0], ..phong },
        Lobe { name: "phong 7.5", numbers: [7.5, 0.0], ..phong },
        Lobe { name: "phong 100", numbers: [100.0, 0.0], ..phong },
        Lobe {
            name: "phong without diffuse",
            numbers: [20.0, 0.0],
            color: [0.0; 3],
            specular: white,
            ..phong
        },
        Lobe { name: "metal 0.2", alpha: [0.2, 0.2], ..metal },
        Lobe { name: "metal 1", alpha: [1.0, 1.0], ..metal },
        Lobe {
            name: "metal 0.2 × 0.6",
            alpha: [0.2, 0.6],
            mode: FRESNEL_SCHLICK,
            color: [0.9, 0.6, 0.3],
            ..metal
        },
        Lobe { name: "metal exact", alpha: [0.5, 0.3], mode: FRESNEL_EXACT, color: [0.9, 0.6, 0.3], ..metal },
        Lobe {
            name: "metal by index",
            alpha: [0.4, 0.4],
            mode: FRESNEL_INDEX,
            specular: [0.2, 0.4, 1.4],
            k: [3.9, 2.4, 1.6],
            ..metal
        },
        Lobe { name: "glass 0.3", alpha: [0.3, 0.3], ..glass },
        Lobe { name: "glass 0.25 × 0.7", alpha: [0.25, 0.7], ..glass },
        Lobe { name: "bubble 0.4", alpha: [0.4, 0.4], ior: 0.75, ..glass },
    ];
    own.into_iter().chain(rows()).collect()
}

#[test]
fn samples_follow_the_density_and_weights_are_its_quotient() {
    check_samples(&lobes());
}

#[test]
fn lobes_go_back_to_the_square() {
    let diffuse = Lobe { name: "diffuse", kind: bsdf("diffuse"), color: [0.5; 3], ..Lobe::default() };
    let glossy = |name, exponent| {
        let (specular, numbers) = ([1.0; 3], [exponent, 0.0]);
        Lobe { name, kind: bsdf("phong"), specular, numbers, ..Lobe::default() }
    };
    for lobe in [diffuse, glossy("phong 1", 1.0), glossy("phong 20", 20.0), glossy("phong 300", 300.0)] {
        // A cosine is known to a rounding, which its power multiplies
        let tolerance = if lobe.kind == bsdf("diffuse") {
            DISK_ERROR
        } else {
            1e-6 + 3e-7 * (f64::from(lobe.numbers[0]) + 1.0)
        };
        for wo in directions() {
            let mirror = [-wo[0], -wo[1], wo[2]].map(f64::from);
            let side = normalize(cross(mirror, [0.6, -0.8, 0.0]));
            let other = cross(mirror, side);
            let (mut zero, mut kept) = (None, 0);
            for s in samples(&lobe, wo, 10_000, 5).iter().filter(|s| s.weight != [0.0; 3]) {
                kept += 1;
                let off = if lobe.kind == bsdf("diffuse") {
                    let back = disk_inverse(s.wi[0], s.wi[1]);
                    (back[0] - s.u01[0]).abs().max((back[1] - s.u01[1]).abs())
                } else {
                    let cos = dot(s.wi, mirror);
                    let angle = turn(dot(s.wi, side), dot(s.wi, other));
                    // The zero of the angle is anywhere
                    let zero = *zero.get_or_insert((angle - s.u01[1]).rem_euclid(1.0));
                    let back = cos.powf(f64::from(lobe.numbers[0]) + 1.0);
                    let sin = (1.0 - cos * cos).max(0.0).sqrt();
                    (back - s.u01[0]).abs().max(turns_apart(angle, s.u01[1] + zero) * sin)
                };
                assert!(off < tolerance, "{} from {wo:?}: {:?} is off by {off}", lobe.name, s.u01);
            }
            assert!(kept > 5000, "{} from {wo:?}: {kept}", lobe.name);
        }
    }
}

#[test]
fn lobes_are_reciprocal() {
    check_reciprocity(&lobes());
}

#[test]
fn mirrors_and_clear_glass() {
    let white = [0.5, 0.7, 0.9];
    let mirror = Lobe { kind: MATERIAL_CONDUCTOR, mode: FRESNEL_NONE, color: white, ..Lobe::default() };
    for wo in directions() {
        for s in samples(&mirror, wo, 64, 1) {
            let out = wo.map(f64::from);
            assert_eq!(s.wi, [-out[0], -out[1], out[2]]);
            assert!(s.pdf == 0.0 && !s.through && s.eval == [0.0; 3] && s.pdf_again == 0.0);
            assert!((0..3).all(|c| (s.weight[c] - f64::from(white[c])).abs() < 1e-7));
        }
        for (ior, mode) in [(1.5_f32, 0), (0.7, 0), (1.5, 1)] {
            let glass = Lobe { kind: MATERIAL_DIELECTRIC, ior, mode, ..Lobe::default() };
            let all = samples(&glass, wo, 40_000, 2);
            let out = wo.map(f64::from);
            let thin = mode == 1;
            let eta = if out[2] > 0.0 || thin { f64::from(ior) } else { 1.0 / f64::from(ior) };
            let mut reflectance = fresnel::fresnel_dielectric(out[2].abs(), eta);
            if thin {
                reflectance = 2.0 * reflectance / (1.0 + reflectance);
            }
            for s in &all {
                if !s.through {
                    assert!((0..3).all(|c| (s.wi[c] - [-out[0], -out[1], out[2]][c]).abs() < 1e-6));
                    assert!(s.weight == [1.0; 3] && s.pdf == 0.0);
                } else if thin {
                    assert_eq!((s.wi, s.weight), (out.map(|c| -c), [1.0; 3]));
                } else {
                    // Snell: the part along the surface is divided by the index
                    assert!((s.wi[0] + out[0] / eta).abs() < 1e-6 && (s.wi[1] + out[1] / eta).abs() < 1e-6);
                    assert!(s.wi[2] * out[2] < 0.0);
                    assert!((s.weight[0] - 1.0 / (eta * eta)).abs() < 1e-5 && (s.eta - eta).abs() < 1e-6);
                }
            }
            let reflected = all.iter().filter(|s| !s.through).count() as f64 / all.len() as f64;
            let sigma = (reflectance * (1.0 - reflectance) / all.len() as f64).sqrt();
            assert!(
                (reflected - reflectance).abs() <= 4.0 * sigma,
                "{ior} {mode} {wo:?}: {reflected} {reflectance}"
            );
        }
    }
}
