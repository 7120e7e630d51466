//! `shaders/material/principled.glsl`: what every lobe must do, and the materials that the model must be at its ends.

use super::lobe::{
    Lobe, Tables, albedo, bsdf, check_reciprocity, check_samples, directions, over_the_sphere,
};
use crate::common::directions::midpoints;
use dapple::layout::{
    DIELECTRIC_SOLID, DIELECTRIC_THIN, FRESNEL_SCHLICK, MATERIAL_CONDUCTOR, MATERIAL_DIELECTRIC,
    MATERIAL_PRINCIPLED,
};

/// A white dielectric without anything on top.
const PLAIN: Lobe = Lobe {
    name: "plain",
    kind: MATERIAL_PRINCIPLED,
    mode: DIELECTRIC_THIN,
    ior: 1.5,
    numbers: [0.0; 2],
    color: [1.0; 3],
    specular: [1.0; 3],
    k: [0.0; 3],
    alpha: [0.25; 2],
    metallic: 0.0,
    weight: 1.0,
    transmission: 0.0,
    coat: [0.0, 0.1],
    sheen: [0.0; 3],
    sheen_roughness: 0.5,
    interface: Tables::NONE,
};

fn lobes() -> Vec<Lobe> {
    let clear = Lobe { transmission: 1.0, ..PLAIN };
    vec![
        PLAIN,
        Lobe { name: "rough", alpha: [1.0; 2], ..PLAIN },
        Lobe { name: "half metal", metallic: 0.5, color: [0.9, 0.5, 0.1], alpha: [0.2, 0.6], ..PLAIN },
        Lobe { name: "sheet", alpha: [0.3; 2], color: [1.0, 0.5, 0.25], ..clear },
        Lobe { name: "glass", mode: DIELECTRIC_SOLID, alpha: [0.3; 2], ..clear },
        Lobe {
            name: "milk",
            mode: DIELECTRIC_SOLID,
            transmission: 0.5,
            alpha: [0.4; 2],
            weight: 0.5,
            ..clear
        },
        Lobe { name: "coat", coat: [1.0, 0.2], alpha: [0.5; 2], color: [0.8, 0.2, 0.2], ..PLAIN },
        Lobe { name: "cloth", sheen: [1.0, 0.5, 0.0], sheen_roughness: 0.4, weight: 0.0, ..PLAIN },
        Lobe {
            name: "all",
            mode: DIELECTRIC_SOLID,
            metallic: 0.25,
            weight: 0.75,
            specular: [1.0, 2.0, 3.0],
            ior: 1.8,
            transmission: 0.5,
            coat: [0.5, 0.3],
            sheen: [0.5; 3],
            ..PLAIN
        },
    ]
}

#[test]
fn samples_follow_the_density_and_weights_are_its_quotient() {
    check_samples(&lobes());
}

#[test]
fn lobes_are_reciprocal() {
    check_reciprocity(&lobes());
}

#[test]
fn nothing_gains_and_what_is_white_loses_little() {
    let [a, b, _, below] = directions();
    for wo in [a, b, below, [0.0, 0.0, 1.0], [0.992, 0.0, 0.126_238]] {
        for alpha in [0.15, 0.4, 1.0] {
            for (ior, mode, transmission, least) in [
                (1.001, DIELECTRIC_THIN, 0.0, 0.99),
                (1.5, DIELECTRIC_THIN, 0.0, 0.93),
                (2.5, DIELECTRIC_THIN, 0.0, 0.5),
                (1.5, DIELECTRIC_THIN, 1.0, 0.3),
                (1.5, DIELECTRIC_SOLID, 1.0, 0.3),
                (1.5, DIELECTRIC_SOLID, 0.5, 0.25),
            ] {
                for (coat, sheen) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                    let layers = coat + sheen > 0.0;
                    for sheen_roughness in if sheen > 0.0 { &[0.3, 0.6, 1.0][..] } else { &[0.5] } {
                        let alpha = [alpha; 2];
                        let coat = [coat, 0.15];
                        let (sheen, sheen_roughness) = ([sheen; 3], *sheen_roughness);
                        let lobe =
                            Lobe { ior, mode, transmission, alpha, coat, sheen, sheen_roughness, ..PLAIN };
                        let got = albedo(&lobe, wo);
                        let place =
                            format!("{alpha:?} {ior} {mode} {transmission} {coat:?} {sheen:?} {wo:?}");
                        // The sums of a sharp lobe over midpoints, and the bounds of the layers, are off by this much
                        assert!(got <= 1.006, "{place}: {got}");
                        assert!(layers || got >= least, "{place}: {got} is left");
                    }
                }
            }
        }
    }
}

/// The largest difference of two lobes, in parts of the larger value, where it is not small.
fn difference(a: &Lobe, b: &Lobe, wo: [f32; 3]) -> f64 {
    let pairs = over_the_sphere(a, wo).into_iter().zip(over_the_sphere(b, wo));
    let off = |x: f64, y: f64| (x - y).abs() / x.max(y).max(1e-3);
    let each = pairs.map(|(a, b)| (0..3).map(|c| off(a.1[c], b.1[c])).fold(off(a.0, b.0), f64::max));
    each.fold(0.0, f64::max)
}

#[test]
fn the_ends_are_diffuse_metal_and_glass() {
    let color = [0.9, 0.6, 0.3];
    let alpha = [0.3, 0.5];
    let pairs = [
        (
            Lobe { weight: 0.0, alpha: [1.0; 2], color, ..PLAIN },
            Lobe { kind: bsdf("diffuse"), color, ..Lobe::default() },
        ),
        (
            Lobe { metallic: 1.0, alpha, color, ..PLAIN },
            Lobe { kind: MATERIAL_CONDUCTOR, mode: FRESNEL_SCHLICK, alpha, color, ..Lobe::default() },
        ),
        (
            Lobe { mode: DIELECTRIC_SOLID, transmission: 1.0, alpha, ..PLAIN },
            Lobe { kind: MATERIAL_DIELECTRIC, ior: 1.5, alpha, ..Lobe::default() },
        ),
    ];
    for (principled, other) in &pairs {
        for wo in directions() {
            let off = difference(principled, other, wo);
            assert!(off < 2e-3, "kind {} from {wo:?}: {off}", other.kind);
        }
    }
    // The comparison sees what is different
    let rougher = Lobe { alpha: [0.31, 0.5], ..pairs[1].0 };
    assert!(difference(&rougher, &pairs[1].1, directions()[0]) > 2e-3);
}

#[test]
fn a_coat_and_sheen_are_outside_only() {
    let above = directions()[0];
    let below = [above[0], above[1], -above[2]];
    let bare = Lobe { mode: DIELECTRIC_SOLID, transmission: 0.5, color: [0.5; 3], ..PLAIN };
    let dressed = Lobe { coat: [1.0, 0.2], sheen: [0.5; 3], ..bare };
    let reflected = |lobe: &Lobe, wo: [f32; 3]| -> Vec<[f64; 3]> {
        let values = over_the_sphere(lobe, wo).into_iter().zip(midpoints());
        values.filter(|(_, wi)| wi[2] * wo[2] > 0.0).map(|((_, f, _), _)| f).collect()
    };
    assert_eq!(reflected(&bare, below), reflected(&dressed, below));
    assert_ne!(reflected(&bare, above), reflected(&dressed, above));
    // Without an inside, both sides are alike
    let sheet = Lobe { mode: DIELECTRIC_THIN, ..dressed };
    let mut turned = reflected(&sheet, below);
    turned.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut upright = reflected(&sheet, above);
    upright.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let off =
        turned.iter().zip(&upright).map(|(a, b)| (a[0] - b[0]).abs() / (1e-3 + a[0])).fold(0.0, f64::max);
    assert!(off < 1e-3, "{off}");
}
