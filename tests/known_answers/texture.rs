//! Pictures on surfaces: which texel, between texels, outside the picture.

use crate::common::render::*;
use crate::common::twins::texture::wrapped;
use dapple::film::Picture;
use dapple::scene::*;
use glam::{Vec2, Vec3};

/// A picture of distinct texels, the same for every size: no two channels or neighbours alike.
fn numbers(width: u32, height: u32, seed: u64) -> Vec<[f32; 4]> {
    let mut random = Random(seed);
    (0..width * height).map(|_| [0.0; 4].map(|_: f32| random.between(0.02, 0.98))).collect()
}

fn float_image(width: u32, height: u32, seed: u64) -> Image {
    Image { width, height, texels: Texels::RgbaF32(numbers(width, height, seed)) }
}

/// An unlit rectangle whose uv runs over `low..high` fills the picture; one sample through the middle of each pixel.
fn show(
    size: u32,
    low: Vec2,
    high: Vec2,
    image: Image,
    change: impl FnOnce(&mut ImageTexture),
) -> (Picture, Vec<(f64, f64)>) {
    let mut s = scene(size, size, 1);
    s.render.sampler = Sampler::Center;
    let texture = s.picture(image, change);
    let m = s.unlit(Value::Texture(texture));
    let mut mesh = rectangle_mesh(Vec3::new(-1.0, -1.0, -1.0), Vec3::X * 2.0, Vec3::Y * 2.0);
    for uv in &mut mesh.uvs {
        *uv = low + *uv * (high - low);
    }
    let mesh = s.meshes.add("board", mesh);
    s.place(mesh, m, glam::Affine3A::IDENTITY);
    let at =
        |i: u32, a: f32, b: f32| f64::from(a) + (f64::from(i) + 0.5) / f64::from(size) * f64::from(b - a);
    let uvs = (0..size * size)
        .map(|i| (at(i % size, low.x, high.x), at(size - 1 - i / size, low.y, high.y)))
        .collect();
    (render(&s), uvs)
}

/// A texel by the definition of wrapping, row 0 on top.
fn texel(texels: &[[f32; 4]], size: [u32; 2], wrap: [Wrap; 2], x: i64, y: i64) -> [f64; 4] {
    match (wrapped(x, i64::from(size[0]), wrap[0]), wrapped(y, i64::from(size[1]), wrap[1])) {
        (Some(x), Some(y)) => texels[y * size[0] as usize + x].map(f64::from),
        _ => [0.0; 4],
    }
}

/// The value of a picture at uv by definition; none within rounding of a border between texels when `nearest`.
fn lookup(
    texels: &[[f32; 4]],
    size: [u32; 2],
    wrap: [Wrap; 2],
    nearest: bool,
    (u, v): (f64, f64),
) -> Option<[f64; 4]> {
    let (x, y) = (u * f64::from(size[0]), (1.0 - v) * f64::from(size[1]));
    if nearest {
        let border = |a: f64| (a - a.round()).abs() < 1e-4;
        if border(x) || border(y) {
            return None;
        }
        return Some(texel(texels, size, wrap, x.floor() as i64, y.floor() as i64));
    }
    let (x, y) = (x - 0.5, y - 0.5);
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let at = |i: i64, j: i64| texel(texels, size, wrap, x.floor() as i64 + i, y.floor() as i64 + j);
    let (a, b, c, d) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1));
    Some(
        [0, 1, 2, 3]
            .map(|k| (1.0 - fy) * ((1.0 - fx) * a[k] + fx * b[k]) + fy * ((1.0 - fx) * c[k] + fx * d[k])),
    )
}

#[track_caller]
fn expect_rgb(found: [f32; 3], expected: [f64; 4], tolerance: f64, what: &str) {
    for c in 0..3 {
        assert!(
            (f64::from(found[c]) - expected[c]).abs() <= tolerance,
            "{what}: {found:?}, expected {expected:?}"
        );
    }
}

const WRAPS: [Wrap; 4] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Black];

#[test]
fn every_wrap_mode_and_filter_at_odd_sizes() {
    for (k, &u_wrap) in WRAPS.iter().enumerate() {
        for (size, nearest) in
            [([3, 5], true), ([3, 5], false), ([1, 1], true), ([1, 1], false), ([7, 2], false)]
        {
            let wrap = [u_wrap, WRAPS[(k + 1 + size[0] as usize) % 4]];
            let texels = numbers(size[0], size[1], 3);
            let (p, uvs) =
                show(40, Vec2::new(-2.3, -1.7), Vec2::new(3.1, 2.9), float_image(size[0], size[1], 3), |t| {
                    t.wrap = wrap;
                    t.filter = if nearest { TexelFilter::Nearest } else { TexelFilter::Bilinear };
                });
            let mut checked = 0;
            for (i, uv) in uvs.iter().enumerate() {
                let Some(expected) = lookup(&texels, size, wrap, nearest, *uv) else { continue };
                checked += 1;
                // Bilinear: the rounding of uv, 2e-7 of 3, times texels a unit
                expect_rgb(
                    p.rgb[i],
                    expected,
                    if nearest { 1e-8 } else { 1e-5 },
                    &format!("{wrap:?} {size:?} {uv:?}"),
                );
            }
            assert!(checked > 1400, "{checked}");
        }
    }
}

#[test]
fn texel_centres_give_texels_exactly_in_every_format() {
    let n = 8;
    let mut random = Random(5);
    let bytes: Vec<[u8; 4]> =
        (0..n * n).map(|_| [0; 4].map(|_: u8| (random.uniform() * 256.0) as u8)).collect();
    let words: Vec<[u16; 4]> =
        (0..n * n).map(|_| [0; 4].map(|_: u16| (random.uniform() * 65536.0) as u16)).collect();
    let halves: Vec<[f32; 4]> =
        (0..n * n).map(|_| [0; 4].map(|_: u8| (random.uniform() * 1000.0) as i32 as f32 / 256.0)).collect();
    let floats = numbers(n, n, 6);
    let srgb = |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    for space in [ColorSpace::Linear, ColorSpace::Srgb] {
        let decode = |c: f64| if space == ColorSpace::Srgb { srgb(c) } else { c };
        let formats: [(Texels, Vec<[f64; 4]>); 4] = [
            (
                Texels::Rgba8(bytes.clone()),
                bytes.iter().map(|t| t.map(|c| decode(f64::from(c) / 255.0))).collect(),
            ),
            (
                Texels::Rgba16(words.clone()),
                words.iter().map(|t| t.map(|c| decode(f64::from(c) / 65535.0))).collect(),
            ),
            (
                Texels::RgbaF32(halves.clone()),
                halves.iter().map(|t| t.map(|c| decode(f64::from(c)))).collect(),
            ),
            (
                Texels::RgbaF32(floats.clone()),
                floats.iter().map(|t| t.map(|c| decode(f64::from(c)))).collect(),
            ),
        ];
        for (f, (texels, expected)) in formats.into_iter().enumerate() {
            for filter in [TexelFilter::Nearest, TexelFilter::Bilinear] {
                let (p, _) = show(
                    n,
                    Vec2::ZERO,
                    Vec2::ONE,
                    Image { width: n, height: n, texels: texels.clone() },
                    |t| {
                        (t.filter, t.color_space) = (filter, space);
                    },
                );
                for (i, e) in expected.iter().enumerate() {
                    // pow on the device is good to about 1e-6; uv to 1e-7, times texels a unit and their difference
                    let most = e[0].max(e[1]).max(e[2]);
                    expect_rgb(
                        p.rgb[i],
                        *e,
                        4e-6 * (1.0 + most) * 4.0,
                        &format!("format {f} {space:?} {filter:?} texel {i}"),
                    );
                }
            }
        }
    }
}

#[test]
fn v_grows_upward_and_u_to_the_right() {
    let texels = vec![[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0]];
    let image = Image { width: 2, height: 2, texels: Texels::RgbaF32(texels) };
    let (p, _) = show(2, Vec2::ZERO, Vec2::ONE, image, |_| {});
    // The picture upright, as an image viewer shows it
    let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    for (found, [r, g, b]) in p.rgb.iter().zip(expected) {
        expect_rgb(*found, [r, g, b, 0.0], 1e-6, "corner");
    }
}

#[test]
fn uv_is_scaled_then_turned_then_moved() {
    let texels = numbers(4, 4, 9);
    let uv_map = UvTransform { scale: Vec2::new(2.0, 0.5), rotate: 30.0, offset: Vec2::new(0.3, -0.2) };
    let (p, uvs) = show(24, Vec2::ZERO, Vec2::ONE, float_image(4, 4, 9), |t| t.uv = uv_map);
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    for (i, (u, v)) in uvs.into_iter().enumerate() {
        let (a, b) = (2.0 * u, 0.5 * v);
        let uv = (cos * a - sin * b + f64::from(0.3_f32), sin * a + cos * b - f64::from(0.2_f32));
        let expected = lookup(&texels, [4, 4], [Wrap::Repeat; 2], false, uv).unwrap();
        expect_rgb(p.rgb[i], expected, 1e-5, &format!("{uv:?}"));
    }
}

#[test]
fn channel_then_invert_then_scale() {
    let texels = numbers(4, 4, 11);
    for (channel, pick) in [
        (Channel::Rgb, None),
        (Channel::R, Some(0)),
        (Channel::G, Some(1)),
        (Channel::B, Some(2)),
        (Channel::A, Some(3)),
    ] {
        for invert in [false, true] {
            let (p, _) = show(4, Vec2::ZERO, Vec2::ONE, float_image(4, 4, 11), |t| {
                (t.channel, t.invert, t.scale) = (channel, invert, 1.75);
            });
            for (i, t) in texels.iter().enumerate() {
                let expected = [0, 1, 2, 3].map(|c| {
                    let x = f64::from(t[pick.unwrap_or(c)]);
                    1.75 * if invert { 1.0 - x } else { x }
                });
                expect_rgb(p.rgb[i], expected, 1e-5, &format!("{channel:?} {invert}"));
            }
        }
    }
}

#[test]
fn pictures_of_all_sizes_and_formats_do_not_bleed() {
    let sizes = [[1, 1], [3, 5], [16, 16], [7, 2], [2, 9], [33, 17], [1, 40], [600, 3], [5, 1], [8, 8]];
    let mut s = scene(40, 4, 1);
    s.render.sampler = Sampler::Center;
    let mut expected = Vec::new();
    for (k, size) in sizes.into_iter().enumerate() {
        for format in 0..3 {
            let n = (size[0] * size[1]) as usize;
            let mut random = Random((k * 3 + format) as u64);
            let bytes: Vec<[u8; 4]> =
                (0..n).map(|_| [0; 4].map(|_: u8| (random.uniform() * 256.0) as u8)).collect();
            let floats: Vec<[f32; 4]> = match format {
                0 => bytes.iter().map(|t| t.map(|c| f32::from(c) / 255.0)).collect(),
                1 => bytes.iter().map(|t| t.map(|c| f32::from(c) / 256.0)).collect(),
                _ => numbers(size[0], size[1], k as u64),
            };
            let texels = if format == 0 { Texels::Rgba8(bytes) } else { Texels::RgbaF32(floats.clone()) };
            let texture =
                s.picture(Image { width: size[0], height: size[1], texels }, |t| t.wrap = [Wrap::Clamp; 2]);
            let m = s.unlit(Value::Texture(texture));
            // A board a picture, in a row; of each the lower left, a middle, and the upper right
            let x = -20.0 + (k * 3 + format) as f32 * 40.0 / 30.0;
            s.quad(Vec3::new(x, -2.0, -20.0), Vec3::X * (40.0 / 30.0), Vec3::Y * 4.0, m);
            expected.push((floats, size));
        }
    }
    s.camera.projection = Projection::pinhole(2.0 * (2.0_f32 / 20.0).atan().to_degrees());
    let p = render(&s);
    for i in 0..160 {
        let (x, v) = ((f64::from(i % 40) + 0.5) / 40.0 * 30.0, 1.0 - (f64::from(i / 40) + 0.5) / 4.0);
        if (x - x.round()).abs() < 1e-3 {
            continue;
        }
        let (floats, size) = &expected[x as usize];
        let value = lookup(floats, *size, [Wrap::Clamp; 2], false, (x.fract(), v)).unwrap();
        // uv is good to about 1e-5 here, times up to 600 texels
        expect_rgb(
            p.rgb[i as usize],
            value,
            1e-5 + 2e-6 * f64::from(size[0].max(size[1])),
            &format!("{size:?} at {x}"),
        );
    }
}

#[test]
fn sphere_uv_at_poles_and_seam() {
    // Longitude 0 towards +x, the pole up; pole × meridian = −z. A picture of 4 columns and 2 rows
    let mut s = scene(1, 1, 1);
    s.render.sampler = Sampler::Center;
    let texels: Vec<[f32; 4]> = (0..8).map(|i| [i as f32 / 8.0, 0.5, 0.5, 1.0]).collect();
    let image = Image { width: 4, height: 2, texels: Texels::RgbaF32(texels) };
    let texture = s.picture(image, |t| t.filter = TexelFilter::Nearest);
    let m = s.unlit(Value::Texture(texture));
    s.sphere(Vec3::ZERO, 1.0, m);
    let mut seen = |from: Vec3| {
        s.camera = look(from.normalize() * 4.0, Vec3::ZERO, 1.0);
        (f64::from(render(&s).rgb[0][0]) * 8.0).round() as u32
    };
    // Columns by longitude, on both sides of the seam; the upper row is the northern half
    let e = 0.02;
    for (from, expected) in [
        (Vec3::new(1.0, e, -e), 0),
        (Vec3::new(1.0, e, e), 3),
        (Vec3::new(1.0, -e, e), 7),
        (Vec3::new(e, e, -1.0), 0),
        (Vec3::new(-e, e, -1.0), 1),
        (Vec3::new(-1.0, e, -e), 1),
        (Vec3::new(-1.0, e, e), 2),
        (Vec3::new(-e, -e, 1.0), 6),
        (Vec3::new(e, -e, 1.0), 7),
        // u = 0 at the poles themselves
        (Vec3::Y, 0),
        (Vec3::NEG_Y, 4),
    ] {
        assert_eq!(seen(from), expected, "{from}");
    }
    // Only u changes when a sphere turns about its pole
    let spun = ShapeKind::Sphere { center: Vec3::ZERO, radius: 1.0, pole: Vec3::Y, meridian: Vec3::NEG_Z };
    s.shapes[0].kind = spun;
    s.camera = look(Vec3::new(-e, e, -1.0) * 4.0, Vec3::ZERO, 1.0);
    assert_eq!((f64::from(render(&s).rgb[0][0]) * 8.0).round(), 0.0);
}

#[test]
fn three_uses_of_the_colour() {
    let image = || Image { width: 1, height: 1, texels: Texels::Rgba8(vec![[255, 128, 51, 255]]) };
    let color = [1.0, 128.0 / 255.0, 0.2];
    // As the pixel's colour; as diffuse coefficient; as diffuse and specular coefficient, whose sum is kept below 1
    for use_of in 0..3 {
        let mut s = scene(8, 8, 1024);
        s.environment = constant_environment(1.0);
        s.render.max_depth = 1;
        let texture = Value::Texture(s.picture(image(), |_| {}));
        let m = match use_of {
            0 => s.unlit(texture),
            1 => s.material(Surface::diffuse(texture), None),
            _ => s.material(Surface::phong(texture, texture, Value::Constant(0.0)), None),
        };
        s.camera = look(Vec3::new(0.0, 2.0, 0.0), Vec3::ZERO, 1.0);
        s.floor(m);
        // Straight from above, the lobe with exponent 0 is the whole hemisphere
        let expected = if use_of == 2 { color.map(|c| c / 2.0 * 2.0) } else { color };
        expect_mean(mean(&render(&s)), expected, 1e-3);
    }
}
