//! `shaders/material/coated_…`: coats over diffuse bases and over metal, against their series.

use super::lobe::{Lobe, Tables, albedo, check_reciprocity, check_samples, directions, samples};
use crate::common::random::Random;
use crate::common::render::{Build, grey, scene};
use crate::common::twins::fresnel::{fresnel_conductor, fresnel_dielectric};
use dapple::layout::{
    FRESNEL_INDEX, FRESNEL_NONE, INPUT_INTERFACE, MATERIAL_COATED_CONDUCTOR, MATERIAL_COATED_DIFFUSE,
    MATERIAL_DIELECTRIC, MATERIAL_WORDS,
};
use dapple::prepare::prepare;
use dapple::scene::{CoatedConductor, Conductor, Fresnel, Interface, Roughness, Surface};
use glam::{DVec3, dvec3};
use std::f64::consts::PI;

/// The tables of an index, as a scene with one rough material has them.
#[allow(clippy::unwrap_used, reason = "a helper of tests fails the test that called it")]
fn tables(ior: f32) -> Tables {
    let mut s = scene(4, 4, 1);
    let roughness = Roughness::alpha(0.5);
    let conductor = Conductor { reflectance: grey(1.0), fresnel: Fresnel::None, roughness };
    let coated = CoatedConductor { conductor, interface: Interface { ior, roughness } };
    s.material(Surface::CoatedConductor(Box::new(coated)), None);
    let prepared = prepare(&s).unwrap();
    let mut record: dapple::layout::InterfaceInput =
        bytemuck::cast(prepared.materials[0].inputs[INPUT_INTERFACE as usize - 1]);
    record.through_table -= MATERIAL_WORDS;
    record.inner_table -= MATERIAL_WORDS;
    Tables { record, words: Box::leak(prepared.interfaces.into_boxed_slice()) }
}

fn diffuse(interface: Tables, ior: f32, color: f32, alpha: f32) -> Lobe {
    let (kind, coat) = (MATERIAL_COATED_DIFFUSE, [0.0, alpha]);
    Lobe { name: "coated diffuse", kind, ior, interface, color: [color; 3], coat, ..Lobe::default() }
}

fn metal(interface: Tables, ior: f32, color: f32, alpha: f32, coat: f32) -> Lobe {
    let (kind, mode) = (MATERIAL_COATED_CONDUCTOR, FRESNEL_NONE);
    let (color, alpha, coat) = ([color; 3], [alpha; 2], [0.0, coat]);
    Lobe { name: "coated metal", kind, mode, ior, interface, color, alpha, coat, ..Lobe::default() }
}

#[test]
fn samples_of_coats_follow_the_density_and_go_both_ways() {
    let interface = tables(1.5);
    let rough = metal(interface, 1.5, 0.8, 0.3, 0.2);
    let indexed = Lobe { mode: FRESNEL_INDEX, specular: [0.2, 0.4, 1.4], k: [3.9, 2.4, 1.6], ..rough };
    let lobes = [
        diffuse(interface, 1.5, 0.7, 0.3),
        diffuse(interface, 1.5, 1.0, 0.8),
        rough,
        Lobe { alpha: [0.2, 0.6], ..indexed },
        metal(interface, 1.5, 1.0, 0.9, 0.6),
    ];
    check_samples(&lobes);
    check_reciprocity(&lobes);
    check_reciprocity(&[diffuse(interface, 1.5, 0.7, 0.0), metal(interface, 1.5, 0.8, 0.3, 0.0)]);
}

/// What is scattered in all, of a lobe beside a mirror too.
fn furnace(lobe: &Lobe, wo: [f32; 3]) -> f64 {
    const COUNT: usize = 20_000;
    samples(lobe, wo, COUNT, 7).iter().map(|s| s.weight[0]).sum::<f64>() / COUNT as f64
}

#[test]
fn a_smooth_coat_over_a_diffuse_base_is_its_series() {
    for ior in [1.0_f32, 1.2, 1.5, 2.5] {
        let interface = tables(ior);
        let mean = f64::from(interface.record.through_mean);
        for wo in directions() {
            let through = 1.0 - fresnel_dielectric(f64::from(wo[2].abs()), f64::from(ior));
            for color in [0.0_f32, 0.5, 1.0] {
                let lobe = diffuse(interface, ior, color, 0.0);
                // In, then again and again: scattered, of which a part goes out and the rest comes back
                let (out, mut left, mut seen) = (mean / f64::from(ior).powi(2), through, 0.0);
                for _ in 0..2000 {
                    left *= f64::from(color);
                    seen += left * out;
                    left *= 1.0 - out;
                }
                let got = albedo(&lobe, wo);
                assert!((got - seen).abs() < 1e-3, "{ior} {color} {wo:?}: {got} not {seen}");
                let all = furnace(&lobe, wo);
                let expected = seen + 1.0 - through;
                assert!((all - expected).abs() < 2e-2, "{ior} {color} {wo:?}: {all} not {expected}");
            }
        }
    }
}

#[test]
fn a_smooth_coat_over_a_mirror_is_exact() {
    let interface = tables(1.5);
    let (eta, k) = (0.2_f32, 3.9_f32);
    let white = metal(interface, 1.5, 1.0, 0.0, 0.0);
    let indexed = Lobe { mode: FRESNEL_INDEX, specular: [eta; 3], k: [k; 3], ..white };
    for wo in directions() {
        let cos = f64::from(wo[2].abs());
        let below = (1.0 - (1.0 - cos * cos) / 2.25_f64).sqrt();
        let f = fresnel_dielectric(cos, 1.5);
        for (lobe, r) in [(white, 1.0), (indexed, fresnel_conductor(below, eta.into(), k.into()))] {
            let expected = f + (1.0 - f).powi(2) * r / (1.0 - r * f);
            for s in samples(&lobe, wo, 10, 3) {
                let wi = [-wo[0], -wo[1], wo[2]].map(f64::from);
                assert!((0..3).all(|i| (s.wi[i] - wi[i]).abs() < 1e-6) && s.pdf == 0.0);
                assert!((s.weight[0] - expected).abs() < 1e-4, "{wo:?}: {} not {expected}", s.weight[0]);
            }
        }
    }
}

#[test]
fn a_rough_interface_lets_through_what_glass_does() {
    let interface = tables(1.5);
    for alpha in [0.1, 0.3, 0.7, 1.0] {
        for wo in [directions()[0], directions()[1], directions()[2]] {
            let glass = Lobe { kind: MATERIAL_DIELECTRIC, ior: 1.5, alpha: [alpha; 2], ..Lobe::default() };
            let reflected = albedo(&diffuse(interface, 1.5, 0.0, alpha), wo);
            let through = albedo(&glass, wo) - reflected;
            // White bases send back all that comes in
            let got = albedo(&diffuse(interface, 1.5, 1.0, alpha), wo) - reflected;
            assert!((got - through).abs() < 6e-3, "{alpha} {wo:?}: {got} not {through}");
        }
    }
}

/// What a walk sends out between a smooth interface and white GGX metal, in all.
fn walk(wo: [f32; 3], ior: f64, alpha: f64, random: &mut Random) -> f64 {
    let lambda = |w: DVec3| 0.5 * ((1.0 + alpha * alpha * (1.0 / (w.z * w.z) - 1.0)).sqrt() - 1.0);
    let through = 1.0 - fresnel_dielectric(f64::from(wo[2]), ior);
    let across = f64::from(wo[0]) / ior;
    let mut w = dvec3(across, 0.0, (1.0 - across * across).sqrt());
    let (mut weight, mut seen) = (through, 0.0);
    for _ in 0..200 {
        let v = dvec3(alpha * w.x, alpha * w.y, w.z).normalize();
        // The visible normals are those of a spherical cap (Dupuy and Benyoub 2023)
        let phi = 2.0 * PI * f64::from(random.f32());
        let z = 1.0 - f64::from(random.f32()) * (1.0 + v.z);
        let sin = (1.0 - z * z).max(0.0).sqrt();
        let h = dvec3(sin * phi.cos(), sin * phi.sin(), z) + v;
        let m = dvec3(alpha * h.x, alpha * h.y, h.z).normalize();
        let up = m * (2.0 * w.dot(m)) - w;
        if up.z <= 0.0 {
            break;
        }
        weight *= (1.0 + lambda(w)) / (1.0 + lambda(w) + lambda(up));
        let returned = fresnel_dielectric(up.z, 1.0 / ior);
        seen += weight * (1.0 - returned);
        weight *= returned;
        // The interface turns it back down: it meets the metal as from the direction that mirrors it
        w = dvec3(-up.x, -up.y, up.z);
    }
    seen
}

#[test]
fn rough_metal_under_a_coat_sends_out_what_a_walk_does() {
    const COUNT: u32 = 40_000;
    let (interface, mut random) = (tables(1.5), Random(3));
    for wo in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.954, 0.0, 0.3]] {
        for alpha in [0.1_f32, 0.3, 0.6, 1.0] {
            let mean = (0..COUNT).map(|_| walk(wo, 1.5, alpha.into(), &mut random)).sum::<f64>();
            let expected = mean / f64::from(COUNT);
            let got = albedo(&metal(interface, 1.5, 1.0, alpha, 0.0), wo);
            assert!((got - expected).abs() < 1e-2, "{wo:?} {alpha}: {got} not {expected}");
        }
    }
}

#[test]
fn coats_make_no_energy() {
    for ior in [1.2_f32, 1.5, 2.0] {
        let interface = tables(ior);
        for wo in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.8, 0.0, 0.6], [0.954, 0.0, 0.3], [0.995, 0.0, 0.1]] {
            for alpha in [0.1, 0.3, 0.6, 1.0] {
                for coat in [0.0, 0.1, 0.3, 0.6, 1.0] {
                    let mirror = 1.0 - fresnel_dielectric(f64::from(wo[2]), f64::from(ior));
                    let beside = if coat == 0.0 { 1.0 - mirror } else { 0.0 };
                    let got = albedo(&metal(interface, ior, 1.0, alpha, coat), wo) + beside;
                    assert!(got < 1.005, "{ior} {wo:?} metal {alpha} coat {coat}: {got}");
                }
            }
        }
    }
}
