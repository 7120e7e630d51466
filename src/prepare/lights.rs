//! The table of lights, chosen by power.

use super::geometry::{Placed, Source};
use super::textures::References;
use super::triangles::{mirrors, part_materials};
use super::{Bounds, Prepared, alias, punctual};
use crate::layout::{
    INSTANCE_MESH, LIGHT_DISK, LIGHT_QUAD, LIGHT_SPHERE, LIGHT_TRIANGLE, LIGHT_TURNED, Light, NONE,
};
use crate::scene::{self, Emission, Handle, Mesh, Scene, ShapeKind, Value};
use glam::{Affine3A, Vec2, Vec3};
use std::f64::consts::PI;

/// A light before the table is built: its record and its power in watts; none for light from infinity. Powers of lights
/// that floats can hold may be beyond floats.
pub(super) struct Entry {
    pub(super) light: Light,
    pub(super) power: Option<f64>,
}

/// Where the camera is, at both ends of its motion.
pub(super) fn camera_positions(scene: &Scene) -> impl Iterator<Item = Vec3> {
    std::iter::once(scene.camera.position).chain(scene.camera.at_close.map(|stand| stand.position))
}

/// The box around all that is lit: the camera, which sees lamps, and what does not shine all over.
pub(super) fn receivers(scene: &Scene, placed: &[Placed]) -> Bounds {
    let dark = |material| scene.materials[material].emission.is_none();
    let is_lit = |place: &&Placed| match place.source {
        Source::Shape(i) => dark(scene.shapes[i].material),
        Source::Mesh(i) => {
            let instance = &scene.instances[i];
            let parts = &scene.meshes[instance.mesh].parts;
            parts.iter().any(|part| dark(part.material.unwrap_or(instance.material)))
                || parts.is_empty() && dark(instance.material)
        }
    };
    let mut bounds = Bounds::default();
    camera_positions(scene).for_each(|position| bounds.add(position));
    placed.iter().filter(is_lit).for_each(|place| bounds.join(&place.bounds));
    bounds
}

/// What a lamp with a surface brings at most to a white surface among `receivers`, as radiance: its own, or by the solid
/// angle that it fills there.
fn brought(entry: &Entry, receivers: &Bounds) -> f64 {
    let light = &entry.light;
    let axis = match light.kind {
        LIGHT_SPHERE => Vec3::new(light.uv0[0], light.uv0[1], light.uv1[0]),
        LIGHT_QUAD | LIGHT_DISK | LIGHT_TRIANGLE => Vec3::ZERO,
        _ => return 0.0,
    };
    let extent = axis.length() + Vec3::from(light.edge_u).length() + Vec3::from(light.edge_v).length();
    let distance = f64::from((receivers.distance(light.position.into()) - extent).max(0.0));
    let least = (PI * distance * distance).max(f64::from(light.b)).max(f64::MIN_POSITIVE);
    entry.power.unwrap_or(0.0) / PI / least
}

/// What a lamp brings to a path that finds it by chance: its radiance.
fn whole(entry: &Entry) -> f64 {
    entry.power.unwrap_or(0.0) / PI / f64::from(entry.light.b).max(f64::MIN_POSITIVE)
}

/// Fills `lights`, the light of each instance, and the chance of the environment. Gives the radiance that lamps with a
/// surface bring to a white surface among `receivers`, at most.
///
/// Light from infinity has no power that compares with that of lamps: each distant light and the environment get the same
/// chance as all lamps together (pbrt-v4, section 12.6.3, treats infinite lights alike).
///
/// Lamps that move are not in the table: paths find them by chance, and count all of what they send out.
pub(super) fn prepare(
    scene: &Scene,
    textures: &References,
    placed: Vec<Placed>,
    receivers: &Bounds,
    out: &mut Prepared,
) -> f64 {
    let (mut entries, mut found) = (Vec::new(), Vec::new());
    for place in placed {
        let first = entries.len();
        let entries = if place.moves { &mut found } else { &mut entries };
        match place.source {
            Source::Shape(i) => push_shape(scene, i, &place.world_from_object, textures, entries),
            Source::Mesh(i) => push_mesh(scene, i, &place, textures, out, entries),
        }
        if !place.moves && entries.len() > first {
            out.instances[place.instance as usize].light = first as u32;
        }
    }
    let found = found.iter().map(whole).fold(0.0, f64::max);
    entries.extend(scene.lights.iter().map(|light| punctual::entry(scene, textures, light)));
    punctual::note(scene, &mut out.features);
    let environment = scene.environment.is_some();
    let lamps = entries.iter().filter_map(|entry| entry.power).sum::<f64>();
    let distant = entries.iter().filter(|entry| entry.power.is_none()).count();
    let share = 1.0 / (distant + usize::from(environment) + usize::from(lamps > 0.0)).max(1) as f64;
    let weight =
        |entry: &Entry| entry.power.map_or(share, |power| share * (power / lamps.max(f64::MIN_POSITIVE)));
    let weights: Vec<f64> = entries.iter().map(weight).collect();
    let useful = weights.iter().any(|weight| *weight > 0.0);
    out.features.environment = environment;
    out.environment_chance = match (environment, useful) {
        (false, _) => 0.0,
        (true, false) => 1.0,
        (true, true) => share as f32,
    };
    if !useful {
        for instance in &mut out.instances {
            instance.light = NONE;
        }
        return found;
    }
    let brought = entries.iter().map(|entry| brought(entry, receivers)).sum::<f64>().max(found);
    for (entry, slot) in entries.into_iter().zip(alias::table(&weights)) {
        out.features.light_kinds |= 1 << entry.light.kind;
        let chance = slot.chance * (1.0 - out.environment_chance);
        out.lights.push(Light { chance, accept: slot.accept, alias: slot.alias, ..entry.light });
    }
    brought
}

/// Mean of a colour.
pub(super) fn mean(c: Vec3) -> f64 {
    c.as_dvec3().element_sum() / 3.0
}

fn surface_light(
    scene: &Scene,
    emission: &Emission,
    material: Handle<scene::Material>,
    textures: &References,
    kind: u32,
) -> (Light, f64) {
    let two_sided = scene.materials[material].shines_behind();
    let (radiance, texture, brightness) = match emission.radiance {
        Value::Constant(c) => (c, NONE, mean(c)),
        Value::Texture(handle) => (Vec3::ONE, textures.reference(handle), textures.mean(handle)),
    };
    let sides = if two_sided { 2.0 } else { 1.0 };
    let light = Light {
        kind,
        radiance: radiance.to_array(),
        texture,
        two_sided: u32::from(two_sided),
        material: material.index() as u32,
        extra: NONE,
        ..Light::default()
    };
    (light, sides * PI * brightness)
}

fn push_shape(scene: &Scene, index: usize, map: &Affine3A, textures: &References, entries: &mut Vec<Entry>) {
    let shape = &scene.shapes[index];
    let Some(emission) = &scene.materials[shape.material].emission else { return };
    let kind = match shape.kind {
        ShapeKind::Sphere { .. } => LIGHT_SPHERE,
        ShapeKind::Disk { .. } => LIGHT_DISK,
        ShapeKind::Quad { .. } => LIGHT_QUAD,
    };
    let (mut light, exitance) = surface_light(scene, emission, shape.material, textures, kind);
    light.position = Vec3::from(map.translation).to_array();
    let m = &map.matrix3;
    let (x, y, z) = (Vec3::from(m.x_axis), Vec3::from(m.y_axis), Vec3::from(m.z_axis));
    (light.edge_u, light.edge_v) = (x.to_array(), y.to_array());
    // Front of a mirrored shape: its normal is that of the object, not of the cross product in the world.
    light.a = if mirrors(map) { -1.0 } else { 1.0 };
    if let ShapeKind::Sphere { .. } = shape.kind {
        light.a = if is_sphere(x, y, z) { x.length() } else { 0.0 };
        (light.uv0, light.uv1) = ([z.x, z.y], [z.z, 0.0]);
    }
    let (x, y, z) = (x.as_dvec3(), y.as_dvec3(), z.as_dvec3());
    let area = match shape.kind {
        // Of a sphere of the same volume: for an ellipsoid a good guess, and only its power depends on it.
        ShapeKind::Sphere { .. } => 4.0 * PI * x.cross(y).dot(z).abs().powf(2.0 / 3.0),
        ShapeKind::Disk { .. } => PI * x.cross(y).length(),
        ShapeKind::Quad { .. } => x.cross(y).length(),
    };
    light.b = area as f32;
    entries.push(Entry { light, power: Some(exitance * area) });
}

/// Whether the axes of a mapped sphere are as long as one another, and at right angles, but for rounding.
fn is_sphere(x: Vec3, y: Vec3, z: Vec3) -> bool {
    let (size, least) = (x.length_squared(), 1e-5 * x.length_squared());
    let equal = |a: f32, b: f32| (a - b).abs() <= least;
    equal(y.length_squared(), size)
        && equal(z.length_squared(), size)
        && [x.dot(y), y.dot(z), z.dot(x)].into_iter().all(|cosine| equal(cosine, 0.0))
}

/// One light a triangle, in the order of the mesh; those that do not shine keep their place with no power.
fn push_mesh(
    scene: &Scene,
    index: usize,
    place: &Placed,
    textures: &References,
    out: &Prepared,
    entries: &mut Vec<Entry>,
) {
    let map = &place.world_from_object;
    let instance = &scene.instances[index];
    let mesh = &scene.meshes[instance.mesh];
    let shines = |material| scene.materials[material].emission.is_some();
    if !shines(instance.material) && !mesh.parts.iter().filter_map(|part| part.material).any(shines) {
        return;
    }
    let materials = part_materials(mesh);
    let record = &out.instances[place.instance as usize];
    // A mesh in its own space has its corners in its own order, and a light as it is in the world
    let turned = if record.kind == INSTANCE_MESH && mirrors(map) { LIGHT_TURNED } else { 0 };
    let extra = |i: usize| {
        let face =
            if record.first_face == NONE { None } else { out.faces.get(record.first_face as usize + i) };
        face.map_or(NONE, |face| if face.extra == NONE { NONE } else { face.extra | turned })
    };
    for i in 0..mesh.triangles.len() {
        let material = materials.get(i).copied().flatten().unwrap_or(instance.material);
        entries.push(match &scene.materials[material].emission {
            Some(emission) => {
                let mut entry = triangle(scene, mesh, i, map, (emission, material), textures);
                entry.light.extra = extra(i);
                entry
            }
            None => Entry {
                light: Light { kind: LIGHT_TRIANGLE, texture: NONE, ..Light::default() },
                power: Some(0.0),
            },
        });
    }
}

fn triangle(
    scene: &Scene,
    mesh: &Mesh,
    index: usize,
    map: &Affine3A,
    (emission, material): (&Emission, Handle<scene::Material>),
    textures: &References,
) -> Entry {
    let (mut light, exitance) = surface_light(scene, emission, material, textures, LIGHT_TRIANGLE);
    let mut corners = mesh.triangles[index];
    let mut default = [Vec2::ZERO, Vec2::X, Vec2::ONE];
    if mirrors(map) {
        corners.swap(1, 2);
        default.swap(1, 2);
    }
    let [a, b, c] = corners.map(|v| map.transform_point3(mesh.positions[v as usize]));
    let uv = |k: usize| mesh.uvs.get(corners[k] as usize).copied().unwrap_or(default[k]);
    light.position = a.to_array();
    (light.edge_u, light.edge_v) = ((b - a).to_array(), (c - a).to_array());
    let area = 0.5 * (b - a).as_dvec3().cross((c - a).as_dvec3()).length();
    light.b = area as f32;
    light.uv0 = uv(0).to_array();
    (light.uv1, light.uv2) = ((uv(1) - uv(0)).to_array(), (uv(2) - uv(0)).to_array());
    Entry { power: Some(exitance * area), light }
}

#[cfg(test)]
#[path = "lights_tests.rs"]
mod tests;
