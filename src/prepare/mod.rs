//! [`Scene`] → [`Prepared`]: trees, records, atlas, light tables and the GLSL of textures. No Vulkan in here.
//!
//! Deterministic: the same scene gives the same bytes with any number of threads.

mod alias;
mod atlas;
mod bounds;
pub mod bvh;
mod environment;
mod geometry;
mod lights;
mod materials;
mod medium;
mod textures;
mod variant;
mod wide;

pub use bounds::Bounds;
pub(crate) use environment::rows as environment_rows;
pub use variant::{Stage, defines, stack_size};
pub use wide::{Leaves, Tree};

use crate::Result;
use crate::layout::{
    EnvironmentCell, Face, Instance, Item, LIGHT_DISTANT, LIGHT_POINT, LIGHT_SPOT, Light, Material, Vertex,
};
use crate::scene::{Scene, Surface, Value};
use glam::Vec3;

/// Everything that the kernels need of a scene, as plain records in the order of the bindings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Prepared {
    /// Nodes, triangles and the numbers of instances: the items of all trees.
    pub tree: Vec<Item>,
    /// How many items are nodes.
    pub node_count: usize,
    /// How many items are triangles.
    pub triangle_count: usize,
    /// Vertices of triangles, each mesh's in its own order.
    pub faces: Vec<Face>,
    /// Shading data of vertices.
    pub vertices: Vec<Vertex>,
    /// Shapes and meshes in the world.
    pub instances: Vec<Instance>,
    /// Materials, indexed as in the scene.
    pub materials: Vec<Material>,
    /// Words of the texture records.
    pub textures: Vec<[u32; 4]>,
    /// Words of the atlas pages.
    pub texels: Vec<[u32; 4]>,
    /// The table of lights.
    pub lights: Vec<Light>,
    /// Importance table of an environment image, row by row; v grows with the row.
    pub environment: Vec<EnvironmentCell>,
    /// Columns and rows of that table.
    pub environment_size: [u32; 2],
    /// Texture reference of the environment, or NONE.
    pub environment_texture: u32,
    /// Chance of choosing the environment when a light is chosen.
    pub environment_chance: f32,
    /// Where rays start: a reference, or NONE in an empty scene.
    pub root: u32,
    /// Entries of the traversal stack that no ray exceeds.
    pub stack_entries: u32,
    /// GLSL of the texture trees: the virtual file `generated/textures.glsl`.
    pub texture_glsl: String,
    /// Material of the glass around the camera, or NONE.
    pub camera_medium: u32,
    /// What the scene uses: decides the variants of the kernels.
    pub features: Features,
    /// log₂ of the unit of the sums of radiance.
    pub radiance_exponent: i32,
    /// log₂ of the unit of the sums of depth.
    pub depth_exponent: i32,
    /// Bounds of everything.
    pub bounds: Bounds,
    /// Surface area cost of the trees, by triangles (see [`Tree::cost`]); of the largest.
    pub bvh_cost: f32,
    /// Seconds that building the trees took. Not part of the bytes that must repeat.
    pub bvh_seconds: Seconds,
}

impl Prepared {
    /// Bytes of all records: what the scene takes on the device, but for the rounding of its memory.
    pub fn bytes(&self) -> u64 {
        let sizes = [
            size_of_val(self.tree.as_slice()),
            size_of_val(self.faces.as_slice()),
            size_of_val(self.vertices.as_slice()),
            size_of_val(self.instances.as_slice()),
            size_of_val(self.materials.as_slice()),
            size_of_val(self.textures.as_slice()),
            size_of_val(self.texels.as_slice()),
            size_of_val(self.lights.as_slice()),
            size_of_val(self.environment.as_slice()),
        ];
        sizes.iter().map(|&bytes| bytes as u64).sum()
    }
}

/// A duration that is equal to every other, so that [`Prepared`] can be compared.
#[derive(Debug, Clone, Copy, Default)]
pub struct Seconds(pub f64);

impl PartialEq for Seconds {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// What a scene uses. Code for what it does not use is left out of its kernels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Features {
    /// A tree over instances, not only triangles in world space.
    pub instances: bool,
    /// Spheres.
    pub spheres: bool,
    /// Disks.
    pub disks: bool,
    /// Bit set of the `MATERIAL_…` kinds.
    pub material_kinds: u32,
    /// Bit set of the `LIGHT_…` kinds.
    pub light_kinds: u32,
    /// An environment that is not black.
    pub environment: bool,
    /// An environment from a picture.
    pub environment_image: bool,
    /// A colour that a texture drives.
    pub textured_color: bool,
    /// A specular colour that a texture drives.
    pub textured_specular: bool,
    /// An exponent that a texture drives.
    pub textured_exponent: bool,
    /// A roughness that a texture drives.
    pub textured_alpha: bool,
    /// An emission that a texture drives.
    pub textured_emission: bool,
    /// Glass that absorbs.
    pub medium: bool,
    /// A lens that is no pinhole.
    pub lens: bool,
}

/// Prepares a scene.
///
/// # Errors
///
/// When the scene is too large for 32-bit floats or for the sizes that the kernels count in.
pub fn prepare(scene: &Scene) -> Result<Prepared> {
    let mut out = Prepared {
        root: crate::layout::NONE,
        environment_texture: crate::layout::NONE,
        camera_medium: crate::layout::NONE,
        ..Prepared::default()
    };
    let textures = textures::prepare(scene, &mut out)?;
    materials::prepare(scene, &textures, &mut out);
    let placed = geometry::prepare(scene, &mut out)?;
    lights::prepare(scene, &textures, placed, &mut out);
    environment::prepare(scene, &textures, &mut out);
    if out.features.medium {
        out.camera_medium = medium::around_camera(scene);
    }
    out.features.lens = scene.camera.lens.is_some();
    choose_units(scene, &textures, &mut out);
    Ok(out)
}

/// Units of the fixed-point sums: 2³⁰ steps up to the brightest thing, and a sample may be 2⁸ times as bright; 2²⁴ steps
/// to the far end of the scene.
fn choose_units(scene: &Scene, textures: &textures::References, out: &mut Prepared) {
    let of = |value: &Value<Vec3>| match value {
        Value::Constant(color) => color.max_element(),
        Value::Texture(texture) => textures.max(*texture),
    };
    let environment = scene.environment.as_ref().map_or(0.0, |e| of(&e.radiance) * e.scale);
    let surfaces = scene.materials.iter().flat_map(|(_, _, material)| {
        let unlit = match &material.surface {
            Surface::Unlit { color } => of(color),
            _ => 0.0,
        };
        [unlit, material.emission.as_ref().map_or(0.0, |emission| of(&emission.radiance))]
    });
    let size = out.bounds.diagonal().max(f32::MIN_POSITIVE);
    let lights = out.lights.iter().map(|light| punctual_radiance(light, scene.camera.position, size));
    let brightest = lights.chain(surfaces).fold(environment.max(1.0), f32::max);
    out.radiance_exponent = (brightest.log2().ceil().min(100.0) as i32 - 30).clamp(-60, 60);
    let size = out.bounds.diagonal();
    let away = if size > 0.0 {
        scene.camera.position.distance(0.5 * (out.bounds.min + out.bounds.max))
    } else {
        0.0
    };
    let far = (away + size).clamp(1e-6, f32::MAX);
    out.depth_exponent = (far.log2().ceil() as i32 - 24).clamp(-60, 60);
}

/// What a light without extent brings to a sample near it. Near is a quarter of the distance at which the camera is
/// likely to look: as far from the light as the camera is, but between 1/64 and 1/8 of the scene. A sample stands for all
/// lights, so a light that is rarely chosen counts for more. 0 for surfaces, whose samples are weighed against the BSDF
/// and stay near their radiance.
fn punctual_radiance(light: &Light, camera: Vec3, size: f32) -> f32 {
    let all = Vec3::from(light.radiance).max_element() / light.chance.max(1e-9);
    match light.kind {
        LIGHT_POINT | LIGHT_SPOT => {
            let distance = 0.25 * camera.distance(light.position.into()).clamp(size / 64.0, size / 8.0);
            all / (distance * distance)
        }
        LIGHT_DISTANT => all,
        _ => 0.0,
    }
}
