//! Volumes from slices: their record.

use super::builder::{Builder, Node};
use super::image::{brightness, image_flags};
use super::pattern::place as place_words;
use super::range::Range;
use super::shape::Shape;
use crate::layout::{FLAG_NEAREST, Stack, WRAP_W_SHIFT};
use crate::prepare::atlas::StackPlace;
use crate::scene::{Handle, ImageTexture, StackTexture, TexelFilter, Texture, UvTransform};

/// A slice of a volume, as a picture by itself.
fn slice(stack: &StackTexture, k: usize) -> ImageTexture {
    ImageTexture {
        image: stack.slices[k],
        filter: if stack.smooth { TexelFilter::Bilinear } else { TexelFilter::Nearest },
        wrap: [stack.wrap[0], stack.wrap[1]],
        uv: UvTransform::default(),
        color_space: stack.color_space,
        channel: stack.channel,
        scale: stack.scale,
        invert: stack.invert,
    }
}

impl Builder<'_> {
    pub(super) fn stack(&mut self, handle: Handle<Texture>, stack: &StackTexture) -> Node {
        let StackPlace { place, slice_words } = self.stacks[&handle];
        let first = &self.scene.images[stack.slices[0]];
        let (base, pitch) = self.atlas.address(place);
        let nearest = if stack.smooth { 0 } else { FLAG_NEAREST };
        let mut words = place_words(&stack.space, [0.0; 2]);
        words.push(Stack {
            base,
            pitch,
            slice_words: slice_words * pitch,
            flags: image_flags(&slice(stack, 0))
                | super::image::wrap_mode(stack.wrap[2]) << WRAP_W_SHIFT
                | nearest,
            size: [first.width, first.height, stack.slices.len() as u32],
            scale: stack.scale,
        });
        let ranges = (0..stack.slices.len()).map(|k| {
            let texture = slice(stack, k);
            brightness(&texture, &self.scene.images[texture.image])
        });
        let whole = ranges.reduce(|a, b| a.zip(b, f64::min, |a, b| a + b, f64::max));
        let whole = whole.unwrap_or(Range::of(glam::Vec3::ZERO));
        let range = Range { mean: whole.mean / stack.slices.len() as f64, ..whole };
        self.keep(Shape::Stack(place.format, stack.space.coordinates), words, None, range)
    }
}
