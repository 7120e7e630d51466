//! A texture tree, node by node: shapes and records.

use super::image::{brightness, levels, record};
use super::range::Range;
use super::shape::{Input, Shape};
use crate::layout::TextureInput;
use crate::prepare::atlas::{Atlas, Placed, StackPlace};
use crate::scene::{Channel, GlslTexture, Handle, Scene, Texture, Value};
use glam::{Vec3, Vec4};
use std::collections::{BTreeMap, HashMap};

/// A texture that has its place: shape, word of its record, its constant value if it has one, and its range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub shape: u32,
    pub at: u32,
    pub constant: Option<Vec3>,
    pub range: Range,
}

pub(super) struct Builder<'a> {
    pub scene: &'a Scene,
    pub atlas: Atlas,
    pub places: BTreeMap<Handle<Texture>, Placed>,
    pub users: Vec<&'a GlslTexture>,
    pub stacks: BTreeMap<Handle<Texture>, StackPlace>,
    pub shapes: Vec<Shape>,
    pub words: Vec<[u32; 4]>,
    /// Records by shape and words: equal trees are one.
    pub kept: HashMap<(u32, Vec<[u32; 4]>), u32>,
    pub done: Vec<Option<Node>>,
}

/// A record under construction.
#[derive(Default)]
pub(super) struct Words(pub Vec<[u32; 4]>);

impl Words {
    pub(super) fn push<T: crate::layout::Record>(&mut self, record: T) {
        self.0.extend_from_slice(bytemuck::cast_slice(std::slice::from_ref(&record)));
    }
}

impl<'a> Builder<'a> {
    /// The node of a texture. Trees are known to be no deeper than [`Texture::DEEPEST`].
    pub(super) fn node(&mut self, handle: Handle<Texture>) -> Node {
        if let Some(node) = self.done[handle.index()] {
            return node;
        }
        let node = self.build(handle);
        self.done[handle.index()] = Some(node);
        node
    }

    pub(super) fn build(&mut self, handle: Handle<Texture>) -> Node {
        let scene = self.scene;
        match &scene.textures[handle] {
            Texture::Constant(color) => self.constant(*color),
            Texture::VertexColor(channel) => self.vertex_color(*channel),
            Texture::Image(texture) => {
                let placed = &self.places[&handle];
                let image = &scene.images[texture.image];
                let mut words = Words::default();
                words.push(record(texture, image, self.atlas.address(placed.picture)));
                let levels = levels(image, &self.atlas, placed);
                let shape = Shape::Image(placed.picture.format, !levels.is_empty());
                levels.into_iter().for_each(|level| words.push(level));
                self.keep(shape, words, None, brightness(texture, image))
            }
            Texture::Glsl(texture) => self.user(texture),
            Texture::Stack(stack) => self.stack(handle, stack),
            Texture::Checker { dimensions, even, odd, space } => {
                let shape = |place, inputs| Shape::Checker(place, *dimensions, inputs);
                self.between(space, [even, odd], 0.5, shape)
            }
            Texture::Gradient { shape, low, high, space } => {
                self.between(space, [low, high], 0.5, |place, inputs| Shape::Gradient(*shape, place, inputs))
            }
            Texture::Worley { feature, metric, low, high, space } => {
                let shape = |place, inputs| Shape::Worley(*feature, *metric, place, inputs);
                self.between(space, [low, high], 0.5, shape)
            }
            Texture::Noise(noise) => self.noise(noise),
            Texture::ValueNoise(noise) => self.value_noise(noise),
            Texture::Veins(veins) => self.veins(veins),
            Texture::Brick(brick) => self.brick(brick),
            Texture::Dots(dots) => self.dots(dots),
            Texture::Ramp { value, stops, smooth } => {
                let value = self.number(*value);
                self.ramp(value, stops, *smooth)
            }
            Texture::Curve { value, points, smooth } => self.curve(value, points, *smooth),
            Texture::Mix { a, b, amount } => self.mix(a, b, *amount),
            Texture::DirectionMix { a, b, direction } => self.direction_mix(a, b, *direction),
            Texture::Add { a, b } => self.add(a, b),
            Texture::Multiply { a, b } => self.multiply(a, b),
            Texture::Scale { value, factor } => self.scale(value, *factor),
            Texture::Invert { value } => self.invert(value),
            Texture::Warp(warp) => self.warp(warp),
            Texture::Mapped { value, mapping } => self.mapped(value, mapping),
        }
    }

    /// The node of an input.
    pub(super) fn input(&mut self, value: &Value<Vec3>) -> Node {
        match value {
            Value::Constant(color) => {
                Node { shape: 0, at: 0, constant: Some(*color), range: Range::of(*color) }
            }
            Value::Texture(handle) => self.node(*handle),
        }
    }

    pub(super) fn number(&mut self, value: Value<f32>) -> Node {
        match value {
            Value::Constant(number) => self.input(&Value::Constant(Vec3::splat(number))),
            Value::Texture(handle) => self.input(&Value::Texture(handle)),
        }
    }

    /// A node that is the same everywhere.
    pub(super) fn constant(&mut self, color: Vec3) -> Node {
        let mut words = Words::default();
        words.push(TextureInput { value: color.to_array(), at: 0 });
        self.keep(Shape::Constant, words, Some(color), Range::of(color))
    }

    /// Its range is that of all meshes; what has no colours is white.
    fn vertex_color(&mut self, channel: Channel) -> Node {
        let colors = || self.scene.meshes.iter().flat_map(|(_, _, mesh)| &mesh.colors);
        let range = |color: &Vec4| {
            Range::of(match channel {
                Channel::Rgb => color.truncate(),
                Channel::R => Vec3::splat(color.x),
                Channel::G => Vec3::splat(color.y),
                Channel::B => Vec3::splat(color.z),
                Channel::A => Vec3::splat(color.w),
            })
        };
        let count = colors().count().max(1) as f64;
        let sum = |a: f64, b: f64| a + b;
        let all = colors().map(range).reduce(|a, b| a.zip(b, f64::min, sum, f64::max));
        let all = all.map_or(Range::of(Vec3::ONE), |all| Range { mean: all.mean / count, ..all });
        let range = Range { min: all.min.min(1.0), max: all.max.max(1.0), ..all };
        self.keep(Shape::VertexColor(channel), Words::default(), None, range)
    }

    /// A node with its inputs after its own words.
    pub(super) fn join(&mut self, shape: Shape, mut words: Words, inputs: &[Node], range: Range) -> Node {
        for input in inputs {
            words.push(input.record());
        }
        self.keep(shape, words, None, range)
    }

    pub(super) fn keep(&mut self, shape: Shape, words: Words, constant: Option<Vec3>, range: Range) -> Node {
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
    pub(super) fn record(&self) -> TextureInput {
        match self.constant {
            Some(color) => TextureInput { value: color.to_array(), at: 0 },
            None => TextureInput { value: [0.0; 3], at: self.at },
        }
    }

    pub(super) fn input(&self) -> Input {
        if self.constant.is_some() { Input::Constant } else { Input::Texture(self.shape) }
    }
}
