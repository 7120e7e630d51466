//! `shaders/camera/lens_trace.glsl` against its twin in 64 bits, and back again.

use crate::common::probe::{Probe, Word, as_doubles, floats};
use crate::common::random::Random;
use dapple::layout::{Backend, Frame};
use dapple::prepare::lens::{Glass, LensRay, LensTrace};
use dapple::scene::{LensInterface, LensSystem};
use glam::DVec3;

/// A double Gauss of round numbers, in millimetres, with Abbe numbers.
fn double_gauss() -> LensSystem {
    let row =
        |radius, thickness, index, abbe, aperture| LensInterface { radius, thickness, index, abbe, aperture };
    let interfaces = vec![
        row(30.0, 4.0, 1.67, Some(47.0), 26.0),
        row(85.0, 0.2, 1.0, None, 26.0),
        row(19.0, 4.5, 1.67, Some(47.0), 22.0),
        row(40.0, 3.0, 1.70, Some(30.0), 22.0),
        row(12.7, 5.7, 1.0, None, 17.0),
        row(0.0, 4.5, 1.0, None, 16.0),
        row(-14.5, 1.2, 1.603, Some(38.0), 16.0),
        row(41.0, 6.0, 1.658, Some(57.0), 19.0),
        row(-20.4, 0.2, 1.0, None, 19.0),
        row(400.0, 3.2, 1.717, Some(48.0), 20.0),
        row(-40.0, 0.0, 1.0, None, 20.0),
    ];
    LensSystem { notes: Vec::new(), interfaces }
}

/// Rays from the film through the plane of the last vertex, many of which do not pass.
fn rays(rear: f64) -> Vec<LensRay> {
    let mut random = Random(11);
    let mut pick = |half: f64| (2.0 * f64::from(random.f32()) - 1.0) * half;
    (0..20_000)
        .map(|_| {
            let film = DVec3::new(pick(15.0), pick(15.0), 0.0);
            let pupil = DVec3::new(pick(10.0), pick(10.0), rear);
            LensRay { origin: film, direction: (pupil - film).normalize() }
        })
        .collect()
}

/// What the kernel makes of rays: origin, direction, weight.
fn traced(
    trace: &LensTrace,
    rays: &[LensRay],
    dispersion: bool,
    inverse_square: f64,
) -> Vec<Option<LensRay>> {
    let glsl = format!(
        "#define OPENING_ROUND 0\n#define OPENING_POLYGON 1\n#define OPENING_PICTURE 2\n#define OPENING OPENING_ROUND\n{}
        #include \"shared/bindings.glsl\"
        #define fetch_lens fetch_points
        #include \"camera/lens_trace.glsl\"
        void probe(uint i) {{
            vec4 o = uintBitsToFloat(fetch_points(2u * frame.lens_count + 2u * i));
            vec4 d = uintBitsToFloat(fetch_points(2u * frame.lens_count + 2u * i + 1u));
            LensRay r = lens_trace(o.xyz, d.xyz, d.w);
            store_values(2u * i, floatBitsToUint(vec4(r.origin, r.weight)));
            store_values(2u * i + 1u, floatBitsToUint(vec4(normalize(r.direction), 0.0)));
        }}",
        if dispersion { "#define LENS_DISPERSION 1" } else { "" }
    );
    let records = trace.records();
    let mut inputs: Vec<Word> = Vec::new();
    for record in &records {
        inputs.extend(bytemuck::cast::<_, [Word; 2]>(*record));
    }
    for ray in rays {
        let (o, d) = (ray.origin.as_vec3(), ray.direction.as_vec3());
        inputs.push(floats(o.x, o.y, o.z, 0.0));
        inputs.push(floats(d.x, d.y, d.z, inverse_square as f32));
    }
    let frame = Frame {
        point_count: rays.len() as u32,
        lens_count: records.len() as u32,
        threads: 1,
        ..Frame::default()
    };
    let values = Probe::new().run_with_frame(&glsl, Backend::Storage, &frame, &inputs, 2 * rays.len());
    values
        .chunks(2)
        .map(|words| {
            let ([x, y, z, weight], [dx, dy, dz, _]) = (as_doubles(words[0]), as_doubles(words[1]));
            let ray = LensRay { origin: DVec3::new(x, y, z), direction: DVec3::new(dx, dy, dz) };
            (weight > 0.0).then_some(ray)
        })
        .collect()
}

fn check(system: &LensSystem, dispersion: bool, inverse_square: f64) {
    // About where it is sharp at 1 m
    let film = 39.0;
    let glass = if dispersion { Glass::At(inverse_square) } else { Glass::LineD };
    let trace = LensTrace::new(system, film, None, glass);
    let rays = rays(film);
    let (mut passing, mut differ) = (0, 0);
    for (ray, found) in rays.iter().zip(traced(&trace, &rays, dispersion, inverse_square)) {
        // The kernel was given the numbers in 32 bits
        let given = LensRay { origin: ray.origin, direction: ray.direction.as_vec3().as_dvec3() };
        match (trace.to_scene(given), found) {
            (Some(expected), Some(found)) => {
                passing += 1;
                // Eleven boundaries with rounding errors of some 1e-6 mm each
                assert!(expected.origin.distance(found.origin) < 1e-4, "{expected:?} {found:?}");
                assert!(expected.direction.distance(found.direction) < 1e-5, "{expected:?} {found:?}");
                // The way back leads to the same point of the film
                let back =
                    LensRay { origin: found.origin + 5.0 * found.direction, direction: -found.direction };
                if let Some(back) = trace.to_film(back) {
                    let at_film = back.origin - back.direction * (back.origin.z / back.direction.z);
                    assert!(at_film.distance(ray.origin) < 2e-3, "{at_film} {}", ray.origin);
                } else {
                    differ += 1;
                }
            }
            (None, None) => {}
            _ => differ += 1,
        }
    }
    // At the very edge of an aperture one of them may just pass
    assert!(passing > 2000 && differ < 20, "{passing} pass, {differ} differ");
}

#[test]
fn rays_through_a_lens_are_their_twins_and_go_back() {
    check(&double_gauss(), false, 0.0);
}

#[test]
fn each_colour_has_its_own_way() {
    let system = double_gauss();
    for inverse_square in dapple::prepare::lens::INVERSE_SQUARES {
        check(&system, true, inverse_square);
    }
}

#[test]
fn every_ray_of_the_twin_can_be_reversed() {
    let system = double_gauss();
    let trace = LensTrace::new(&system, 40.0, None, Glass::LineD);
    let mut passing = 0;
    for ray in rays(40.0) {
        let Some(out) = trace.to_scene(ray) else { continue };
        passing += 1;
        let start = LensRay { origin: out.origin + 7.0 * out.direction, direction: -out.direction };
        // A ray that touches a rim may fail by a rounding error: none of these does
        let back = trace.to_film(start).unwrap();
        let at_film = back.origin - back.direction * (back.origin.z / back.direction.z);
        assert!(at_film.distance(ray.origin) < 1e-10 && back.direction.distance(-ray.direction) < 1e-12);
    }
    assert!(passing > 2000, "{passing}");
}
