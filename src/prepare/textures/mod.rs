//! Texture trees to GLSL and records.
//!
//! A texture is named in the kernels by a reference: the shape of its tree in the upper 8 bits, the word of its record in
//! the lower 24. Textures of one shape share one generated function; what differs between them is read from their records,
//! so that changing a number compiles nothing. Trees of constants are folded, and equal trees have one record.

mod builder;
mod glsl;
mod image;
mod join;
mod mapping;
mod noise;
mod pattern;
mod range;
mod shape;
mod stack;
mod user;

use super::atlas::{Atlas, Layout};
use super::{Prepared, rows};
use crate::scene::{Handle, MappingKind, Scene, TexelFilter, Texture, Warp, Wrap};
use crate::{Error, Result};
use builder::{Builder, Node};
use glsl::glsl;
pub(super) use image::picture_mean;
use range::Range;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The textures of a scene as kernels read them.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedTextures {
    /// Words of the records.
    pub records: Vec<[u32; 4]>,
    /// Where the texels of pictures are.
    pub atlas: Atlas,
    /// The virtual file `generated/textures.glsl`.
    pub glsl: String,
    /// The reference of each texture, by its handle.
    pub references: Vec<u32>,
    /// Whether a value depends on the width of the pixel.
    pub footprint: bool,
    /// Whether one depends on the colours of vertices.
    pub vertex_color: bool,
    /// Whether one depends on the second set of texture coordinates.
    pub uv1: bool,
}

/// References of the textures of a scene, and how bright they are.
pub(super) struct References {
    references: Vec<u32>,
    ranges: Vec<Range>,
}

impl References {
    /// The reference of a texture.
    pub(super) fn reference(&self, handle: Handle<Texture>) -> u32 {
        self.references[handle.index()]
    }

    /// Mean of its values: over the picture, or over space.
    pub(super) fn mean(&self, handle: Handle<Texture>) -> f64 {
        self.ranges[handle.index()].mean
    }

    /// A bound of its values.
    pub(super) fn max(&self, handle: Handle<Texture>) -> f32 {
        self.ranges[handle.index()].max as f32
    }
}

/// Prepares the textures of a scene and nothing else, to ask for the values of some of them.
///
/// # Errors
///
/// When a texture is made of itself, or they are more than the kernels count.
pub fn prepare_textures(scene: &Scene, asked: &[Handle<Texture>]) -> Result<PreparedTextures> {
    let (textures, _) =
        build(scene, &[("texture_evaluate", asked.iter().copied().collect())], asked.to_vec())?;
    Ok(textures)
}

/// Fills `textures`, `atlas` and `texture_glsl`.
pub(super) fn prepare(scene: &Scene, out: &mut Prepared) -> Result<References> {
    let materials = || scene.materials.iter().map(|(_, _, material)| material);
    let maps = materials().filter_map(|material| Some(material.detail.normal_map?.texture));
    let seen = materials().flat_map(|material| material.textures()).chain(maps).collect();
    let (textures, references) = build(scene, &uses(scene), seen)?;
    out.features.footprint |= textures.footprint;
    (out.features.vertex_color, out.features.uv1) = (textures.vertex_color, textures.uv1);
    out.features.timed_textures = scene.textures.iter().any(|(_, _, texture)| sees_time(texture));
    (out.textures, out.atlas, out.texture_glsl) = (textures.records, textures.atlas, textures.glsl);
    Ok(references)
}

/// Whether a texture itself is a picture that is an octahedral map.
fn is_octahedral(texture: &Texture) -> bool {
    matches!(texture, Texture::Image(image) if image.wrap.contains(&Wrap::Octahedral))
}

/// Whether the values of a texture itself may depend on the time.
fn sees_time(texture: &Texture) -> bool {
    match texture {
        Texture::Noise(noise) => noise.perlin.dimensions == 4 && noise.w[1] != 0.0,
        Texture::Glsl(texture) => texture.source.contains("time"),
        _ => false,
    }
}

/// Whether the values of a texture itself may depend on the colours of vertices.
fn sees_vertex_color(texture: &Texture) -> bool {
    match texture {
        Texture::VertexColor(_) => true,
        Texture::Glsl(texture) => texture.source.contains("vertex_color"),
        _ => false,
    }
}

/// Whether they may depend on the second set of texture coordinates.
fn sees_uv1(texture: &Texture) -> bool {
    match texture {
        Texture::Mapped { mapping, .. } => mapping.kind == MappingKind::Uv1,
        Texture::Glsl(texture) => texture.source.contains("uv1"),
        _ => false,
    }
}

/// A use of textures: the function of the kernels that gives their values, and those that it is asked for.
type Use = (&'static str, BTreeSet<Handle<Texture>>);

/// `seen` are the textures of surfaces, where the width of a pixel is known.
fn build(scene: &Scene, uses: &[Use], seen: Vec<Handle<Texture>>) -> Result<(PreparedTextures, References)> {
    if let Some(handle) = Texture::without_end(&scene.textures) {
        return Err(Error::scene(Texture::endless(scene.textures.name(handle))));
    }
    let seen = with_inputs(scene, seen);
    let mut layout = Layout::default();
    let mut places = BTreeMap::new();
    let mut stacks = BTreeMap::new();
    for (handle, _, texture) in scene.textures.iter() {
        if let Texture::Image(texture) = texture {
            let pyramid = texture.filter == TexelFilter::Trilinear && seen.contains(&handle);
            places.insert(handle, layout.place(scene, texture, pyramid)?);
        }
        if let Texture::Stack(stack) = texture {
            stacks.insert(handle, layout.stack(scene, stack)?);
        }
    }
    let has_noise = scene.textures.iter().any(|(_, _, texture)| reads_noise(texture));
    // The kernels look for it at the start
    let words = if has_noise { noise::words().collect() } else { Vec::new() };
    let done = vec![None; scene.textures.len()];
    let mut builder = Builder {
        scene,
        atlas: layout.finish(),
        places,
        users: Vec::new(),
        stacks,
        shapes: Vec::new(),
        words,
        kept: HashMap::new(),
        done,
    };
    let mut references = References { references: Vec::new(), ranges: Vec::new() };
    let nodes: Vec<Node> = scene.textures.iter().map(|(handle, ..)| builder.node(handle)).collect();
    for node in &nodes {
        references.references.push(node.shape << 24 | node.at);
        references.ranges.push(node.range);
    }
    let roots = uses.iter().map(|(name, asked)| {
        let mut roots = vec![false; builder.shapes.len()];
        asked.iter().for_each(|handle| roots[nodes[handle.index()].shape as usize] = true);
        (*name, roots)
    });
    let roots: Vec<_> = roots.collect();
    let Builder { atlas, shapes, users, words, .. } = builder;
    if words.len() >= 1 << 24 || shapes.len() >= 255 {
        let (count, most) = (shapes.len(), 1 << 24);
        return Err(Error::scene(format!(
            "textures have {count} shapes and {} words of records",
            words.len()
        ))
        .help(format!("there may be 254 shapes and {most} words: use fewer textures")));
    }
    let textures = PreparedTextures {
        records: words,
        atlas,
        glsl: glsl(
            &shapes,
            &roots,
            &users,
            scene.textures.iter().any(|(_, _, texture)| is_octahedral(texture)),
        ),
        references: references.references.clone(),
        footprint: shapes.iter().any(|shape| shape.sees_footprint()),
        vertex_color: scene.textures.iter().any(|(_, _, texture)| sees_vertex_color(texture)),
        uv1: scene.textures.iter().any(|(_, _, texture)| sees_uv1(texture)),
    };
    Ok((textures, references))
}

/// Whether a texture needs the permutation of gradient noise.
fn reads_noise(texture: &Texture) -> bool {
    use Texture::{Dots, Glsl, Noise, Veins};
    matches!(texture, Noise(_) | Glsl(_) | Dots(_) | Veins(_) | Texture::Warp(Warp::Noise { .. }))
}

/// Some textures and all that they are made of.
fn with_inputs(scene: &Scene, mut open: Vec<Handle<Texture>>) -> BTreeSet<Handle<Texture>> {
    let mut found = BTreeSet::new();
    while let Some(handle) = open.pop() {
        if found.insert(handle) {
            open.extend(scene.textures[handle].inputs());
        }
    }
    found
}

/// What a scene asks of its textures. One that is asked for nothing and is no input of another is there to be evaluated.
fn uses(scene: &Scene) -> [Use; 3] {
    let materials = || scene.materials.iter().map(|(_, _, material)| material);
    let opacity: BTreeSet<_> = materials().flat_map(|material| material.detail.opacity.textures()).collect();
    let details = || materials().map(|material| &material.detail);
    let heights: BTreeSet<_> = details().filter_map(|detail| Some(detail.bump?.texture)).collect();
    let inputs: BTreeSet<_> = scene.textures.iter().flat_map(|(_, _, texture)| texture.inputs()).collect();
    let mut direct: BTreeSet<_> = scene.textures.iter().map(|(handle, ..)| handle).collect();
    direct.retain(|handle| ![&inputs, &opacity, &heights].iter().any(|other| other.contains(handle)));
    direct.extend(details().filter_map(|detail| Some(detail.normal_map?.texture)));
    direct.extend(materials().flat_map(|material| material.textures()));
    direct.extend(scene.environment.iter().filter_map(|environment| environment.texture()));
    direct.extend(scene.lights.iter().filter_map(|light| light.intensity.texture()));
    [("texture_evaluate", direct), ("texture_opacity", opacity), ("texture_height", heights)]
}
