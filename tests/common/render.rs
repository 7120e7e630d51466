//! Tiny scenes built in code, rendered on one device a test program, and compared with what must come out.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at what it cannot do"
)]

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use dapple::film::{Film, Picture};
use dapple::gpu::{DeviceChoice, DeviceType, Gpu};
use dapple::render::{Kernels, Next, Options, Renderer};
use dapple::scene::{
    Camera, Conductor, Dielectric, Emission, Environment, Fresnel, Handle, Image, ImageTexture, Instance,
    Light, Material, Mesh, Projection, Roughness, Scene, Shape, ShapeKind, Surface, Texture, Value,
};
use dapple::shader::{CacheOptions, Compiler, Sources};
use glam::{Affine3A, DVec3, Vec3};

/// The device of this test program, with the validation layer when `DAPPLE_VALIDATION` is set.
pub fn gpu() -> Arc<Gpu> {
    static GPU: OnceLock<Arc<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| {
        let validation = dapple::gpu::validation_from_environment();
        Arc::new(Gpu::open(&DeviceChoice { validation, ..DeviceChoice::default() }).unwrap())
    })
    .clone()
}

/// The shaders of this checkout, so that an edit of one is tested without building the library again.
fn sources() -> Sources {
    Sources::folder(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders")).unwrap()
}

/// Options that suit the device.
pub fn options() -> Options {
    Options::of(&gpu())
}

/// A scene on the device.
pub fn open(scene: &Scene, options: Options) -> Renderer {
    open_with(sources(), scene, options)
}

/// The same, with other shaders.
pub fn open_with(sources: Sources, scene: &Scene, options: Options) -> Renderer {
    // Most tests need the kernels of others: the driver compiles them once
    static KEPT: Mutex<Vec<Kernels>> = Mutex::new(Vec::new());
    // What is compiled is kept on disk
    let mut compiler = Compiler::new(sources, CacheOptions::from_environment());
    let renderer = Renderer::open(gpu(), &mut compiler, scene.clone(), options).unwrap();
    KEPT.lock().unwrap_or_else(PoisonError::into_inner).push(renderer.kernels().clone());
    renderer
}

/// All samples of a scene.
pub fn film_of(scene: &Scene, options: Options) -> Film {
    open(scene, options).render(0, scene.render.spp, &mut |_| Next::Continue).unwrap()
}

/// What a scene shows. No sample of any test may be left out (not finite) or clamped.
pub fn render(scene: &Scene) -> Picture {
    let film = film_of(scene, options());
    assert_eq!((film.left_out(), film.clamped()), (0, 0), "samples left out, and clamped");
    assert_eq!(film.samples_per_pixel(), scene.render.spp);
    film.resolve()
}

/// A mean with its standard error, per channel.
#[derive(Debug, Clone, Copy)]
pub struct Measured {
    pub mean: [f64; 3],
    pub error: [f64; 3],
}

/// Mean of some pixels, which are independent of one another.
pub fn mean_of(picture: &Picture, pixels: impl IntoIterator<Item = usize>) -> Measured {
    let (mut mean, mut variance, mut n) = ([0.0; 3], [0.0; 3], 0.0);
    for i in pixels {
        for c in 0..3 {
            mean[c] += f64::from(picture.rgb[i][c]);
            variance[c] += f64::from(picture.variance[i][c]);
        }
        n += 1.0;
    }
    assert!(n > 0.0, "a mean of no pixels");
    Measured { mean: mean.map(|m| m / n), error: variance.map(|v| v.sqrt() / n) }
}

/// Mean of the whole picture.
pub fn mean(picture: &Picture) -> Measured {
    mean_of(picture, 0..picture.rgb.len())
}

/// Standard errors that a mean may be off.
pub const SIGMAS: f64 = 4.0;
/// A test whose noise allows more than this part of the expected value proves nothing, and fails.
pub const DULLEST: f64 = 0.04;
/// Part of the expected value that 32-bit arithmetic along a path may cost.
pub const ROUNDING: f64 = 2e-5;

/// Demands `mean = expected` in every channel: off by at most 4 standard errors and `bias`, which is relative to the expected
/// value and has its reason at the call.
#[track_caller]
pub fn expect_mean(measured: Measured, expected: [f64; 3], bias: f64) {
    for (c, &expected) in expected.iter().enumerate() {
        let (mean, noise) = (measured.mean[c], SIGMAS * measured.error[c]);
        assert!(mean.is_finite() && noise.is_finite());
        assert!(noise <= DULLEST * expected.abs(), "too noisy: {noise:.3e} about {:.6}", expected);
        let off = (mean - expected).abs();
        let allowed = noise + (bias + ROUNDING) * expected.abs();
        assert!(
            off <= allowed,
            "channel {c}: {mean:.6}, expected {:.6}: off by {off:.2e} = {:.2} %, allowed {allowed:.2e}",
            expected,
            100.0 * off / expected.abs()
        );
    }
}

/// The same for grey.
#[track_caller]
pub fn expect_grey(measured: Measured, expected: f64, bias: f64) {
    expect_mean(measured, [expected; 3], bias);
}

/// Demands a value of every pixel, with a relative and an absolute tolerance.
#[track_caller]
pub fn expect_every_pixel(picture: &Picture, expected: [f64; 3], relative: f64) {
    for (i, rgb) in picture.rgb.iter().enumerate() {
        for c in 0..3 {
            let off = (f64::from(rgb[c]) - expected[c]).abs();
            assert!(off <= relative * expected[c].abs() + 1e-8, "pixel {i}: {rgb:?}, expected {expected:?}");
        }
    }
}

/// Two measurements of one thing.
#[track_caller]
pub fn expect_same(a: Measured, b: Measured, bias: f64) {
    let error = [0, 1, 2].map(|c| a.error[c].hypot(b.error[c]));
    expect_mean(Measured { mean: a.mean, error }, b.mean, bias);
}

/// A scene without anything in it: a pinhole at the origin that looks along −z with a field of view of 90°.
pub fn scene(width: u32, height: u32, spp: u32) -> Scene {
    let mut scene = Scene::default();
    (scene.film.width, scene.film.height) = (width, height);
    scene.render.spp = spp;
    scene.camera = look(Vec3::ZERO, -Vec3::Z, 90.0);
    scene
}

/// A pinhole camera, y up where it can be.
pub fn look(position: Vec3, target: Vec3, fov: f32) -> Camera {
    let view = (target - position).normalize();
    let up = if view.y.abs() > 0.99 { -Vec3::Z } else { Vec3::Y };
    Camera { position, target, up, mirrored: false, projection: Projection::pinhole(fov), at_close: None }
}

/// Grey.
pub fn grey(x: f32) -> Value<Vec3> {
    Value::Constant(Vec3::splat(x))
}

/// Short ways to put things into a scene.
pub trait Build {
    fn material(&mut self, surface: Surface, emission: Option<Emission>) -> Handle<Material>;
    fn shape(&mut self, kind: ShapeKind, material: Handle<Material>) -> &mut Shape;
    fn place(&mut self, mesh: Handle<Mesh>, material: Handle<Material>, map: Affine3A);
    fn picture(&mut self, image: Image, change: impl FnOnce(&mut ImageTexture)) -> Handle<Texture>;

    fn diffuse(&mut self, rho: f32) -> Handle<Material> {
        self.material(Surface::diffuse(grey(rho)), None)
    }
    fn black(&mut self) -> Handle<Material> {
        self.diffuse(0.0)
    }
    fn unlit(&mut self, color: Value<Vec3>) -> Handle<Material> {
        self.material(Surface::Unlit { color }, None)
    }
    fn emitter(&mut self, radiance: Value<Vec3>, two_sided: bool) -> Handle<Material> {
        self.material(Surface::diffuse(grey(0.0)), Some(Emission { radiance, two_sided }))
    }
    fn conductor(&mut self, reflectance: f32, alpha: f32, fresnel: Fresnel) -> Handle<Material> {
        self.material(conductor(reflectance, alpha, fresnel), None)
    }
    fn glass(&mut self, ior: f32, alpha: f32, absorption: Vec3, thin: bool) -> Handle<Material> {
        self.material(glass(ior, alpha, absorption, thin), None)
    }
    fn sphere(&mut self, center: Vec3, radius: f32, material: Handle<Material>) -> &mut Shape {
        self.shape(sphere(center, radius), material)
    }
    fn quad(&mut self, origin: Vec3, edge_u: Vec3, edge_v: Vec3, material: Handle<Material>) -> &mut Shape {
        self.shape(ShapeKind::Quad { origin, edge_u, edge_v }, material)
    }
    fn disk(&mut self, center: Vec3, normal: Vec3, radius: f32, material: Handle<Material>) -> &mut Shape {
        let meridian = normal.any_orthonormal_vector();
        self.shape(ShapeKind::Disk { center, normal, radius, meridian }, material)
    }
    /// A floor at y = 0 that faces up.
    fn floor(&mut self, material: Handle<Material>) -> &mut Shape {
        let s = 200.0;
        self.quad(Vec3::new(-s, 0.0, s), Vec3::X * 2.0 * s, Vec3::NEG_Z * 2.0 * s, material)
    }
}

impl Build for Scene {
    fn material(&mut self, surface: Surface, emission: Option<Emission>) -> Handle<Material> {
        self.materials.add("material", Material::new(surface, emission))
    }
    fn shape(&mut self, kind: ShapeKind, material: Handle<Material>) -> &mut Shape {
        let name = format!("shape {}", self.shapes.len());
        self.shapes.push(Shape {
            name,
            kind,
            material,
            world_from_object: Affine3A::IDENTITY,
            at_close: None,
        });
        let last = self.shapes.len() - 1;
        &mut self.shapes[last]
    }
    fn place(&mut self, mesh: Handle<Mesh>, material: Handle<Material>, map: Affine3A) {
        let name = format!("instance {}", self.instances.len());
        self.instances.push(Instance { name, mesh, material, world_from_object: map, at_close: None });
    }
    fn picture(&mut self, image: Image, change: impl FnOnce(&mut ImageTexture)) -> Handle<Texture> {
        let image = self.images.add("picture", image);
        let mut texture = ImageTexture {
            image,
            filter: dapple::scene::TexelFilter::Bilinear,
            wrap: [dapple::scene::Wrap::Repeat; 2],
            uv: dapple::scene::UvTransform::default(),
            color_space: dapple::scene::ColorSpace::Linear,
            channel: dapple::scene::Channel::Rgb,
            scale: 1.0,
            invert: false,
        };
        change(&mut texture);
        self.textures.add("texture", Texture::Image(texture))
    }
}

/// A metal.
pub fn conductor(reflectance: f32, alpha: f32, fresnel: Fresnel) -> Surface {
    let roughness = Roughness::alpha(alpha);
    Surface::Conductor(Conductor { reflectance: grey(reflectance), fresnel, roughness })
}

/// Clear material.
pub fn glass(ior: f32, alpha: f32, absorption: Vec3, thin: bool) -> Surface {
    let (ior, roughness) = (Value::Constant(ior), Roughness::alpha(alpha));
    Surface::Dielectric(Dielectric { ior, roughness, abbe: None, absorption, thin })
}

/// A sphere with its north pole up and longitude 0 towards +x.
pub fn sphere(center: Vec3, radius: f32) -> ShapeKind {
    ShapeKind::Sphere { center, radius, pole: Vec3::Y, meridian: Vec3::X }
}

/// The same radiance from everywhere.
pub fn constant_environment(radiance: f32) -> Option<Environment> {
    Some(Environment::new(grey(radiance)))
}

/// A point light.
pub fn point(position: Vec3, intensity: f32) -> Light {
    Light::point(position, Vec3::splat(intensity))
}

/// The twelve triangles of a box, counter-clockwise seen from outside; from inside when `inward`.
pub fn box_mesh(low: Vec3, high: Vec3, inward: bool) -> Mesh {
    let corner = |i: usize| {
        let pick = |bit: usize, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
        Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut triangles: Vec<[u32; 3]> =
        faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect();
    if inward {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    Mesh { positions: (0..8).map(corner).collect(), triangles, ..Mesh::default() }
}

/// A rectangle as two triangles, with the uv of a quad shape.
pub fn rectangle_mesh(origin: Vec3, edge_u: Vec3, edge_v: Vec3) -> Mesh {
    use glam::Vec2;
    Mesh {
        positions: vec![origin, origin + edge_u, origin + edge_u + edge_v, origin + edge_v],
        uvs: vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// Independent numbers: SplitMix64.
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ bits >> 31) >> 11) as f64 * 2f64.powi(-53)
    }
    /// Uniform in [low, high).
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.uniform() as f32
    }
    /// Uniform in a cube about the origin.
    pub fn in_cube(&mut self, half: f32) -> Vec3 {
        Vec3::new(self.between(-half, half), self.between(-half, half), self.between(-half, half))
    }
}

/// Origin and unit direction of the ray through the middle of a pixel, in f64.
pub fn center_ray(scene: &Scene, x: u32, y: u32) -> (DVec3, DVec3) {
    let (width, height) = (f64::from(scene.film.width), f64::from(scene.film.height));
    let camera = &scene.camera;
    let back = (camera.position - camera.target).as_dvec3().normalize();
    let right = camera.up.as_dvec3().cross(back).normalize();
    let up = back.cross(right);
    let right = if camera.mirrored { -right } else { right };
    let Projection::Perspective(view) = &camera.projection else { panic!("no perspective") };
    let tan = (f64::from(view.fov).to_radians() / 2.0).tan();
    let px = (2.0 * (f64::from(x) + 0.5) / width - 1.0) * tan * width / height;
    let py = (1.0 - 2.0 * (f64::from(y) + 0.5) / height) * tan;
    (camera.position.as_dvec3(), (right * px + up * py - back).normalize())
}

/// Mean of a function over the cells of a grid on the unit square: the midpoint rule.
pub fn integrate_square(n: u32, f: impl Fn(f64, f64) -> f64) -> f64 {
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
    (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| f(at(i), at(j))).sum::<f64>()
        / f64::from(n).powi(2)
}

/// The powers of two by which a scene may be scaled and no bit of its picture changes: all of them on a CPU device; on others,
/// which flush denormals and divide approximately near the ends of the range, those up to `most`.
pub fn exact_scales(exponents: &[i32], most: i32) -> impl Iterator<Item = i32> {
    let all = gpu().info().kind == DeviceType::Cpu;
    exponents.iter().copied().filter(move |exponent| all || exponent.abs() <= most)
}
