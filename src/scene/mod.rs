//! The description of a picture: what a scene file says, in plain values. No GPU type is in here.
//!
//! World space is right-handed with y up; lengths are in scene units; angles in degrees; colours are
//! linear Rec. 709 RGB.

mod bsdf;
mod camera;
mod detail;
mod displacement;
mod exposure;
mod film;
mod geometry;
mod input;
mod light;
mod material;
mod patch;
mod punctual;
mod quadric;
mod store;
mod subdivide;
mod texture;
mod unit;

pub use bsdf::{BSDFS, Bsdf, BsdfKind};
pub(crate) use camera::LINES;
pub use camera::{
    Aperture, Camera, FisheyeMapping, Focus, FovAxis, Lens, LensCamera, LensInterface, LensSystem, Measure,
    Opening, Paraxial, Perspective, Projection, Pupil, Stand, Stop, half_height,
};
pub use detail::{Bump, Derivative, Detail, NormalMap, Opacity, Sides, Tangents};
pub use displacement::{Displacement, DisplacementDirection, EdgeLimit};
pub use exposure::{Exposure, Meter, Shot, ToneCurve};
pub use film::{Film, Filter, FilterKind, MAX_SAMPLES, MAX_SIDE, Rect, Render, Sampler};
pub use geometry::{Instance, Mesh, MeshPart, Shape, ShapeKind};
pub use input::{InputColor, InputNumber};
pub(crate) use light::half_frustum;
pub use light::{DirectionMapping, Environment, Light, LightKind, Strength, facing, facing_upright};
pub use material::{
    CoatedConductor, CoatedDiffuse, Conductor, Dielectric, Emission, Fresnel, Interface, Material, Mix,
    Principled, Roughness, Surface,
};
pub use patch::Patch;
pub use punctual::{PUNCTUAL_LIGHTS, Punctual, PunctualKind};
pub use quadric::{Extent, Quadric};
pub use store::{Handle, Store};
pub use texture::glsl;
pub use texture::{
    Brick, Channel, ColorSpace, Coordinates, Dots, GlslTexture, Gradient, Image, ImageTexture, Mapping,
    MappingKind, MappingSpace, Metric, Noise, NoiseSum, Parameter, PatternSpace, Perlin, PerlinVariant,
    Spread, StackTexture, TexelFilter, Texels, Texture, UvTransform, Value, ValueNoise, VeinKind, Veins,
    Warp, WorleyFeature, Wrap,
};
pub(crate) use unit::{is_unit, unit};

/// A whole scene. The handles in it index the [`Store`]s of the same scene.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Size, filter and encoding of the picture.
    pub film: Film,
    /// Samples, depth and sampler.
    pub render: Render,
    /// The camera.
    pub camera: Camera,
    /// Pictures that textures read.
    pub images: Store<Image>,
    /// Textures.
    pub textures: Store<Texture>,
    /// Materials.
    pub materials: Store<Material>,
    /// Triangle meshes, each in its own object space.
    pub meshes: Store<Mesh>,
    /// Spheres, disks, quads, tubes and patches.
    pub shapes: Vec<Shape>,
    /// Meshes placed in the world.
    pub instances: Vec<Instance>,
    /// Lights without a surface. Surfaces shine by the emission of their material.
    pub lights: Vec<Light>,
    /// What rays see that leave the scene.
    pub environment: Option<Environment>,
}
