//! Where rays meet surfaces, and what is there.

use crate::common::render::*;
use dapple::film::Picture;
use dapple::scene::*;
use glam::{Affine3A, DVec3, EulerRot, Quat, Vec2, Vec3};

/// A material whose albedo is u and v: red and green from a picture of two ramps.
fn uv_material(s: &mut Scene) -> Handle<Material> {
    // 64 × 64 texels at their own centres: bilinear filtering gives uv itself between the outermost centres
    let n = 64;
    let at = |i: u32| (i as f32 + 0.5) / n as f32;
    let texels = (0..n * n).map(|i| [at(i % n), 1.0 - at(i / n), 0.25, 1.0]).collect();
    let image = Image { width: n, height: n, texels: Texels::RgbaF32(texels) };
    let texture = s.picture(image, |t| t.wrap = [Wrap::Clamp; 2]);
    s.material(Surface::diffuse(Value::Texture(texture)), None)
}

/// A grey whose front has a blue albedo of 1, because it sends out blue light.
fn front_shines(s: &mut Scene, rho: f32) -> Handle<Material> {
    let emission = Emission { radiance: Value::Constant(Vec3::Z), two_sided: false };
    s.material(Surface::diffuse(grey(rho)), Some(emission))
}

/// One sample through the middle of each pixel, no light: what the rays meet.
pub(super) fn aovs(s: &mut Scene) -> Picture {
    s.render.sampler = Sampler::Center;
    s.render.spp = 1;
    s.render.max_depth = 1;
    render(s)
}

/// Largest difference of depth, normal and albedo between two pictures that hit the same pixels.
#[track_caller]
fn expect_same_aovs(a: &Picture, b: &Picture, tolerance: f32) {
    let mut hits = 0;
    for i in 0..a.rgb.len() {
        assert_eq!(a.alpha[i], b.alpha[i], "pixel {i} is hit in one picture only");
        if a.alpha[i] == 0.0 {
            continue;
        }
        hits += 1;
        let off = (0..3).fold((a.depth[i] - b.depth[i]).abs(), |off, c| {
            off.max((a.normal[i][c] - b.normal[i][c]).abs()).max((a.albedo[i][c] - b.albedo[i][c]).abs())
        });
        assert!(
            off <= tolerance,
            "pixel {i}: {off}: {} {:?} {:?} and {} {:?} {:?}",
            a.depth[i],
            a.normal[i],
            a.albedo[i],
            b.depth[i],
            b.normal[i],
            b.albedo[i]
        );
    }
    assert!(hits > 20, "{hits} hits");
}

/// A bumpy mesh with normals and uv.
fn bumpy(normals: bool, uvs: bool) -> Mesh {
    let n = 6;
    let mut mesh = Mesh::default();
    for j in 0..=n {
        for i in 0..=n {
            let (u, v) = (i as f32 / n as f32, j as f32 / n as f32);
            mesh.positions.push(Vec3::new(u - 0.5, v - 0.5, 0.2 * (6.0 * u).sin() * (5.0 * v).cos()));
            if normals {
                mesh.normals.push(Vec3::new(-0.5 * (6.0 * u).cos(), 0.3 * (5.0 * v).sin(), 1.0).normalize());
            }
            if uvs {
                mesh.uvs.push(Vec2::new(u, v));
            }
        }
    }
    for j in 0..n {
        for i in 0..n {
            let at = |i: u32, j: u32| j * (n + 1) + i;
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

#[test]
fn a_mesh_baked_equals_the_mesh_with_a_tree_of_its_own() {
    let plain = Affine3A::from_scale_rotation_translation(
        Vec3::new(2.0, 1.5, 2.5),
        Quat::from_euler(EulerRot::XYZ, 0.4, -0.5, 0.3),
        Vec3::new(0.2, -0.1, -2.5),
    );
    let sheared =
        plain * Affine3A::from_mat3(glam::Mat3::from_cols(Vec3::X, Vec3::new(0.4, 1.0, 0.0), Vec3::Z));
    let mirrored = plain * Affine3A::from_scale(Vec3::new(1.0, -1.0, 1.0));
    for map in [plain, sheared, mirrored] {
        for (normals, uvs) in [(true, true), (false, true), (true, false), (false, false)] {
            let with = |twice: bool| {
                let mut s = scene(24, 24, 1);
                let m = uv_material(&mut s);
                let mesh = s.meshes.add("mesh", bumpy(normals, uvs));
                s.place(mesh, m, map);
                if twice {
                    // Out of sight
                    s.place(mesh, m, Affine3A::from_translation(Vec3::Z * 50.0));
                }
                aovs(&mut s)
            };
            expect_same_aovs(&with(false), &with(true), 2e-5);
        }
    }
}

#[test]
fn a_mirrored_instance_is_the_mirror_image() {
    let map = Affine3A::from_scale_rotation_translation(
        Vec3::splat(2.0),
        Quat::from_euler(EulerRot::XYZ, 0.4, -0.5, 0.3),
        Vec3::new(0.2, -0.1, -2.5),
    );
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    for (normals, uvs) in [(true, true), (false, false)] {
        for twice in [false, true] {
            let with = |map: Affine3A| {
                let mut s = scene(24, 24, 1);
                let m = uv_material(&mut s);
                let mesh = s.meshes.add("mesh", bumpy(normals, uvs));
                s.place(mesh, m, map);
                if twice {
                    s.place(mesh, m, Affine3A::from_translation(Vec3::Z * 50.0));
                }
                aovs(&mut s)
            };
            let (one, mut other) = (with(map), with(mirror * map));
            // Turn the picture round; the normals' x changes its sign
            for row in 0..24 {
                let range = row * 24..(row + 1) * 24;
                other.alpha[range.clone()].reverse();
                other.depth[range.clone()].reverse();
                other.normal[range.clone()].reverse();
                other.albedo[range.clone()].reverse();
            }
            other.normal.iter_mut().for_each(|n| n[0] = -n[0]);
            expect_same_aovs(&one, &other, 2e-5);
        }
    }
}

#[test]
fn shapes_are_where_a_ray_in_f64_finds_them() {
    // An ellipsoid, turned and mirrored; an ellipse; a sheared quad
    let turn = Quat::from_euler(EulerRot::XYZ, 0.3, 0.5, -0.2);
    let ellipsoid =
        Affine3A::from_scale_rotation_translation(Vec3::new(-1.2, 0.5, 0.8), turn, Vec3::new(0.4, 0.2, -3.0));
    let mut s = scene(32, 32, 1);
    let m = uv_material(&mut s);
    s.sphere(Vec3::ZERO, 1.0, m).world_from_object = ellipsoid;
    let p = aovs(&mut s);
    let map = ellipsoid.matrix3.as_dmat3();
    let (inverse, center) = (map.inverse(), DVec3::new(0.4, 0.2, -3.0));
    let mut hits = 0;
    for i in 0..32 * 32 {
        let (o, d) = center_ray(&s, i % 32, i / 32);
        let (lo, ld) = (inverse * (o - center), inverse * d);
        let (a, b, c) = (ld.length_squared(), lo.dot(ld), lo.length_squared() - 1.0);
        let disc = b * b - a * c;
        // Closer to the outline than rounding of 24-bit numbers allows to tell
        if disc.abs() < 1e-4 {
            continue;
        }
        let i = i as usize;
        assert_eq!(p.alpha[i] > 0.0, disc > 0.0, "pixel {i}");
        if disc < 0.0 {
            continue;
        }
        hits += 1;
        let t = (-b - disc.sqrt()) / a;
        let q = lo + ld * t;
        let n = (inverse.transpose() * q).normalize();
        // Pole +y, meridian +x: pole × meridian = −z
        let u = (-q.z).atan2(q.x) / std::f64::consts::TAU;
        let u = if u < 0.0 { u + 1.0 } else { u };
        let v = 0.5 + q.y.asin() / std::f64::consts::PI;
        let expected = [t, n.x, n.y, n.z, u.clamp(0.5 / 64.0, 1.0 - 0.5 / 64.0), v];
        let found =
            [p.depth[i], p.normal[i][0], p.normal[i][1], p.normal[i][2], p.albedo[i][0], p.albedo[i][1]];
        for (e, f) in expected.iter().zip(found) {
            // Near the outline the point moves by the square root of the rounding
            assert!(
                (e - f64::from(f)).abs() < 1e-5 / disc.sqrt().min(1.0),
                "pixel {i}: {expected:?} {found:?}"
            );
        }
    }
    assert!(hits > 50);
}

#[test]
fn transforms_apply_from_the_right() {
    // Scale first, then turn, then move: the corner (1, 0, 0) goes to (0, 2, 0), then to (5, 2, 0)
    let map = Affine3A::from_translation(Vec3::X * 5.0)
        * Affine3A::from_rotation_z(90_f32.to_radians())
        * Affine3A::from_scale(Vec3::splat(2.0));
    assert!(map.transform_point3(Vec3::X).abs_diff_eq(Vec3::new(5.0, 2.0, 0.0), 1e-5));
    let mut s = scene(1, 1, 1);
    let m = s.diffuse(0.5);
    // A tiny sphere at (1, 0, 0) of its own space is seen at (5, 2, 0)
    s.sphere(Vec3::X, 0.01, m).world_from_object = map;
    s.camera = look(Vec3::new(5.0, 2.0, 10.0), Vec3::new(5.0, 2.0, 0.0), 1.0);
    let p = aovs(&mut s);
    assert!((p.depth[0] - (10.0 - 0.02)).abs() < 1e-4, "{}", p.depth[0]);
}

/// Nearest hit of a triangle in f64 (Möller and Trumbore 1997): distance and least distance to an edge, in barycentrics.
fn triangle(o: DVec3, d: DVec3, [a, b, c]: [DVec3; 3]) -> Option<(f64, f64, DVec3)> {
    let (ab, ac) = (b - a, c - a);
    let n = ab.cross(ac);
    let det = -d.dot(n);
    if det == 0.0 {
        return None;
    }
    let ao = o - a;
    let dao = ao.cross(d);
    let (u, v, t) = (ac.dot(dao) / det, -ab.dot(dao) / det, ao.dot(n) / det);
    let edge = u.min(v).min(1.0 - u - v);
    (t > 0.0).then_some((t, edge, n.normalize()))
}

#[test]
fn random_triangles_spheres_and_disks_against_brute_force() {
    for seed in 0..4 {
        let mut random = Random(seed);
        let mut s = scene(48, 48, 1);
        s.camera.position = Vec3::new(0.0, 0.0, 6.0);
        s.camera.projection = Projection::pinhole(50.0);
        // Each thing has a colour of its own, in two sets of materials so that it names the thing
        let shade = |i: usize| 0.05 + 0.9 * (i as f32) / 400.0;
        let mut triangles = Vec::new();
        let groups = if seed % 2 == 0 { 1 } else { 6 };
        for g in 0..groups {
            let mut mesh = Mesh::default();
            let map = if seed % 2 == 0 {
                Affine3A::IDENTITY
            } else {
                let at = random.in_cube(1.0);
                let flip = if g % 2 == 0 { 1.0 } else { -1.0 };
                Affine3A::from_scale_rotation_translation(
                    Vec3::new(flip, 0.7, 1.3),
                    Quat::from_rotation_y(g as f32),
                    at,
                )
            };
            for _ in 0..40 {
                let size = if random.uniform() < 0.2 { 1.5 } else { 0.3 };
                let at = random.in_cube(1.5);
                let first = mesh.positions.len() as u32;
                for _ in 0..3 {
                    mesh.positions.push(at + random.in_cube(size));
                }
                mesh.triangles.push([first, first + 1, first + 2]);
                // Now and then one without area, and one twice
                if random.uniform() < 0.1 {
                    mesh.triangles.push([first, first, first + 1]);
                }
                if random.uniform() < 0.1 {
                    mesh.triangles.push([first, first + 1, first + 2]);
                }
            }
            let m = front_shines(&mut s, shade(g));
            for t in &mesh.triangles {
                let corners = t.map(|v| {
                    let p = mesh.positions[v as usize];
                    let m = map.matrix3.as_dmat3();
                    m * p.as_dvec3() + Vec3::from(map.translation).as_dvec3()
                });
                triangles.push((corners, map.matrix3.determinant() < 0.0, g));
            }
            let handle = s.meshes.add("mesh", mesh);
            s.place(handle, m, map);
            if seed == 3 {
                s.place(handle, m, Affine3A::from_translation(Vec3::Z * 100.0));
            }
        }
        let mut balls = Vec::new();
        let mut disks = Vec::new();
        for i in 0..30 {
            let (c, r) = (random.in_cube(2.0), random.between(0.05, 0.4));
            let m = front_shines(&mut s, shade(100 + i));
            if i % 2 == 0 {
                s.sphere(c, r, m);
                balls.push((c.as_dvec3(), f64::from(r), 100 + i));
            } else {
                let n = random.in_cube(1.0).normalize();
                s.disk(c, n, r, m);
                disks.push((c.as_dvec3(), n.as_dvec3(), f64::from(r), 100 + i));
            }
        }
        let p = aovs(&mut s);
        let (mut hits, mut skipped) = (0, 0);
        for i in 0..48 * 48 {
            let (o, d) = center_ray(&s, i % 48, i / 48);
            // Nearest hit; a pixel is left out when anything in front of it is hit or missed by less than rounding
            let mut best: Option<(f64, DVec3, usize)> = None;
            let mut close_calls = Vec::new();
            let mut offer = |t: f64, margin: f64, n: DVec3, id: usize, tight: f64| {
                if margin.abs() < tight {
                    close_calls.push(t);
                } else if margin > 0.0 && t > 0.0 && best.is_none_or(|(b, ..)| t < b) {
                    best = Some((t, n, id));
                }
            };
            for (corners, mirrored, id) in &triangles {
                if let Some((t, edge, n)) = triangle(o, d, *corners) {
                    let thin = (n.dot(d)).abs();
                    offer(t, edge, if *mirrored { -n } else { n }, *id, 1e-5 / thin.max(1e-3));
                }
            }
            for (c, r, id) in &balls {
                let b = (o - *c).dot(d);
                let disc = b * b - (o - *c).length_squared() + r * r;
                let t = -b - disc.max(0.0).sqrt();
                offer(t, disc, ((o + d * t) - *c) / *r, *id, 1e-4 * r);
            }
            for (c, n, r, id) in &disks {
                let t = (*c - o).dot(*n) / d.dot(*n);
                offer(t, r - (o + d * t - *c).length(), *n, *id, 1e-4 * r / d.dot(*n).abs().max(1e-3));
            }
            let i = i as usize;
            let nearest = best.map_or(f64::INFINITY, |(t, ..)| t);
            if close_calls.iter().any(|&t| t < nearest + 1e-3) {
                skipped += 1;
                continue;
            }
            assert_eq!(p.alpha[i] > 0.0, best.is_some(), "seed {seed}, pixel {i}");
            let Some((t, n, id)) = best else { continue };
            hits += 1;
            assert!(
                (f64::from(p.depth[i]) - t).abs() < 2e-5 * t / n.dot(d).abs().max(0.02),
                "pixel {i}: {} {t}",
                p.depth[i]
            );
            assert!(
                (p.albedo[i][0] - shade(id)).abs() < 1e-5,
                "seed {seed}, pixel {i}: {} is not {id}",
                p.albedo[i][0]
            );
            let front = n.dot(d) < 0.0;
            assert_eq!(p.albedo[i][2] > 0.99, front, "seed {seed}, pixel {i}: the front of {id}");
            let (n, found) = (if front { n } else { -n }, DVec3::from(p.normal[i].map(f64::from)));
            assert!((found - n).length() < 1e-4 / n.dot(d).abs().clamp(1e-2, 1.0), "pixel {i}: {found} {n}");
        }
        assert!(hits > 500 && skipped < 60, "seed {seed}: {hits} hits, {skipped} close calls");
    }
}

#[test]
fn emission_keeps_its_side_under_a_mirror() {
    for twice in [false, true] {
        for mirrored in [false, true] {
            let mut s = scene(8, 8, 256);
            s.camera = look(Vec3::new(0.5, 0.3, 0.2), Vec3::ZERO, 0.02);
            s.render.max_depth = 1;
            let white = s.diffuse(1.0);
            s.floor(white);
            let light = s.emitter(grey(2.0), false);
            // Faces down
            let mesh = s
                .meshes
                .add("light", rectangle_mesh(Vec3::new(-1.0, 2.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0));
            let map = Affine3A::from_scale(Vec3::new(if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0));
            s.place(mesh, light, map);
            if twice {
                s.place(mesh, light, Affine3A::from_translation(Vec3::Y * -100.0));
            }
            // Four quarters, each of them seen from under its corner (the form factor of a rectangle at a corner, times π)
            let corner = {
                let (a, b, h) = (1.0_f64, 1.0_f64, 2.0_f64);
                let (p, q) = (a.hypot(h), b.hypot(h));
                0.5 * (a / p * (b / p).atan() + b / q * (a / q).atan())
            };
            let expected = 2.0 * 4.0 * corner / std::f64::consts::PI;
            expect_grey(mean(&render(&s)), expected, 1e-3);
        }
    }
}
