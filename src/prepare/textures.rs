//! Texture trees to GLSL and records.
//!
//! A texture is named in the kernels by a reference: the shape of its tree in the upper 8 bits, the word of its record in
//! the lower 24. Textures of one shape share one generated function; what differs between them is read from their records,
//! so that changing a number compiles nothing. Trees of constants are folded, and equal trees have one record.

use super::atlas::{Atlas, Place};
use super::texture_glsl::{Input, Shape, glsl};
use super::texture_image::{brightness, record};
use super::{Prepared, noise, rows};
use crate::layout::{NoiseSum as NoiseRecord, Pattern, Ramp, RampStop, TextureInput};
use crate::scene::{Handle, Noise, NoiseSum, PatternSpace, Scene, Texture, Value};
use crate::{Error, Result};
use glam::Vec3;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Least, mean and largest of the values of a texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    pub min: f64,
    pub mean: f64,
    pub max: f64,
}

/// The textures of a scene as kernels read them.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedTextures {
    /// Words of the records.
    pub records: Vec<[u32; 4]>,
    /// Words of the atlas pages.
    pub texels: Vec<[u32; 4]>,
    /// The virtual file `generated/textures.glsl`.
    pub glsl: String,
    /// The reference of each texture, by its handle.
    pub references: Vec<u32>,
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
    let (textures, _) = build(scene, &[("texture_evaluate", asked.iter().copied().collect())])?;
    Ok(textures)
}

/// Fills `textures`, `texels` and `texture_glsl`.
pub(super) fn prepare(scene: &Scene, out: &mut Prepared) -> Result<References> {
    let (textures, references) = build(scene, &uses(scene))?;
    (out.textures, out.texels, out.texture_glsl) = (textures.records, textures.texels, textures.glsl);
    Ok(references)
}

/// A use of textures: the function of the kernels that gives their values, and those that it is asked for.
type Use = (&'static str, BTreeSet<Handle<Texture>>);

fn build(scene: &Scene, uses: &[Use]) -> Result<(PreparedTextures, References)> {
    if let Some(handle) = Texture::without_end(&scene.textures) {
        return Err(Error::scene(Texture::endless(scene.textures.name(handle))));
    }
    let mut atlas = Atlas::default();
    let mut places = BTreeMap::new();
    for (handle, _, texture) in scene.textures.iter() {
        if let Texture::Image(texture) = texture {
            places.insert(handle, atlas.place(scene, texture)?);
        }
    }
    let has_noise = scene.textures.iter().any(|(_, _, texture)| matches!(texture, Texture::Noise(_)));
    // The kernels look for it at the start
    let words = if has_noise { noise::words().collect() } else { Vec::new() };
    let done = vec![None; scene.textures.len()];
    let mut builder = Builder { scene, atlas, places, shapes: Vec::new(), words, kept: HashMap::new(), done };
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
    let Builder { atlas, shapes, words, .. } = builder;
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
        texels: atlas.into_words(),
        glsl: glsl(&shapes, &roots),
        references: references.references.clone(),
    };
    Ok((textures, references))
}

/// What a scene asks of its textures. One that is asked for nothing and is no input of another is there to be evaluated.
fn uses(scene: &Scene) -> [Use; 2] {
    let materials = || scene.materials.iter().map(|(_, _, material)| material);
    let opacity: BTreeSet<_> = materials().flat_map(|material| material.detail.opacity.textures()).collect();
    let inputs: BTreeSet<_> = scene.textures.iter().flat_map(|(_, _, texture)| texture.inputs()).collect();
    let mut direct: BTreeSet<_> = scene.textures.iter().map(|(handle, ..)| handle).collect();
    direct.retain(|handle| !inputs.contains(handle) && !opacity.contains(handle));
    direct.extend(materials().flat_map(|material| material.textures()));
    direct.extend(scene.environment.iter().filter_map(|environment| environment.texture()));
    [("texture_evaluate", direct), ("texture_opacity", opacity)]
}

/// A texture that has its place: shape, word of its record, its constant value if it has one, and its range.
#[derive(Debug, Clone, Copy)]
struct Node {
    shape: u32,
    at: u32,
    constant: Option<Vec3>,
    range: Range,
}

struct Builder<'a> {
    scene: &'a Scene,
    atlas: Atlas,
    places: BTreeMap<Handle<Texture>, Place>,
    shapes: Vec<Shape>,
    words: Vec<[u32; 4]>,
    /// Records by shape and words: equal trees are one.
    kept: HashMap<(u32, Vec<[u32; 4]>), u32>,
    done: Vec<Option<Node>>,
}

/// A record under construction.
#[derive(Default)]
struct Words(Vec<[u32; 4]>);

impl Words {
    fn push<T: crate::layout::Record>(&mut self, record: T) {
        self.0.extend_from_slice(bytemuck::cast_slice(std::slice::from_ref(&record)));
    }
}

impl Builder<'_> {
    /// The node of a texture. Trees are known to be no deeper than [`Texture::DEEPEST`].
    fn node(&mut self, handle: Handle<Texture>) -> Node {
        if let Some(node) = self.done[handle.index()] {
            return node;
        }
        let node = self.build(handle);
        self.done[handle.index()] = Some(node);
        node
    }

    fn build(&mut self, handle: Handle<Texture>) -> Node {
        let scene = self.scene;
        match &scene.textures[handle] {
            Texture::Constant(color) => self.constant(*color),
            Texture::Image(texture) => {
                let place = self.places[&handle];
                let image = &scene.images[texture.image];
                let mut words = Words::default();
                words.push(record(texture, image, self.atlas.address(place)));
                self.keep(Shape::Image(place.format), words, None, brightness(texture, image))
            }
            Texture::Checker { even, odd, space } => {
                let shape = |inputs| Shape::Checker(space.coordinates, inputs);
                self.pattern(space, [even, odd], 0.5, Words::default(), shape)
            }
            Texture::Gradient { shape, low, high, space } => {
                let shape = |inputs| Shape::Gradient(*shape, space.coordinates, inputs);
                self.pattern(space, [low, high], 0.5, Words::default(), shape)
            }
            Texture::Worley { feature, metric, low, high, space } => {
                let shape = |inputs| Shape::Worley(*feature, *metric, space.coordinates, inputs);
                self.pattern(space, [low, high], 0.5, Words::default(), shape)
            }
            Texture::Ramp { value, stops, smooth } => self.ramp(*value, stops, *smooth),
            Texture::Noise(noise) => self.noise(noise),
            Texture::Mix { a, b, amount } => {
                let [a, b, t] = [self.input(a), self.input(b), self.number(*amount)];
                let share = t.range.mean.clamp(0.0, 1.0);
                if let (Some(x), Some(y), Some(t)) = (a.constant, b.constant, t.constant) {
                    return self.constant(x.lerp(y, mean(t).clamp(0.0, 1.0)));
                }
                let shape = Shape::Mix([a.input(), b.input(), t.input()]);
                self.join(shape, Words::default(), &[a, b, t], a.range.mixed(b.range, share))
            }
            Texture::Add { a, b } => {
                let [a, b] = [self.input(a), self.input(b)];
                if let (Some(x), Some(y)) = (a.constant, b.constant) {
                    return self.constant(x + y);
                }
                let sum = |a: f64, b: f64| a + b;
                let range = a.range.zip(b.range, sum, sum, sum);
                self.join(Shape::Add([a.input(), b.input()]), Words::default(), &[a, b], range)
            }
            Texture::Multiply { a, b } => {
                let [a, b] = [self.input(a), self.input(b)];
                if let (Some(x), Some(y)) = (a.constant, b.constant) {
                    return self.constant(x * y);
                }
                let ends = [
                    a.range.min * b.range.min,
                    a.range.min * b.range.max,
                    a.range.max * b.range.min,
                    a.range.max * b.range.max,
                ];
                let range = Range {
                    min: ends.into_iter().fold(f64::INFINITY, f64::min),
                    mean: a.range.mean * b.range.mean,
                    max: ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
                };
                self.join(Shape::Multiply([a.input(), b.input()]), Words::default(), &[a, b], range)
            }
            Texture::Invert { value } => {
                let a = self.input(value);
                if let Some(value) = a.constant {
                    return self.constant(Vec3::ONE - value);
                }
                let Range { min, mean, max } = a.range;
                let range = Range { min: 1.0 - max, mean: 1.0 - mean, max: 1.0 - min };
                self.join(Shape::Invert([a.input()]), Words::default(), &[a], range)
            }
        }
    }

    fn noise(&mut self, noise: &Noise) -> Node {
        let amplitudes = (0..noise.octaves).map(|i| f64::from(noise.gain).powi(i as i32)).sum::<f64>();
        let mut own = Words::default();
        own.push(NoiseRecord {
            octaves: noise.octaves,
            gain: noise.gain,
            lacunarity: noise.lacunarity,
            scale: (1.0 / amplitudes.max(f64::MIN_POSITIVE)) as f32,
        });
        // The mean of |n| is about 0.2, and of n it is 0
        let share = if noise.sum == NoiseSum::Turbulence { 0.2 } else { 0.5 };
        let shape = |inputs| Shape::Noise(noise.sum, noise.space.coordinates, inputs);
        self.pattern(&noise.space, [&noise.low, &noise.high], share, own, shape)
    }

    /// A pattern in space between two inputs, of which the second has `share` on average. `own` are the words of its record
    /// after those of its place.
    fn pattern(
        &mut self,
        space: &PatternSpace,
        inputs: [&Value<Vec3>; 2],
        share: f64,
        own: Words,
        shape: impl FnOnce([Input; 2]) -> Shape,
    ) -> Node {
        let [a, b] = inputs.map(|input| self.input(input));
        let [row0, row1, row2] = rows(&space.pattern_from_space.as_daffine3());
        let mut words = Words::default();
        words.push(Pattern { row0, row1, row2 });
        words.0.extend(own.0);
        self.join(shape([a.input(), b.input()]), words, &[a, b], a.range.mixed(b.range, share))
    }

    fn ramp(&mut self, value: Value<f32>, stops: &[(f32, Vec3)], smooth: bool) -> Node {
        let input = self.number(value);
        let ranges = stops.iter().map(|(_, color)| range_of(*color));
        let whole =
            ranges.reduce(|a, b| a.zip(b, f64::min, |a, b| a + b, f64::max)).unwrap_or(range_of(Vec3::ZERO));
        let range = Range { mean: whole.mean / stops.len().max(1) as f64, ..whole };
        let mut words = Words::default();
        words.push(Ramp { count: stops.len() as u32, smooth_stops: u32::from(smooth), spare: [0; 2] });
        words.push(input.record());
        // A map without stops is black
        let black = [(0.0, Vec3::ZERO)];
        for &(place, color) in if stops.is_empty() { &black[..] } else { stops } {
            words.push(RampStop { color: color.to_array(), place });
        }
        self.keep(Shape::Ramp([input.input()]), words, None, range)
    }

    /// The node of an input.
    fn input(&mut self, value: &Value<Vec3>) -> Node {
        match value {
            Value::Constant(color) => {
                Node { shape: 0, at: 0, constant: Some(*color), range: range_of(*color) }
            }
            Value::Texture(handle) => self.node(*handle),
        }
    }

    fn number(&mut self, value: Value<f32>) -> Node {
        match value {
            Value::Constant(number) => self.input(&Value::Constant(Vec3::splat(number))),
            Value::Texture(handle) => self.input(&Value::Texture(handle)),
        }
    }

    /// A node that is the same everywhere.
    fn constant(&mut self, color: Vec3) -> Node {
        let mut words = Words::default();
        words.push(TextureInput { value: color.to_array(), at: 0 });
        self.keep(Shape::Constant, words, Some(color), range_of(color))
    }

    /// A node with its inputs after its own words.
    fn join(&mut self, shape: Shape, mut words: Words, inputs: &[Node], range: Range) -> Node {
        for input in inputs {
            words.push(input.record());
        }
        self.keep(shape, words, None, range)
    }

    fn keep(&mut self, shape: Shape, words: Words, constant: Option<Vec3>, range: Range) -> Node {
        let known = self.shapes.iter().position(|other| *other == shape);
        let shape = known.unwrap_or_else(|| {
            self.shapes.push(shape);
            self.shapes.len() - 1
        }) as u32;
        let next = self.words.len() as u32;
        let at = *self.kept.entry((shape, words.0)).or_insert_with_key(|(_, words)| {
            self.words.extend_from_slice(words);
            next
        });
        Node { shape, at, constant, range }
    }
}

impl Node {
    fn record(&self) -> TextureInput {
        match self.constant {
            Some(color) => TextureInput { value: color.to_array(), at: 0 },
            None => TextureInput { value: [0.0; 3], at: self.at },
        }
    }

    fn input(&self) -> Input {
        if self.constant.is_some() { Input::Constant } else { Input::Texture(self.shape) }
    }
}

impl Range {
    /// Of values between those of two textures, of which the second has `share` on average.
    fn mixed(self, other: Self, share: f64) -> Self {
        self.zip(other, f64::min, |a, b| (1.0 - share) * a + share * b, f64::max)
    }

    fn zip(
        self,
        other: Self,
        min: impl Fn(f64, f64) -> f64,
        mean: impl Fn(f64, f64) -> f64,
        max: impl Fn(f64, f64) -> f64,
    ) -> Self {
        Self {
            min: min(self.min, other.min),
            mean: mean(self.mean, other.mean),
            max: max(self.max, other.max),
        }
    }
}

fn mean(color: Vec3) -> f32 {
    color.element_sum() / 3.0
}

fn range_of(color: Vec3) -> Range {
    Range {
        min: f64::from(color.min_element()),
        mean: f64::from(mean(color)),
        max: f64::from(color.max_element()),
    }
}
