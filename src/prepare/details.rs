//! What materials do to surfaces, to records.

use super::Prepared;
use super::textures::References;
use crate::layout::{
    DERIVATIVE_BILINEAR, DERIVATIVE_CENTRAL, DERIVATIVE_FORWARD, DERIVATIVE_KERNEL, DETAIL_CURVATURE,
    DETAIL_FRONT_ONLY, DETAIL_GREEN_DOWN, DETAIL_HEIGHT_UV1, DETAIL_NORMAL_UV1, DETAIL_SOFT_TERMINATOR,
    DETAIL_VERTEX_TANGENTS, DETAIL_VISIBLE, Detail, NONE, PRIMITIVE_FRONT_ONLY, PRIMITIVE_LETS_THROUGH,
};
use crate::scene::{
    self, Bump, Derivative, Handle, Image, Instance, MappingKind, Material, Mesh, NormalMap, Scene, Sides,
    Tangents, Texture, Value,
};
use glam::{DAffine2, DMat2, DVec2, Vec3};

/// Step of forward differences in u and v (pbrt-v4, section 10.5.3).
const FORWARD_STEP: f64 = 0.0005;

/// Fills `details`, and the features that they switch on.
pub(super) fn prepare(scene: &Scene, textures: &References, out: &mut Prepared) {
    for (_, _, material) in scene.materials.iter() {
        let detail = &material.detail;
        let opacity = &detail.opacity;
        out.features.opacity |= !opacity.is_whole();
        out.features.front_only |= detail.sides == Sides::Front;
        out.features.filter |= !opacity.is_whole() && opacity.filter != Value::Constant(Vec3::ONE);
        out.features.bump |= detail.bump.is_some();
        out.features.normal_map |= detail.normal_map.is_some();
        let record = record(scene, detail, textures);
        out.features.footprint |= detail.bump.is_some() && record.derivative == DERIVATIVE_CENTRAL;
        out.details.push(record);
    }
    out.features.opacity |= out.features.front_only && sides_are_mixed(scene);
}

/// Whether a shape has a front alone, or a mesh in one place and not in another: there the triangles cannot tell.
fn sides_are_mixed(scene: &Scene) -> bool {
    let sides = |material: Handle<Material>| scene.materials[material].detail.sides;
    let mut of_meshes = vec![None; scene.meshes.len()];
    let mut mixed = |instance: &Instance| {
        let own = sides(instance.material);
        *of_meshes[instance.mesh.index()].get_or_insert(own) != own
    };
    scene.shapes.iter().any(|shape| sides(shape.material) == Sides::Front)
        || scene.instances.iter().any(&mut mixed)
}

fn record(scene: &Scene, detail: &scene::Detail, textures: &References) -> Detail {
    let opacity = &detail.opacity;
    let (value, opacity_texture) = match opacity.value {
        Value::Constant(value) => (value, NONE),
        Value::Texture(handle) => (1.0, textures.reference(handle)),
    };
    let (filter, filter_texture) = match opacity.filter {
        Value::Constant(color) => (color, NONE),
        Value::Texture(handle) => (Vec3::ONE, textures.reference(handle)),
    };
    let flag = |on: bool, flag: u32| if on { flag } else { 0 };
    let mut record = Detail {
        opacity: value,
        opacity_texture,
        cutoff: opacity.cutoff.unwrap_or(-1.0),
        filter_texture,
        filter_color: filter.to_array(),
        flags: flag(detail.soften_terminator, DETAIL_SOFT_TERMINATOR)
            | flag(detail.keep_visible, DETAIL_VISIBLE)
            | flag(detail.sides == Sides::Front, DETAIL_FRONT_ONLY),
        height_texture: NONE,
        normal_texture: NONE,
        step_x: [1.0, 0.0],
        step_y: [0.0, 1.0],
        ..Detail::default()
    };
    if let Some(Bump { texture, height, derivative, curvature }) = detail.bump {
        record.height_texture = textures.reference(texture);
        record.height = height;
        record.flags |= flag(curvature, DETAIL_CURVATURE);
        let steps = steps(scene, texture, derivative);
        record.derivative = steps.rule;
        record.flags |= flag(is_on_uv1(scene, texture), DETAIL_HEIGHT_UV1);
        let inverse = steps.texels_from_uv.inverse().matrix2;
        record.step_x = inverse.x_axis.as_vec2().to_array();
        record.step_y = inverse.y_axis.as_vec2().to_array();
        record.steps_at_zero = steps.texels_from_uv.translation.as_vec2().to_array();
    }
    if let Some(NormalMap { texture, green_down, strength, tangents }) = detail.normal_map {
        record.normal_texture = textures.reference(texture);
        record.strength = strength;
        record.flags |= flag(green_down, DETAIL_GREEN_DOWN);
        record.flags |= flag(is_on_uv1(scene, texture), DETAIL_NORMAL_UV1);
        record.flags |= flag(tangents == Tangents::MikkTSpace, DETAIL_VERTEX_TANGENTS);
    }
    record
}

/// The steps of a derivative: from uv to numbers that are whole at the centres of texels, x rightward and y upward.
struct Steps {
    rule: u32,
    texels_from_uv: DAffine2,
}

fn steps(scene: &Scene, texture: Handle<Texture>, derivative: Derivative) -> Steps {
    let picture = picture(scene, texture);
    let rule = match derivative {
        Derivative::Forward => DERIVATIVE_FORWARD,
        Derivative::Kernel if picture.is_some() => DERIVATIVE_KERNEL,
        Derivative::Analytic if picture.is_some() => DERIVATIVE_BILINEAR,
        _ => DERIVATIVE_CENTRAL,
    };
    let forward = DAffine2::from_scale(DVec2::splat(1.0 / FORWARD_STEP));
    let texels_from_uv = match picture {
        Some(map) if rule != DERIVATIVE_FORWARD => map,
        _ => forward,
    };
    Steps { rule, texels_from_uv }
}

/// From uv to the texels of the first picture of a texture.
fn picture(scene: &Scene, texture: Handle<Texture>) -> Option<DAffine2> {
    let image = match &scene.textures[texture] {
        Texture::Image(image) => image,
        other => return other.inputs().find_map(|input| picture(scene, input)),
    };
    let Image { width, height, .. } = &scene.images[image.image];
    let size = DVec2::new(f64::from(*width), f64::from(*height));
    let uv = image.uv.matrix();
    let linear = DMat2::from_diagonal(size) * uv.matrix2.as_dmat2();
    let map = DAffine2::from_mat2_translation(linear, size * uv.translation.as_dvec2() - 0.5);
    // A picture that is the same along one direction of uv has no texels along it
    (map.matrix2.determinant().abs() > 1e-12).then_some(map)
}

/// Whether the first picture of a texture is placed by the second set of texture coordinates.
pub(super) fn is_on_uv1(scene: &Scene, texture: Handle<Texture>) -> bool {
    fn first_picture(scene: &Scene, texture: Handle<Texture>) -> Option<bool> {
        let texture = &scene.textures[texture];
        let second = matches!(texture, Texture::Mapped { mapping, .. } if mapping.kind == MappingKind::Uv1);
        match texture {
            Texture::Image(_) => Some(false),
            _ => texture.inputs().find_map(|input| first_picture(scene, input)).map(|inner| inner || second),
        }
    }
    first_picture(scene, texture).unwrap_or(false)
}

/// What the numbers of the triangles of a mesh are marked with, when it is placed with some materials; empty when none is marked.
pub(super) fn marks(
    scene: &Scene,
    mesh: &Mesh,
    placed_with: impl IntoIterator<Item = Handle<Material>>,
) -> Vec<u32> {
    let mark = |material: Handle<Material>| {
        let detail = &scene.materials[material].detail;
        match detail.sides {
            _ if !detail.opacity.is_whole() => PRIMITIVE_LETS_THROUGH,
            Sides::Front => PRIMITIVE_FRONT_ONLY,
            Sides::Both => 0,
        }
    };
    let both = |a: u32, b: u32| if a == b { a } else { PRIMITIVE_LETS_THROUGH };
    let rest = placed_with.into_iter().map(mark).reduce(both).unwrap_or(0);
    let parts = mesh.parts.iter().filter_map(|part| part.material);
    if rest == 0 && parts.into_iter().all(|material| mark(material) == 0) {
        return Vec::new();
    }
    let own = super::triangles::part_materials(mesh);
    let of = |i: usize| own.get(i).copied().flatten().map_or(rest, mark);
    (0..mesh.triangles.len()).map(of).collect()
}
