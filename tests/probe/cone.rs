//! `shaders/base/cone.glsl`: cones of rays through mirrors and glass whose foci are known.

use crate::common::probe::{Probe, Word, as_doubles, floats, vector};
use glam::DVec3;

/// What a kernel gives for the numbers in `a` and `b`.
fn asked(value: &str, inputs: &[Word]) -> Vec<[f64; 4]> {
    let glsl = format!(
        "#include \"base/cone.glsl\"
        #include \"shared/bindings.glsl\"
        vec4 value(vec4 a, vec4 b)
        {{
            {value}
        }}
        void probe(uint i) {{
            store_values(i, floatBitsToUint(value(uintBitsToFloat(fetch_points(2u * i)), uintBitsToFloat(fetch_points(2u * i + 1u)))));
        }}"
    );
    let count = inputs.len() / 2;
    Probe::new().both(&glsl, inputs, count, count).into_iter().map(as_doubles).collect()
}

#[track_caller]
fn expect(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-5 * expected.abs().max(1e-3), "{found}, expected {expected}");
}

#[test]
fn a_cone_opens_again_behind_its_focus() {
    let value = "Cone c = cone_after(Cone(a.x, a.y), a.z); return vec4(c.width, c.spread, 0.0, 0.0);";
    for (width, spread, way, expected) in [
        (1.0, 0.5, 2.0, [2.0, 0.5]),
        (1.0, -0.5, 1.0, [0.5, -0.5]),
        (1.0, -0.5, 2.0, [0.0, -0.5]),
        (1.0, -0.5, 6.0, [2.0, 0.5]),
    ] {
        let found = asked(value, &[floats(width, spread, way, 0.0), floats(0.0, 0.0, 0.0, 0.0)])[0];
        expected.iter().zip(found).for_each(|(expected, found)| expect(found, *expected));
    }
}

#[test]
fn a_parallel_cone_leaves_a_mirror_sphere_by_twice_its_width_over_the_radius() {
    let value = "Cone c = cone_reflected(Cone(a.x, a.y), a.z); return vec4(c.width, c.spread, 0.0, 0.0);";
    for (width, spread, radius) in
        [(0.01_f32, 0.0_f32, 2.0_f32), (0.3, 0.0, 0.5), (0.01, 0.1, 4.0), (0.01, 0.0, -3.0)]
    {
        let found =
            asked(value, &[floats(width, spread, radius.recip(), 0.0), floats(0.0, 0.0, 0.0, 0.0)])[0];
        let [w, s, r] = [width, spread, radius].map(f64::from);
        expect(found[0], w);
        expect(found[1], s + 2.0 * w / r);
    }
}

#[test]
fn glass_bends_a_cone_as_rays_beside_one_another() {
    // Rays in the plane of incidence and across it, a little way from one another, by Snell's law in 64 bits
    let value = "Cone c = cone_refracted(Cone(a.x, a.y), a.z, a.w, b.x, b.y); return vec4(c.width, c.spread, 0.0, 0.0);";
    for (eta, sine, curvature, spread) in [
        (1.5, 0.0, 1.0, 0.0),
        (1.5, 0.0, 1.0, 0.3),
        (1.0 / 1.5, 0.0, -1.0, -0.2),
        (1.5, 0.6, 0.0, 0.2),
        (1.33, 0.7, 0.5, 0.0),
    ] {
        let cos_i = f64::sqrt(1.0 - sine * sine);
        let cos_t = f64::sqrt(1.0 - sine * sine / (eta * eta));
        let step = 1e-6;
        // The ray through the origin, and one a step beside it, whose direction is turned by `spread` steps
        let refracted = |beside: DVec3| {
            let direction = DVec3::new(sine, 0.0, -cos_i);
            let across = beside - direction * beside.dot(direction);
            // To the surface z = −k (x² + y²) / 2, whose normal is (k x, k y, 1)
            let way = beside.z / cos_i;
            let at = beside + direction * way;
            let normal = DVec3::new(curvature * at.x, curvature * at.y, 1.0).normalize();
            let turned = (direction + spread * across).normalize();
            let cos = -turned.dot(normal);
            let cos_out = (1.0 - (1.0 - cos * cos) / (eta * eta)).sqrt();
            (at, turned / eta + (cos / eta - cos_out) * normal)
        };
        let (_, middle) = refracted(DVec3::ZERO);
        let changes = [DVec3::new(cos_i, 0.0, sine), DVec3::Y].map(|axis| {
            let (at, direction) = refracted(axis * step);
            let side = if axis.y > 0.0 { DVec3::Y } else { DVec3::new(-middle.z, 0.0, middle.x) };
            [at.dot(side) / step, (direction - middle).dot(side) / step]
        });
        let width = 0.01_f32;
        let input = [
            floats(width, spread as f32 * width, curvature as f32, eta as f32),
            floats(cos_i as f32, cos_t as f32, 0.0, 0.0),
        ];
        let found = asked(value, &input)[0].map(|x| x / f64::from(width));
        // Each of the two terms is a geometric mean of what it is in the plane and across it
        let mean = |i: usize| (changes[0][i] * changes[1][i]).sqrt() * changes[1][i].signum();
        assert!((found[0] - mean(0)).abs() < 1e-4, "{found:?}, expected {changes:?}");
        assert!((found[1] - mean(1)).abs() < 1e-4, "{found:?}, expected {changes:?}");
    }
}

#[test]
fn curvature_is_that_of_spheres_cylinders_and_planes_in_any_parameters() {
    let radius = 2.0_f32;
    let value = "vec3 n = a.xyz; vec3 u = b.xyz;
        vec3 v = cross(n, u) + 0.7 * u;
        vec3 pole = vec3(0.0);
        float sphere = mean_curvature(u, v, u / 2.0, v / 2.0);
        vec3 axis = normalize(cross(n, vec3(0.3, 0.1, 0.9)));
        float cylinder = mean_curvature(u, v, (u - axis * dot(axis, u)) / 2.0, (v - axis * dot(axis, v)) / 2.0);
        return vec4(sphere, cylinder, mean_curvature(u, v, vec3(0.0), vec3(0.0)), mean_curvature(pole, v, pole, v / 2.0));";
    for (normal, along) in
        [(DVec3::Z, DVec3::X * 1e-6), (DVec3::Y, DVec3::new(3e5, 0.0, 1e5)), (DVec3::X, DVec3::Y)]
    {
        let [n, u] = [normal, along].map(|v| vector(v.as_vec3().to_array()));
        let [sphere, cylinder, plane, pole] = asked(value, &[n, u])[0];
        expect(sphere, 1.0 / f64::from(radius));
        expect(cylinder, 0.5 / f64::from(radius));
        assert_eq!(plane, 0.0);
        expect(pole, 1.0 / f64::from(radius));
    }
}
