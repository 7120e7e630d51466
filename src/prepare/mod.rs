//! [`Scene`] → [`Prepared`]: trees, records, atlas, light tables and the GLSL of textures. No Vulkan in here.
//!
//! Deterministic: the same scene gives the same bytes with any number of threads.

mod alias;
mod atlas;
mod bounds;
pub mod bvh;
mod corners;
mod details;
mod displace;
mod environment;
mod geometry;
mod interface;
mod kept;
pub mod lens;
mod lights;
mod materials;
mod medium;
mod meet;
mod menus;
mod motion;
mod pixel_filter;
mod places;
mod punctual;
mod shape_lights;
mod shapes;
mod tangents;
mod textures;
mod trees;
mod triangles;
mod units;
mod variant;
mod variants;
mod view;
mod wide;

pub use atlas::Atlas;
pub use bounds::Bounds;
pub use displace::{displace, displacing};
pub(crate) use environment::rows as environment_rows;
pub use kept::{Displaced, Kept};
pub use menus::generated;
pub use textures::{PreparedTextures, prepare_textures};
pub use trees::Trees;
pub use variant::{Stage, defines, stack_size};
pub use variants::{Variant, Variants, variants};
pub use view::{View, kernel_file};
pub use wide::{Leaves, Tree};

use crate::Result;
use crate::layout::{Detail, EnvironmentCell, Face, Instance, Item, Light, Material, Motion, Vertex};
use crate::scene::Scene;

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
    /// Words behind the faces: what only textures ask of the corners of triangles.
    pub corners: Vec<[u32; 4]>,
    /// Shading data of vertices.
    pub vertices: Vec<Vertex>,
    /// Shapes and meshes in the world.
    pub instances: Vec<Instance>,
    /// How those of them move that do, and the camera.
    pub motions: Vec<Motion>,
    /// Words behind them, of what else there is to know of parts of quadrics and of patches.
    pub shapes: Vec<[u32; 4]>,
    /// Word behind the instances with the motion of the camera, or NONE.
    pub camera_motion: u32,
    /// Materials, indexed as in the scene.
    pub materials: Vec<Material>,
    /// Words behind them: tables of interfaces.
    pub interfaces: Vec<[u32; 4]>,
    /// What they do to the surfaces themselves, indexed alike.
    pub details: Vec<Detail>,
    /// Words of the texture records.
    pub textures: Vec<[u32; 4]>,
    /// Where the texels of pictures are.
    pub atlas: Atlas,
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
    /// What the camera reads of its lens.
    pub lens: lens::LensTables,
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
            size_of_val(self.corners.as_slice()),
            size_of_val(self.vertices.as_slice()),
            size_of_val(self.instances.as_slice()),
            size_of_val(self.motions.as_slice()),
            size_of_val(self.shapes.as_slice()),
            size_of_val(self.materials.as_slice()),
            size_of_val(self.interfaces.as_slice()),
            size_of_val(self.details.as_slice()),
            size_of_val(self.textures.as_slice()),
            self.atlas.words() * size_of::<[u32; 4]>(),
            size_of_val(self.lights.as_slice()),
            size_of_val(self.environment.as_slice()),
            size_of_val(self.lens.words.as_slice()),
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
    /// Tubes, and parts of spheres and disks.
    pub parts: bool,
    /// Bilinear patches.
    pub patches: bool,
    /// Bit set of the `MATERIAL_…` kinds.
    pub material_kinds: u32,
    /// Bit set of the `LIGHT_…` kinds.
    pub light_kinds: u32,
    /// An environment that is not black.
    pub environment: bool,
    /// An environment from a picture.
    pub environment_image: bool,
    /// Its picture is an equal-area map.
    pub environment_equal_area: bool,
    /// A light without extent that has a texture.
    pub textured_lights: bool,
    /// One whose texture is an equal-area map of its directions.
    pub equal_area_lights: bool,
    /// Inputs of materials that a texture drives: two bits for each `INPUT_…`, for a colour or the first number, and for the
    /// second number.
    pub textured_inputs: u32,
    /// A roughness along ∂p/∂u that is not that across it.
    pub anisotropic: bool,
    /// Metal by its index of refraction.
    pub metal_index: bool,
    /// A principled material that lets light through.
    pub transmission: bool,
    /// A principled material with a coat.
    pub clearcoat: bool,
    /// A principled material with sheen.
    pub sheen: bool,
    /// How many mixes of materials are one in the other.
    pub mix_depth: u32,
    /// Surfaces that let rays through.
    pub opacity: bool,
    /// Triangles that are not there from behind.
    pub front_only: bool,
    /// Surfaces that colour what they let through.
    pub filter: bool,
    /// Bumps.
    pub bump: bool,
    /// Normals from pictures.
    pub normal_map: bool,
    /// Glass that absorbs.
    pub medium: bool,
    /// Some glass bends each colour in its own way.
    pub dispersion: bool,
    /// A texture that depends on the width of a pixel.
    pub footprint: bool,
    /// A texture that depends on the colours of vertices.
    pub vertex_color: bool,
    /// A texture that depends on the second set of texture coordinates.
    pub uv1: bool,
    /// A texture that depends on the time.
    pub timed_textures: bool,
    /// Things that move.
    pub moves: bool,
    /// A camera that moves.
    pub camera_moves: bool,
}

/// Prepares a scene.
///
/// # Errors
///
/// When the scene is too large for 32-bit floats or for the sizes that the kernels count in.
pub fn prepare(scene: &Scene) -> Result<Prepared> {
    prepare_again(scene, &mut Trees::default())
}

/// The same, with the trees that the scene before had.
///
/// # Errors
///
/// As [`prepare`].
pub fn prepare_again(scene: &Scene, trees: &mut Trees) -> Result<Prepared> {
    let mut out = Prepared {
        root: crate::layout::NONE,
        environment_texture: crate::layout::NONE,
        camera_medium: crate::layout::NONE,
        camera_motion: crate::layout::NONE,
        ..Prepared::default()
    };
    let textures = textures::prepare(scene, &mut out)?;
    materials::prepare(scene, &textures, &mut out)?;
    details::prepare(scene, &textures, &mut out);
    let placed = geometry::prepare(scene, trees, &mut out)?;
    let receivers = lights::receivers(scene, &placed);
    let lamps = lights::prepare(scene, &textures, placed, &receivers, &mut out);
    environment::prepare(scene, &textures, &mut out);
    if out.features.medium {
        out.camera_medium = medium::around_camera(scene);
    }
    lens::prepare(scene, &mut out)?;
    pixel_filter::prepare(&scene.film.filter, &mut out.lens)?;
    units::choose(scene, &textures, &receivers, lamps, &mut out);
    Ok(out)
}

/// The rows of a map as kernels read them.
fn rows(map: &glam::DAffine3) -> [[f32; 4]; 3] {
    let (linear, t) = (map.matrix3.transpose(), map.translation);
    [linear.x_axis.extend(t.x), linear.y_axis.extend(t.y), linear.z_axis.extend(t.z)]
        .map(|row| row.as_vec4().to_array())
}
