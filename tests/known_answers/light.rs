//! Light: how much arrives, from what.

use crate::common::render::*;
use dapple::scene::*;
use glam::{Affine3A, DVec3, Mat3, Vec3};
use std::f64::consts::PI;

/// Where the camera of `floor_scene` stands; it looks at the origin.
const EYE: Vec3 = Vec3::new(3.0, 2.0, 1.0);

/// A floor that a narrow camera looks at: all pixels see one point, the origin. One scattering event.
fn floor_scene(surface: Surface, spp: u32) -> Scene {
    let mut s = scene(8, 8, spp);
    s.camera = look(EYE, Vec3::ZERO, 0.02);
    s.render.max_depth = 1;
    let material = s.material(surface, None);
    s.floor(material);
    s
}

fn white() -> Surface {
    Surface::Diffuse { color: grey(1.0) }
}

/// Irradiance at the origin, facing +y, of a polygon of radiance 1 that is wholly above the horizon (Lambert 1760): half the
/// sum over edges of the angle that each fills times the cosine of its plane.
fn polygon_irradiance(corners: &[DVec3]) -> f64 {
    let edge = |a: DVec3, b: DVec3| {
        let (a, b) = (a.normalize(), b.normalize());
        a.dot(b).clamp(-1.0, 1.0).acos() * a.cross(b).normalize_or_zero().y
    };
    let n = corners.len();
    0.5 * (0..n).map(|i| edge(corners[i], corners[(i + 1) % n])).sum::<f64>().abs()
}

fn quad_corners(origin: Vec3, u: Vec3, v: Vec3) -> [DVec3; 4] {
    [origin, origin + u, origin + u + v, origin + v].map(|p| p.as_dvec3())
}

/// Radiance that leaves the origin of a floor towards the camera under a rectangle of radiance `light(u, v)`, by quadrature.
/// `bsdf(wo, wi)` is in a frame with y up.
fn under_quad(
    origin: Vec3,
    u: Vec3,
    v: Vec3,
    light: impl Fn(f64, f64) -> f64,
    bsdf: impl Fn(DVec3, DVec3) -> f64,
) -> f64 {
    let (o, u, v) = (origin.as_dvec3(), u.as_dvec3(), v.as_dvec3());
    let (normal, wo) = (u.cross(v), EYE.as_dvec3().normalize());
    integrate_square(600, |a, b| {
        let p = o + u * a + v * b;
        let wi = p.normalize();
        light(a, b) * bsdf(wo, wi) * wi.y.max(0.0) * wi.dot(normal).abs() / p.length_squared()
    })
}

/// Modified Phong about +y.
fn phong(kd: f64, ks: f64, n: f64) -> impl Fn(DVec3, DVec3) -> f64 {
    move |wo, wi| {
        let mirrored = DVec3::new(-wo.x, wo.y, -wo.z);
        let cos = mirrored.dot(wi);
        kd / PI + if cos > 0.0 { ks * (n + 2.0) / (2.0 * PI) * cos.powf(n) } else { 0.0 }
    }
}

/// Isotropic GGX about +y with height-correlated Smith masking, reflectance 1.
fn ggx(alpha: f64) -> impl Fn(DVec3, DVec3) -> f64 {
    move |wo, wi| {
        let m = (wo + wi).normalize();
        let a2 = alpha * alpha;
        let lambda = |w: DVec3| 0.5 * ((1.0 + a2 * (1.0 / (w.y * w.y) - 1.0)).sqrt() - 1.0);
        let t = m.y * m.y * (a2 - 1.0) + 1.0;
        a2 / (PI * t * t) / (1.0 + lambda(wo) + lambda(wi)) / (4.0 * wo.y * wi.y)
    }
}

/// Part of the light from everywhere that a surface sends towards `wo`.
fn albedo(wo: DVec3, bsdf: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    // Directions at equal steps of elevation and angle, fine enough for lobes of a few degrees
    2.0 * PI
        * integrate_square(1500, |a, b| {
            let (elevation, phi) = (0.5 * PI * a, 2.0 * PI * b);
            let (y, r) = (elevation.sin(), elevation.cos());
            bsdf(wo, DVec3::new(r * phi.cos(), y, r * phi.sin())) * y * r * 0.5 * PI
        })
}

fn rough(alpha: f32) -> Surface {
    conductor(1.0, alpha, Fresnel::None)
}

fn shiny(kd: f32, ks: f32, n: f32) -> Surface {
    Surface::Phong { diffuse: grey(kd), specular: grey(ks), exponent: Value::Constant(n) }
}

/// Light that is seen after at most `depth` events in a closed room of emission 1 and reflectance rho.
fn furnace(rho: f64, depth: u32) -> f64 {
    (1.0 - rho.powi(depth as i32 + 1)) / (1.0 - rho)
}

fn glowing(surface: Surface) -> Material {
    Material { surface, emission: Some(Emission { radiance: grey(1.0), two_sided: true }) }
}

#[test]
fn furnace_of_a_diffuse_box() {
    for (rho, depth, roulette) in [(0.5, 3, false), (0.5, 40, true), (0.8, 60, true)] {
        let mut s = scene(8, 8, 256);
        (s.render.max_depth, s.render.russian_roulette) = (depth, roulette);
        let m = s.materials.add("glow", glowing(Surface::Diffuse { color: grey(rho) }));
        let mesh = s.meshes.add("box", box_mesh(Vec3::new(-1.0, -0.7, -2.0), Vec3::new(1.5, 0.9, 1.0), true));
        s.place(mesh, m, Affine3A::IDENTITY);
        expect_grey(mean(&render(&s)), furnace(f64::from(rho), depth), 0.0);
    }
}

#[test]
fn furnace_of_a_diffuse_sphere_seen_from_inside() {
    let mut s = scene(8, 8, 256);
    s.render.max_depth = 30;
    let m = s.materials.add("glow", glowing(Surface::Diffuse { color: grey(0.5) }));
    s.sphere(Vec3::new(0.2, 0.1, 0.3), 2.0, m);
    expect_grey(mean(&render(&s)), furnace(0.5, 30), 0.0);
}

#[test]
fn furnace_of_a_mirror_box_is_exact() {
    let mut s = scene(16, 16, 4);
    (s.render.max_depth, s.render.russian_roulette) = (7, false);
    let m = s.materials.add("glow", glowing(conductor(0.5, 0.0, Fresnel::None)));
    let mesh = s.meshes.add("box", box_mesh(Vec3::new(-1.0, -0.7, -2.0), Vec3::new(1.5, 0.9, 1.0), true));
    s.place(mesh, m, Affine3A::IDENTITY);
    // Sums of halves: floats hold them exactly
    expect_every_pixel(&render(&s), [furnace(0.5, 7); 3], 1e-6);
}

#[test]
fn constant_environment_shows_the_albedo_of_a_sphere_and_itself() {
    let mut s = scene(16, 16, 256);
    s.environment = constant_environment(1.0);
    let m = s.diffuse(0.6);
    s.sphere(Vec3::new(0.0, 0.0, -4.0), 2.0, m);
    let p = render(&s);
    let (sky, ball): (Vec<usize>, Vec<usize>) =
        (0..256).filter(|&i| p.alpha[i] == 0.0 || p.alpha[i] == 1.0).partition(|&i| p.alpha[i] == 0.0);
    assert!(sky.len() > 50 && ball.len() > 30, "{} {}", sky.len(), ball.len());
    assert!(sky.iter().all(|&i| p.rgb[i] == [1.0; 3] && p.depth[i] == f32::INFINITY));
    expect_grey(mean_of(&p, ball), 0.6, 0.0);
}

#[test]
fn phong_and_rough_metal_lose_what_their_lobes_lose() {
    let wo = EYE.as_dvec3().normalize();
    let cases: [(Surface, f64); 5] = [
        (shiny(0.5, 0.5, 0.0), albedo(wo, phong(0.5, 0.5, 0.0))),
        (shiny(0.3, 0.7, 20.0), albedo(wo, phong(0.3, 0.7, 20.0))),
        // Above 1 both are scaled down together
        (shiny(0.9, 0.9, 5.0), albedo(wo, phong(0.5, 0.5, 5.0))),
        (rough(0.2), albedo(wo, ggx(0.2))),
        (rough(0.8), albedo(wo, ggx(0.8))),
    ];
    for (surface, expected) in cases {
        assert!(expected > 0.5 && expected < 1.0, "{expected}");
        let mut s = floor_scene(surface, 1024);
        s.environment = constant_environment(1.0);
        // The quadrature is good to 1e-4
        expect_grey(mean(&render(&s)), expected, 1e-4);
    }
}

#[test]
fn sphere_light_irradiance() {
    // E = π L (r/d)² cos θ where the whole sphere is above the horizon
    for (center, radius) in [
        (Vec3::new(0.0, 2.0, 0.0), 1.0),
        (Vec3::new(0.0, 1.05, 0.0), 1.0),
        (Vec3::new(-1.0, 3.0, 2.0), 0.7),
        (Vec3::new(-1.0, 3.0, 2.0), 0.01),
        (Vec3::new(0.0, 300.0, 0.0), 2.0),
    ] {
        let mut s = floor_scene(white(), 1024);
        // Below the spheres
        s.camera.position = Vec3::new(0.3, 0.03, 0.2);
        let light = s.emitter(grey(3.0), false);
        s.sphere(center, radius, light);
        let d = center.as_dvec3();
        let irradiance = PI * 3.0 * f64::from(radius).powi(2) / d.length_squared() * d.normalize().y;
        expect_grey(mean(&render(&s)), irradiance / PI, 1e-4);
    }
}

#[test]
fn disk_light_on_its_axis() {
    for (radius, height) in [(1.0, 1.5), (3.0, 0.5), (0.05, 2.0)] {
        let mut s = floor_scene(white(), 1024);
        let light = s.emitter(grey(2.0), false);
        s.disk(Vec3::new(0.0, height, 0.0), Vec3::NEG_Y, radius, light);
        // E = π L r² / (r² + h²). The camera must not be under the disk's shadow of itself
        let (r, h) = (f64::from(radius), f64::from(height));
        s.camera = look(Vec3::new(0.4, 0.3, 0.2), Vec3::ZERO, 0.02);
        expect_grey(mean(&render(&s)), 2.0 * r * r / (r * r + h * h), 1e-4);
    }
}

/// Rectangles and a parallelogram above the origin, all facing down.
const QUADS: [(Vec3, Vec3, Vec3); 7] = [
    (Vec3::new(-1.0, 2.0, -1.0), Vec3::new(1.5, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.5)),
    (Vec3::new(-4.0, 0.5, -5.0), Vec3::new(6.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 9.0)),
    // From far below to far above the solid angle at which the sampling changes
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.01, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.02)),
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.02, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.04)),
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.07, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.07)),
    (Vec3::new(0.3, 2.0, 0.1), Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.2)),
    (Vec3::new(-1.0, 1.5, -1.0), Vec3::new(1.5, 0.5, 0.3), Vec3::new(0.4, 0.2, 2.0)),
];

#[test]
fn quad_light_irradiance() {
    for (i, (origin, u, v)) in QUADS.into_iter().enumerate() {
        let mut s = floor_scene(white(), 1024);
        s.camera = look(Vec3::new(0.3, 0.2, 0.1), Vec3::ZERO, 0.02);
        let light = s.emitter(grey(2.0), false);
        s.quad(origin, u, v, light);
        let expected = 2.0 * polygon_irradiance(&quad_corners(origin, u, v)) / PI;
        eprintln!("quad {i}: {expected}");
        expect_grey(mean(&render(&s)), expected, 1e-4);
    }
}

#[test]
fn lights_without_extent() {
    let at = Vec3::new(1.0, 2.0, -0.5);
    let (d2, cos) = (f64::from(at.length_squared()), f64::from(at.normalize().y));
    let with = |light: Light| {
        let mut s = floor_scene(white(), 4);
        s.lights.push(light);
        mean(&render(&s))
    };
    expect_grey(with(point(at, 5.0)), 5.0 / d2 * cos / PI, 1e-4);
    // Irradiance on a surface that faces the light
    let distant = Light::Distant { direction: -at.normalize(), irradiance: Vec3::splat(4.0) };
    expect_grey(with(distant), 4.0 * cos / PI, 1e-4);
    // Smoothstep in the cosine between the cone and the cone less its soft edge
    for turn in [0.0_f32, 12.0, 17.0, 24.0, 29.0] {
        let away = glam::Quat::from_axis_angle(at.normalize().any_orthonormal_vector(), turn.to_radians());
        let direction = away * -at.normalize();
        let spot = Light::Spot {
            position: at,
            direction,
            intensity: Vec3::splat(5.0),
            cone_angle: 30.0,
            falloff_angle: 15.0,
        };
        let (outer, inner) = (30_f64.to_radians().cos(), 15_f64.to_radians().cos());
        let t = ((f64::from(turn).to_radians().cos() - outer) / (inner - outer)).clamp(0.0, 1.0);
        // Near the edge of the cone the rounding of the cosine counts: t is a difference of two of them
        expect_grey(with(spot), 5.0 / d2 * cos / PI * t * t * (3.0 - 2.0 * t), 2e-4);
    }
    let direction = Vec3::new(1.0, 2.0, -0.4).normalize();
    let behind =
        Light::Spot { position: at, direction, intensity: Vec3::ONE, cone_angle: 30.0, falloff_angle: 15.0 };
    assert_eq!(with(behind).mean, [0.0; 3]);
}

#[test]
fn penumbra_behind_a_straight_edge() {
    // Light at height 4, 1 wide; edge at height 2: the penumbra is 1 · 2 / (4 − 2) = 1 wide
    let (origin, u, v) = (Vec3::new(-0.5, 4.0, -0.5), Vec3::X, Vec3::Z);
    let mut s = scene(24, 1, 4096);
    s.render.max_depth = 1;
    s.camera = look(Vec3::new(0.0, 1.0, 0.001), Vec3::ZERO, 4.0);
    s.camera.up = Vec3::NEG_Z;
    let white = s.material(white(), None);
    s.floor(white);
    let light = s.emitter(grey(1.0), false);
    s.quad(origin, u, v, light);
    let black = s.black();
    s.quad(Vec3::new(-50.0, 2.0, -50.0), Vec3::X * 50.0, Vec3::Z * 100.0, black);
    let p = render(&s);
    // Irradiance at x: of the part of the light that the edge leaves, x_light > −x
    let at = |x: f64, z: f64| {
        let left = (-x).clamp(-0.5, 0.5);
        let corners = [(left, -0.5), (0.5, -0.5), (0.5, 0.5), (left, 0.5)];
        if left >= 0.5 {
            0.0
        } else {
            polygon_irradiance(&corners.map(|(a, b)| DVec3::new(a - x, 4.0, b - z)))
        }
    };
    let full_light = at(0.5, 0.0) / PI;
    let (mut dark, mut half, mut full) = (0, 0, 0);
    for px in 0..24 {
        let center = center_ray(&s, px, 0);
        let width = center_ray(&s, 1, 0).1.x / -center_ray(&s, 1, 0).1.y
            - center_ray(&s, 0, 0).1.x / -center_ray(&s, 0, 0).1.y;
        let x = center.0.x + center.1.x / -center.1.y;
        let expected = integrate_square(64, |a, b| at(x + (a - 0.5) * width, (b - 0.5) * width)) / PI;
        let measured = mean_of(&p, [px as usize]);
        if x + width < -0.5 {
            assert_eq!(measured.mean, [0.0; 3]);
            dark += 1;
        } else if x - width > -0.45 {
            // Relative to full light: where hardly any arrives, the part that does is all noise
            let off = (measured.mean[1] - expected).abs();
            assert!(
                off <= SIGMAS * measured.error[1] + 2e-3 * full_light,
                "{x}: {measured:?}, expected {expected}"
            );
            assert!(SIGMAS * measured.error[1] < 0.05 * full_light, "too noisy");
            if x > 0.5 { full += 1 } else { half += 1 }
        }
    }
    assert!(dark >= 2 && half >= 5 && full >= 2, "{dark} {half} {full}");
}

/// Surfaces with the value of their BSDF.
#[allow(clippy::type_complexity, reason = "a table of two columns")]
fn surfaces() -> [(Surface, Box<dyn Fn(DVec3, DVec3) -> f64>); 4] {
    [
        (Surface::Diffuse { color: grey(0.7) }, Box::new(|_, _| 0.7 / PI)),
        (shiny(0.3, 0.6, 30.0), Box::new(phong(0.3, 0.6, 30.0))),
        (rough(0.25), Box::new(ggx(0.25))),
        (rough(0.6), Box::new(ggx(0.6))),
    ]
}

#[test]
fn area_lights_weigh_both_strategies_right() {
    // Small, and so large that the lobe of the surface finds it more often
    let lights = [
        (Vec3::new(-2.0, 1.2, -1.0), Vec3::X * 0.3, Vec3::Z * 0.3),
        (Vec3::new(-6.0, 1.5, -4.0), Vec3::X * 7.0, Vec3::Z * 6.0),
    ];
    for (origin, u, v) in lights {
        for (i, (surface, bsdf)) in surfaces().into_iter().enumerate() {
            let expected = under_quad(origin, u, v, |_, _| 2.0, bsdf);
            for as_mesh in [false, true] {
                let mut s = floor_scene(surface.clone(), 1024);
                s.camera.position = EYE.normalize() * 1.0;
                let light = s.emitter(grey(2.0), false);
                if as_mesh {
                    let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
                    s.place(mesh, light, Affine3A::IDENTITY);
                } else {
                    s.quad(origin, u, v, light);
                }
                eprintln!("surface {i}, mesh {as_mesh}: {expected}");
                expect_grey(mean(&render(&s)), expected, 1e-3);
            }
        }
    }
}

/// 2 × 2 texels, top row first: dark and bright, so that a turned picture shows.
fn four() -> Image {
    let texel = |x: f32| [x, x, x, 1.0];
    Image {
        width: 2,
        height: 2,
        texels: Texels::RgbaF32(vec![texel(1.0), texel(6.0), texel(2.5), texel(0.0)]),
    }
}

/// Its value at uv.
fn four_at(u: f64, v: f64) -> f64 {
    match (u < 0.5, v < 0.5) {
        (true, false) => 1.0,
        (false, false) => 6.0,
        (true, true) => 2.5,
        (false, true) => 0.0,
    }
}

fn textured_light(s: &mut Scene) -> dapple::scene::Handle<Material> {
    let texture = s.picture(four(), |t| t.filter = TexelFilter::Nearest);
    s.emitter(Value::Texture(texture), false)
}

#[test]
fn textured_emission_of_quads_and_meshes() {
    let (origin, u, v) = (Vec3::new(-1.6, 1.0, -0.8), Vec3::X * 2.0, Vec3::Z * 2.4);
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    for (i, (surface, bsdf)) in surfaces().into_iter().enumerate() {
        let expected = under_quad(origin, u, v, four_at, &bsdf);
        // The mirrored rectangle has the mirrored picture; its front still faces down
        let flip = |p: Vec3| mirror.transform_vector3(p);
        let expected_mirrored = under_quad(flip(origin), flip(u), flip(v), four_at, &bsdf);
        for (kind, map, expected) in [
            ("quad", Affine3A::IDENTITY, expected),
            ("mesh", Affine3A::IDENTITY, expected),
            ("quad", mirror, expected_mirrored),
            ("mesh", mirror, expected_mirrored),
        ] {
            let mut s = floor_scene(surface.clone(), 1024);
            s.camera.position = EYE.normalize() * 0.9;
            let light = textured_light(&mut s);
            if kind == "mesh" {
                let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
                s.place(mesh, light, map);
            } else {
                s.quad(origin, u, v, light).world_from_object = map;
            }
            eprintln!("surface {i}, {kind}, {}: {expected}", map.matrix3.determinant());
            expect_grey(mean(&render(&s)), expected, 2e-3);
        }
    }
}

#[test]
fn textured_emission_of_spheres_and_disks() {
    // A sphere above the floor; longitude from +x towards pole × meridian, latitude from −y to +y
    let (center, radius) = (DVec3::new(-0.3, 1.5, 0.2), 0.8);
    let d = center.length();
    let cap = 1.0 - (1.0 - (radius / d).powi(2)).sqrt();
    let (axis, x) = (center / d, (center / d).any_orthonormal_vector());
    let y = axis.cross(x);
    let expected = cap
        * 2.0
        * integrate_square(1000, |a, b| {
            let cos = 1.0 - a * cap;
            let (sin, phi) = ((1.0 - cos * cos).sqrt(), 2.0 * PI * b);
            let wi = axis * cos + (x * phi.cos() + y * phi.sin()) * sin;
            let t = d * cos - (radius * radius - d * d * sin * sin).max(0.0).sqrt();
            let n = (wi * t - center) / radius;
            // pole × meridian = y × x = −z
            let u = (-n.z).atan2(n.x) / (2.0 * PI);
            four_at(if u < 0.0 { u + 1.0 } else { u }, 0.5 + n.y.asin() / PI) * wi.y
        });
    let mut s = floor_scene(white(), 4096);
    let light = textured_light(&mut s);
    s.sphere(center.as_vec3(), radius as f32, light);
    expect_grey(mean(&render(&s)), expected, 2e-3);

    // A disk: u = angle from +x, v from the rim to the centre; also mirrored, when it turns the other way round
    let expected = |side: f64| {
        2.0 * integrate_square(1000, |a, b| {
            let (r, phi) = (a, 2.0 * PI * b);
            // normal −y: normal × meridian = −y × x = z
            let p = DVec3::new(side * (r * phi.cos() + 0.6), 1.0, r * phi.sin() + 0.4);
            four_at(b, 1.0 - a) * (1.0 / p.length_squared()).powi(2) * r
        })
    };
    for side in [1.0, -1.0] {
        let mut s = floor_scene(white(), 4096);
        s.camera.position = Vec3::new(0.3, 0.2, 0.1);
        let light = textured_light(&mut s);
        let (center, normal) = (Vec3::new(0.6, 1.0, 0.4), Vec3::NEG_Y);
        let disk = ShapeKind::Disk { center, normal, radius: 1.0, meridian: Vec3::X };
        s.shape(disk, light).world_from_object = Affine3A::from_scale(Vec3::new(side, 1.0, 1.0));
        expect_grey(mean(&render(&s)), expected(f64::from(side)), 2e-3);
    }
}

#[test]
fn emission_from_one_side_and_from_both() {
    let (origin, u, v) = QUADS[0];
    let irradiance = polygon_irradiance(&quad_corners(origin, u, v)) / PI;
    for (two_sided, up) in [(false, false), (false, true), (true, false), (true, true)] {
        for as_mesh in [false, true] {
            let (u, v) = if up { (v, u) } else { (u, v) };
            let mut s = floor_scene(white(), 256);
            let light = s.emitter(grey(1.0), two_sided);
            if as_mesh {
                let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
                s.place(mesh, light, Affine3A::IDENTITY);
            } else {
                s.quad(origin, u, v, light);
            }
            let measured = mean(&render(&s));
            if up && !two_sided {
                assert_eq!(measured.mean, [0.0; 3], "light from the back");
            } else {
                expect_grey(measured, irradiance, 1e-3);
            }
            // The same from the light itself
            s.camera = look(Vec3::new(-0.2, 0.5, 0.2), Vec3::new(-0.2, 2.0, 0.21), 5.0);
            expect_every_pixel(&render(&s), [if up && !two_sided { 0.0 } else { 1.0 }; 3], 0.0);
        }
    }
}

#[test]
fn hundred_thousand_point_lights() {
    let mut random = Random(7);
    let mut s = floor_scene(white(), 256);
    let mut expected = 0.0;
    for _ in 0..100_000 {
        let position = random.in_cube(1.0) + Vec3::Y * 3.0;
        let intensity = random.between(0.0, 2.0);
        s.lights.push(point(position, intensity));
        let p = position.as_dvec3();
        expected += f64::from(intensity) * p.normalize().y / p.length_squared() / PI;
    }
    // Light number and slot come from 24 bits: 168 values a light, whose shares round by about 1/√n of 0.6 %
    expect_grey(mean(&render(&s)), expected, 5e-4);
}

#[test]
fn lights_of_all_kinds_and_powers_add_up() {
    let mut s = floor_scene(white(), 16_384);
    s.camera.position = Vec3::new(0.3, 0.2, 0.1);
    let (strong, weak) = (s.emitter(grey(20.0), false), s.emitter(grey(0.5), true));
    let mut expected = 0.0;
    let (origin, u, v) = QUADS[0];
    s.quad(origin, u, v, strong);
    expected += 20.0 * polygon_irradiance(&quad_corners(origin, u, v));
    let (origin, u, v) = (Vec3::new(3.0, 2.0, 0.0), Vec3::Y, Vec3::Z);
    let mesh = s.meshes.add("light", rectangle_mesh(origin, u, v));
    s.place(mesh, weak, Affine3A::IDENTITY);
    expected += 0.5 * polygon_irradiance(&quad_corners(origin, u, v));
    s.sphere(Vec3::new(-3.0, 3.0, 0.0), 0.5, weak);
    expected += 0.5 * PI * 0.25 / 18.0 * 0.5_f64.sqrt();
    s.lights.push(point(Vec3::new(0.0, 4.0, 4.0), 3.0));
    expected += 3.0 / 32.0 * 0.5_f64.sqrt();
    s.lights.push(Light::Distant {
        direction: Vec3::new(-1.0, -0.2, 0.0).normalize(),
        irradiance: Vec3::splat(0.3),
    });
    expected += 0.3 * 0.2 / 1.04_f64.sqrt();
    s.environment = constant_environment(0.2);
    // The environment behind the lights is hidden by them, up to their own irradiance at radiance 0.2
    expected += 0.2 * (PI - polygon_irradiance(&quad_corners(QUADS[0].0, QUADS[0].1, QUADS[0].2)));
    expected -= 0.2 * (polygon_irradiance(&quad_corners(origin, u, v)) + PI * 0.25 / 18.0 * 0.5_f64.sqrt());
    expect_grey(mean(&render(&s)), expected / PI, 1e-4);
}

/// 8 × 4 texels with one bright one.
fn sky() -> (Image, impl Fn(DVec3) -> f64) {
    let value =
        |x: usize, y: usize| if (x, y) == (5, 1) { 40.0 } else { 0.2 + ((x * 7 + y * 3) % 5) as f32 * 0.3 };
    let texels =
        (0..32).map(|i| [value(i % 8, i / 8), value(i % 8, i / 8), value(i % 8, i / 8), 1.0]).collect();
    let at = move |d: DVec3| {
        // The middle column looks along −z, u grows towards +x there, the top row is +y
        let u = 0.5 + d.x.atan2(-d.z) / (2.0 * PI);
        let row = (0.5 - d.y.clamp(-1.0, 1.0).asin() / PI) * 4.0;
        f64::from(value(((u * 8.0) as usize).min(7), (row as usize).min(3)))
    };
    (Image { width: 8, height: 4, texels: Texels::RgbaF32(texels) }, at)
}

fn image_environment(s: &mut Scene, image: Image, turn: Mat3) {
    let texture = s.picture(image, |t| t.filter = TexelFilter::Nearest);
    s.environment =
        Some(Environment { radiance: Value::Texture(texture), scale: 1.0, world_from_environment: turn });
}

#[test]
fn which_pixel_of_an_environment_is_seen_where() {
    let tilt = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(0.4);
    for turn in [Mat3::IDENTITY, tilt] {
        let mut s = scene(1, 1, 1);
        let (image, at) = sky();
        image_environment(&mut s, image, turn);
        s.render.sampler = Sampler::Center;
        // A little off the borders between texels
        for d in [Vec3::NEG_Z, Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::new(0.6, 0.5, 0.4)]
        {
            let d = d.normalize() + Vec3::new(0.02, 0.013, 0.017);
            s.camera = look(Vec3::ZERO, d, 10.0);
            let expected = at(turn.as_dmat3().transpose() * d.as_dvec3().normalize());
            // Sums are whole numbers of 2⁻²⁴ here: 2⁻³⁰ of the brightest texel, 40, rounded up to a power of two
            let seen = f64::from(render(&s).rgb[0][1]);
            assert!((seen - expected).abs() < 1e-7, "{d}: {seen}, expected {expected}");
        }
    }
}

#[test]
fn image_environment_on_a_floor() {
    let tilt = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(0.4) * Mat3::from_rotation_z(-0.3);
    for turn in [Mat3::IDENTITY, tilt] {
        let (_, at) = sky();
        let wo = EYE.as_dvec3().normalize();
        for (surface, bsdf) in surfaces() {
            let back = turn.as_dmat3().transpose();
            let expected = albedo(wo, |wo, wi| bsdf(wo, wi) * at(back * wi));
            let mut s = floor_scene(surface, 2048);
            image_environment(&mut s, sky().0, turn);
            // The quadrature meets the borders of texels at random: about one cell of 1500 wide
            expect_grey(mean(&render(&s)), expected, 2e-3);
        }
    }
}

#[test]
fn moved_environment_pictures_are_sampled_without_bias() {
    let (_, at) = sky();
    let wo = EYE.as_dvec3().normalize();
    // u moved by a quarter: what was seen along −z is seen where u was a quarter less
    let expected = albedo(wo, |_, wi| at(DVec3::new(-wi.z, wi.y, wi.x)) / PI);
    let mut s = floor_scene(white(), 16_384);
    let texture = s.picture(sky().0, |t| {
        t.filter = TexelFilter::Nearest;
        t.uv.offset = glam::Vec2::new(0.25, 0.0);
    });
    let radiance = Value::Texture(texture);
    s.environment = Some(Environment { radiance, scale: 1.0, world_from_environment: Mat3::IDENTITY });
    expect_grey(mean(&render(&s)), expected, 2e-3);
}

#[test]
fn bright_texels_of_an_environment_are_not_clamped() {
    let mut s = scene(4, 4, 4);
    let image = Image { width: 1, height: 1, texels: Texels::RgbaF32(vec![[5.0e4, 1.0, 1.0e-3, 1.0]]) };
    image_environment(&mut s, image, Mat3::IDENTITY);
    let p = render(&s);
    // Sums are whole numbers of 2⁻¹⁴ here
    assert!(p.rgb.iter().all(|c| (c[0] - 5.0e4).abs() < 1e-2 && (c[1] - 1.0).abs() < 1e-4), "{:?}", p.rgb[0]);
}

#[test]
fn light_of_a_stretched_sphere_is_found_by_both_strategies() {
    // A wide lobe against a diffuse one under an ellipsoid light, against quadrature over directions
    let (center, axes) = (DVec3::new(-0.5, 2.0, 0.3), DVec3::new(1.2, 0.4, 0.7));
    let map = Affine3A::from_translation(center.as_vec3()) * Affine3A::from_scale(axes.as_vec3());
    let wo = EYE.as_dvec3().normalize();
    for (surface, bsdf) in surfaces() {
        let hits = |wi: DVec3| {
            let (o, d) = (-center / axes, wi / axes);
            let (b, c) = (o.dot(d), o.length_squared() - 1.0);
            b * b - d.length_squared() * c >= 0.0 && b < 0.0
        };
        let expected = albedo(wo, |wo, wi| if hits(wi) { 2.0 * bsdf(wo, wi) } else { 0.0 });
        let mut s = floor_scene(surface, 2048);
        let light = s.emitter(grey(2.0), false);
        s.sphere(Vec3::ZERO, 1.0, light).world_from_object = map;
        expect_grey(mean(&render(&s)), expected, 3e-3);
    }
}

/// A small grey floor below the camera.
fn small_floor() -> Scene {
    let mut s = scene(4, 4, 64);
    s.render.max_depth = 1;
    s.camera = look(Vec3::new(0.0, 1.0, 0.5), Vec3::ZERO, 20.0);
    let m = s.diffuse(0.5);
    s.quad(Vec3::new(-1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::NEG_Z * 2.0, m);
    s
}

#[test]
fn lamps_that_are_bright_and_far_light_as_much_as_they_should() {
    // Irradiance by the solid angle, which is π r² / d² but for a part in 10⁹
    let (radiance, away) = (1e12_f32, 1e6_f32);
    let at = Vec3::Y * away;
    let mut s = small_floor();
    let lamp = s.emitter(grey(radiance), false);
    s.sphere(at, 1.0, lamp);
    expect_grey(mean(&render(&s)), 0.5, 1e-4);

    let mut s = small_floor();
    let lamp = s.emitter(grey(radiance), false);
    s.disk(at, Vec3::NEG_Y, 1.0, lamp);
    expect_grey(mean(&render(&s)), 0.5, 1e-4);

    let mut s = small_floor();
    let lamp = s.emitter(grey(radiance), false);
    let mesh =
        s.meshes.add("lamp", rectangle_mesh(at - Vec3::new(1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::Z * 2.0));
    s.place(mesh, lamp, Affine3A::IDENTITY);
    expect_grey(mean(&render(&s)), 0.5 * 4.0 / PI, 1e-4);

    let mut s = small_floor();
    s.lights.push(point(at, radiance));
    expect_grey(mean(&render(&s)), 0.5 / PI, 1e-4);
}

#[test]
fn a_bright_lamp_is_seen_as_bright_as_it_is() {
    // Near, and so far that it fills 10⁻⁵ of the half space: no sample of it is clamped
    for distance in [3.0_f32, 200.0] {
        let mut s = small_floor();
        s.camera = look(Vec3::Y, Vec3::Y + Vec3::NEG_Z, 0.01);
        let lamp = s.emitter(grey(1e12), false);
        s.quad(Vec3::new(-1.0, 0.0, -distance), Vec3::X * 2.0, Vec3::Y * 2.0, lamp);
        expect_every_pixel(&render(&s), [1e12; 3], 1e-6);
    }
}
