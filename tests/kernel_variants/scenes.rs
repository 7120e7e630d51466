//! Scenes that together switch every feature on and off.

use crate::cameras::cameras;
use crate::coats::{rough_coats, smooth_coats};
use crate::common::patterns::{noise, patterns};
use crate::common::placed::placed;
use dapple::scene::*;
use glam::{Affine3A, Vec3};

pub fn constant(x: f32) -> Value<Vec3> {
    Value::Constant(Vec3::splat(x))
}

fn diffuse(color: f32) -> Surface {
    Surface::diffuse(constant(color))
}

fn glass(ior: f32, alpha: [f32; 2], absorption: f32) -> Surface {
    let [u, v] = alpha.map(Value::Constant);
    let (ior, roughness) = (Value::Constant(ior), Roughness::alphas(u, v));
    Surface::Dielectric(Dielectric {
        ior,
        roughness,
        abbe: None,
        absorption: Vec3::splat(absorption),
        thin: false,
    })
}

pub fn material(scene: &mut Scene, surface: Surface, light: Option<Value<Vec3>>) -> Handle<Material> {
    let emission = light.map(|radiance| Emission { radiance, two_sided: false });
    scene.materials.add("material", Material::new(surface, emission))
}

pub fn place_triangle(scene: &mut Scene, material: Handle<Material>, copies: u32) {
    let triangle = Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        triangles: vec![[0, 1, 2]],
        parts: vec![MeshPart { name: String::new(), triangles: 0..1, material: None }],
        ..Mesh::default()
    };
    let mesh = scene.meshes.add("mesh", triangle);
    for i in 0..copies {
        let world_from_object = Affine3A::from_translation(Vec3::Z * i as f32);
        scene.instances.push(Instance {
            name: "instance".into(),
            mesh,
            material,
            world_from_object,
            at_close: None,
        });
    }
}

fn place_shape(scene: &mut Scene, material: Handle<Material>, kind: ShapeKind) {
    let world_from_object = Affine3A::IDENTITY;
    scene.shapes.push(Shape { name: "shape".into(), kind, material, world_from_object, at_close: None });
}

fn sphere() -> ShapeKind {
    ShapeKind::Sphere { center: Vec3::ZERO, radius: 1.0, pole: Vec3::Y, meridian: Vec3::X }
}

fn disk() -> ShapeKind {
    ShapeKind::Disk { center: Vec3::ZERO, normal: Vec3::Y, radius: 1.0, meridian: Vec3::X }
}

fn quad() -> ShapeKind {
    ShapeKind::Quad { origin: Vec3::ZERO, edge_u: Vec3::X, edge_v: Vec3::Z }
}

/// A tube, and parts of a sphere and of a disk.
fn parts() -> [ShapeKind; 3] {
    let sphere = Extent::Sphere { z_min: -0.5, z_max: 0.5 };
    let extents = [sphere, Extent::Disk { inner_radius: 0.5 }, Extent::Cylinder { z_min: 0.0, z_max: 1.0 }];
    let (center, radius, axis, meridian, phi_max) = (Vec3::ZERO, 1.0, Vec3::Y, Vec3::X, 270.0);
    extents.map(|extent| ShapeKind::Quadric(Quadric { extent, center, radius, axis, meridian, phi_max }))
}

fn patch() -> ShapeKind {
    let normals = Some([Vec3::Z; 4]);
    ShapeKind::Patch(Patch { normals, ..Patch::new([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE]) })
}

/// Shapes that are in no other scene, all of them lamps.
fn curved() -> Scene {
    let mut scene = Scene::default();
    let lamp = material(&mut scene, diffuse(0.5), Some(constant(1.0)));
    parts().into_iter().chain([patch()]).for_each(|kind| place_shape(&mut scene, lamp, kind));
    scene
}

pub fn surroundings(radiance: Value<Vec3>) -> Option<Environment> {
    Some(Environment { scale: 2.0, ..Environment::new(radiance) })
}

pub fn texture(scene: &mut Scene, texels: Texels, color_space: ColorSpace) -> Handle<Texture> {
    let image = scene.images.add("image", Image { width: 2, height: 1, texels });
    let texture = ImageTexture {
        image,
        filter: if scene.textures.len().is_multiple_of(2) {
            TexelFilter::Trilinear
        } else {
            TexelFilter::Bilinear
        },
        wrap: [Wrap::Repeat, Wrap::Mirror],
        uv: UvTransform::default(),
        color_space,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    };
    scene.textures.add("texture", Texture::Image(texture))
}

fn plain() -> Scene {
    let mut scene = Scene::default();
    let grey = material(&mut scene, diffuse(0.5), None);
    place_triangle(&mut scene, grey, 1);
    scene.lights.push(Light::point(Vec3::Y, Vec3::ONE));
    scene.render.sampler = Sampler::Center;
    scene.render.russian_roulette = false;
    scene
}

fn shapes() -> Scene {
    let mut scene = Scene::default();
    let unlit = material(&mut scene, Surface::Unlit { color: constant(1.0) }, None);
    let lamp = material(&mut scene, diffuse(0.0), Some(constant(1.0)));
    place_triangle(&mut scene, unlit, 3);
    place_triangle(&mut scene, lamp, 1);
    for kind in [sphere(), disk(), quad()] {
        place_shape(&mut scene, lamp, kind);
    }
    let (position, direction) = (Vec3::Y, -Vec3::Y);
    scene.lights.extend([
        Light::new(LightKind::spot(position, 30.0, 5.0), constant(1.0)).along(direction),
        Light::distant(direction, Vec3::ONE),
    ]);
    let aperture = Aperture::Radius(0.1);
    let mut lens = Lens::new(aperture, 2.0);
    lens.opening.blades = 6;
    scene.camera.projection = Projection::thin_lens(40.0, lens);
    scene.render.sampler = Sampler::Stratified;
    scene.render.geometric_veto = true;
    scene.film.filter.kind = FilterKind::Gaussian;
    scene
}

fn lobes() -> Scene {
    let mut scene = Scene::default();
    let roughness = Roughness::alphas(Value::Constant(0.1), Value::Constant(0.4));
    let metal = Conductor { reflectance: constant(0.9), fresnel: Fresnel::Schlick, roughness };
    let phong = Surface::phong(constant(0.4), constant(0.4), Value::Constant(30.0));
    let surfaces =
        [glass(1.5, [0.0, 0.0], 1.0), glass(1.3, [0.3, 0.2], 0.0), Surface::Conductor(metal), phong];
    for surface in surfaces {
        let m = material(&mut scene, surface, None);
        place_shape(&mut scene, m, sphere());
    }
    scene.environment = surroundings(constant(1.0));
    scene.film.transparent = true;
    scene.render.sampler = Sampler::Random;
    scene.film.filter.kind = FilterKind::Mitchell { b: 0.3, c: 0.3 };
    scene
}

/// The principled model with all that it has, and mixes one in the other.
fn layers() -> Scene {
    let mut scene = Scene::default();
    let bytes = Texels::Rgba8(vec![[9, 99, 200, 255]; 2]);
    let picture = texture(&mut scene, bytes, ColorSpace::Srgb);
    let number = Value::Texture(picture);
    let all = Principled {
        base_color: Value::Texture(picture),
        metallic: number,
        roughness: Roughness { u: number, v: number, squared: true },
        ior: number,
        specular: number,
        specular_color: Value::Texture(picture),
        transmission: number,
        abbe: None,
        absorption: Vec3::ONE,
        thin: false,
        clearcoat: number,
        clearcoat_roughness: number,
        sheen_color: Value::Texture(picture),
        sheen_roughness: number,
    };
    let plain = material(&mut scene, Surface::Principled(Box::default()), None);
    let all = material(&mut scene, Surface::Principled(Box::new(all)), None);
    let mix = Mix { a: plain, b: all, amount: number };
    let mixed = material(&mut scene, Surface::Mix(mix), Some(constant(1.0)));
    let mix = Mix { a: mixed, b: plain, amount: Value::Constant(0.5) };
    let again = material(&mut scene, Surface::Mix(mix), None);
    place_shape(&mut scene, mixed, sphere());
    place_triangle(&mut scene, again, 1);
    scene
}

/// The principled model without what it can do without.
fn bare() -> Scene {
    let mut scene = Scene::default();
    let plain = material(&mut scene, Surface::Principled(Box::default()), None);
    place_triangle(&mut scene, plain, 1);
    scene.environment = surroundings(constant(1.0));
    scene
}

/// Things and a camera that move.
fn moving() -> Scene {
    let mut scene = Scene::default();
    let white = material(&mut scene, diffuse(0.5), Some(constant(1.0)));
    place_triangle(&mut scene, white, 1);
    for kind in [sphere(), disk(), quad(), patch()].into_iter().chain(parts()) {
        place_shape(&mut scene, white, kind);
    }
    let close = Some(Affine3A::from_rotation_y(0.5));
    scene.shapes.iter_mut().for_each(|shape| shape.at_close = close);
    scene.instances.iter_mut().for_each(|instance| instance.at_close = close);
    let Camera { position, target, up, .. } = scene.camera;
    scene.camera.at_close = Some(Stand { position: position + Vec3::X, target, up });
    scene
}

/// Every kind of texture, one in the other.
fn trees() -> Scene {
    let mut scene = Scene::default();
    let mut last = scene.textures.add("paper", Texture::Constant(Vec3::ONE));
    let spaces = [Coordinates::Uv, Coordinates::Object, Coordinates::World];
    let sums = [NoiseSum::Fbm, NoiseSum::Turbulence, NoiseSum::Ridged];
    for (i, (coordinates, sum)) in spaces.into_iter().zip(sums).enumerate() {
        let space = PatternSpace { filter_width: i as f32, ..PatternSpace::new(coordinates) };
        let low = patterns(&mut scene, Value::Texture(last), space, i as u32);
        let noise = noise(sum, Perlin::default(), low, space);
        let noise = Value::Texture(scene.textures.add("noise", Texture::Noise(noise)));
        let checker = Texture::Checker { dimensions: 3, even: noise, odd: constant(0.2), space };
        let a = Value::Texture(scene.textures.add("checker", checker));
        let inverted = Value::Texture(scene.textures.add("inverted", Texture::Invert { value: a }));
        let product = Value::Texture(scene.textures.add("product", Texture::Multiply { a, b: inverted }));
        let sum = scene.textures.add("sum", Texture::Add { a: product, b: noise });
        let (low, high) = (Value::Texture(sum), constant(0.5));
        let gradient = Texture::Gradient { shape: Gradient::Cylindrical, low, high, space };
        let high = Value::Texture(scene.textures.add("gradient", gradient));
        let (feature, metric) = (WorleyFeature::Difference, Metric::Manhattan);
        let cells = Texture::Worley { feature, metric, low: constant(0.1), high, space };
        let value = Value::Texture(scene.textures.add("cells", cells));
        let stops = vec![(0.0, Vec3::ZERO), (1.0, Vec3::ONE)];
        let sum = scene.textures.add("ramp", Texture::Ramp { value, stops, smooth: true });
        let faced = Texture::DirectionMix { a, b: noise, direction: Vec3::Y };
        let b = Value::Texture(scene.textures.add("faced", faced));
        last = scene.textures.add("mixed", Texture::Mix { a, b, amount: Value::Texture(sum) });
    }
    let placed = placed(&mut scene);
    let shade = Surface::diffuse(Value::Texture(last));
    let lamp = material(&mut scene, shade, Some(placed));
    let (value, filter) = (Value::Texture(last), Value::Texture(last));
    let detail = &mut scene.materials[lamp].detail;
    detail.opacity = Opacity { value, cutoff: None, filter };
    detail.bump = Some(Bump { texture: last, height: 1.0, derivative: Derivative::Kernel, curvature: true });
    let (green_down, strength, tangents) = (false, 1.0, Tangents::MikkTSpace);
    detail.normal_map = Some(NormalMap { texture: last, green_down, strength, tangents });
    place_triangle(&mut scene, lamp, 1);
    for kind in [sphere(), patch()].into_iter().chain(parts()) {
        place_shape(&mut scene, lamp, kind);
    }
    scene.environment = surroundings(Value::Texture(last));
    scene
}

/// Surfaces that are there from their front alone, and nothing else that lets rays through.
fn fronts() -> Scene {
    let mut scene = plain();
    let one_sided = material(&mut scene, diffuse(0.5), Some(constant(1.0)));
    scene.materials[one_sided].detail.sides = Sides::Front;
    place_triangle(&mut scene, one_sided, 1);
    place_shape(&mut scene, one_sided, sphere());
    scene
}

/// Textures that see colours of vertices, a second set of texture coordinates, or both, wherever there are textures.
fn corners(colors: bool, uvs: bool) -> Scene {
    let mut scene = Scene::default();
    let bytes = Texels::Rgba8(vec![[9, 99, 200, 255]; 2]);
    let mut last = texture(&mut scene, bytes, ColorSpace::Srgb);
    if colors {
        let color = Value::Texture(scene.textures.add("color", Texture::VertexColor(Channel::Rgb)));
        last = scene.textures.add("product", Texture::Multiply { a: color, b: Value::Texture(last) });
    }
    if uvs {
        let mapping = Mapping {
            kind: MappingKind::Uv1,
            space: MappingSpace::Object,
            mapping_from_space: Affine3A::IDENTITY,
            pole_u: 0.0,
            seam_blend: 0.5,
            sharpness: 4.0,
        };
        last = scene.textures.add("second", Texture::Mapped { value: Value::Texture(last), mapping });
    }
    let value = Value::Texture(last);
    let lamp = material(&mut scene, Surface::diffuse(value), Some(value));
    let detail = &mut scene.materials[lamp].detail;
    detail.opacity = Opacity { value: Value::Texture(last), cutoff: None, filter: value };
    detail.bump = Some(Bump { texture: last, height: 1.0, derivative: Derivative::Kernel, curvature: true });
    let (green_down, strength, tangents) = (false, 1.0, Tangents::Uv);
    detail.normal_map = Some(NormalMap { texture: last, green_down, strength, tangents });
    place_triangle(&mut scene, lamp, 1);
    for kind in [sphere(), disk(), quad()] {
        place_shape(&mut scene, lamp, kind);
    }
    scene.environment = surroundings(value);
    scene
}

fn textured() -> Scene {
    let mut scene = Scene::default();
    let bytes = || Texels::Rgba8(vec![[9, 99, 200, 255]; 2]);
    let srgb = texture(&mut scene, bytes(), ColorSpace::Srgb);
    let linear = texture(&mut scene, bytes(), ColorSpace::Linear);
    let half = texture(&mut scene, Texels::Rgba16(vec![[9, 99, 2000, 65535]; 2]), ColorSpace::Linear);
    let float = texture(&mut scene, Texels::RgbaF32(vec![[0.5, 2.0, 3.0, 1.0]; 2]), ColorSpace::Linear);
    let shade = Surface::diffuse(Value::Texture(srgb));
    let lamp = material(&mut scene, shade, Some(Value::Texture(half)));
    let phong = Surface::phong(Value::Texture(linear), Value::Texture(half), Value::Texture(float));
    let phong = material(&mut scene, phong, None);
    let metal = Conductor {
        reflectance: Value::Texture(srgb),
        fresnel: Fresnel::Exact,
        roughness: Roughness { u: Value::Texture(linear), v: Value::Constant(0.5), squared: true },
    };
    let metal = material(&mut scene, Surface::Conductor(metal), None);
    let index = Fresnel::Index { eta: Value::Texture(srgb), k: Value::Texture(half) };
    let roughness = Roughness::alpha(0.1);
    let gold = Conductor { reflectance: constant(1.0), fresnel: index, roughness };
    let gold = material(&mut scene, Surface::Conductor(gold), None);
    place_shape(&mut scene, gold, sphere());
    let ior = Value::Texture(float);
    let glass = Dielectric { ior, roughness, abbe: Some(30.0), absorption: Vec3::ONE, thin: false };
    let glass = material(&mut scene, Surface::Dielectric(glass), None);
    place_shape(&mut scene, glass, sphere());
    place_triangle(&mut scene, lamp, 1);
    place_triangle(&mut scene, phong, 2);
    place_shape(&mut scene, metal, disk());
    place_shape(&mut scene, lamp, quad());
    scene.environment = surroundings(Value::Texture(float));
    scene.render.sampler = Sampler::Regular;
    scene.film.filter.kind = FilterKind::Tent;
    scene
}

/// Lights with textures, by every way to look one up, and one that has none.
fn slides() -> Scene {
    let mut scene = plain();
    let handle = texture(&mut scene, Texels::RgbaF32(vec![[0.5, 2.0, 3.0, 1.0]; 2]), ColorSpace::Linear);
    let Texture::Image(image) = &mut scene.textures[handle] else { return scene };
    image.wrap = [Wrap::Octahedral; 2];
    let (position, fov_axis, mapping) = (Vec3::Y, FovAxis::Smaller, DirectionMapping::EqualArea);
    let kinds = [
        LightKind::Point { position, mapping },
        LightKind::Point { position, mapping: DirectionMapping::Equirectangular },
        LightKind::spot(position, 30.0, 5.0),
        LightKind::Projection { position, fov: 30.0, fov_axis, aspect: 2.0 },
        LightKind::distant(0.0),
    ];
    scene.lights.extend(kinds.map(|kind| Light::new(kind, Value::Texture(handle))));
    scene.environment = surroundings(Value::Texture(handle)).map(|around| Environment { mapping, ..around });
    scene
}

/// Scenes that together switch every feature on and off.
pub fn scenes() -> Vec<(&'static str, Scene)> {
    let mut all = vec![
        ("empty", Scene::default()),
        ("one triangle and a point light", plain()),
        ("shapes, instances, area lights, a lens", shapes()),
        ("tubes, parts and patches that shine", curved()),
        ("glass, metal, Phong, a constant environment behind a transparent film", lobes()),
        ("textures everywhere", textured()),
        ("smooth coats", smooth_coats()),
        ("rough coats with textures, and paper", rough_coats()),
        ("a principled material", bare()),
        ("principled materials and mixes", layers()),
        ("every kind of texture", trees()),
        ("motion", moving()),
        ("fronts without backs", fronts()),
        ("colours of vertices", corners(true, false)),
        ("a second set of texture coordinates", corners(false, true)),
        ("colours and a second set", corners(true, true)),
        ("lights with textures", slides()),
    ];
    all.extend(cameras());
    all
}
