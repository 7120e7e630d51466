//! Pictures packed into atlas pages: rectangles of words of which each holds a block of texels.
//!
//! Each picture keeps its own size; nothing lies between neighbours, because the kernels filter by themselves and never
//! read outside a picture.

use super::pyramid::halved;
use crate::layout::{TEXELS_RGBA8, TEXELS_RGBA8_SRGB, TEXELS_RGBA16F, TEXELS_RGBA32F};
use crate::scene::{ColorSpace, Handle, Image, ImageTexture, Scene, StackTexture, Texels};
use crate::{Error, Result};
use etagere::{AtlasAllocator, size2};
use half::f16;
use std::collections::BTreeMap;

/// How texels are kept: what the kernels call `TEXELS_…`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Format {
    /// 2×2 texels a word, linear.
    Rgba8,
    /// 2×2 texels a word, sRGB.
    Rgba8Srgb,
    /// 2×1 texels a word.
    Rgba16F,
    /// 1 texel a word.
    RgbaF32,
}

/// The size of a picture of half the width and height, rounded up.
pub(super) fn half_size(size: [u32; 2]) -> [u32; 2] {
    size.map(|n| n.div_ceil(2).max(1))
}

/// Levels of the pyramid of a picture, itself among them.
pub(super) fn level_count(size: [u32; 2]) -> u32 {
    size.map(|n| n.max(1).next_power_of_two().trailing_zeros() + 1).into_iter().max().unwrap_or(1)
}

impl Format {
    /// That of the levels of a pyramid above a picture: bytes would show as bands, and a mean of halves is a half.
    fn coarse(self) -> Self {
        match self {
            Self::Rgba8 | Self::Rgba8Srgb | Self::Rgba16F => Self::Rgba16F,
            Self::RgbaF32 => Self::RgbaF32,
        }
    }

    /// Its number in the kernels.
    pub(super) fn number(self) -> u32 {
        match self {
            Self::Rgba8 => TEXELS_RGBA8,
            Self::Rgba8Srgb => TEXELS_RGBA8_SRGB,
            Self::Rgba16F => TEXELS_RGBA16F,
            Self::RgbaF32 => TEXELS_RGBA32F,
        }
    }

    /// Texels of a word in x and y.
    fn block(self) -> [u32; 2] {
        match self {
            Self::Rgba8 | Self::Rgba8Srgb => [2, 2],
            Self::Rgba16F => [2, 1],
            Self::RgbaF32 => [1, 1],
        }
    }
}

/// Columns of words of a page; a wider picture gets a page of its own width.
const PAGE_WIDTH: u32 = 512;
/// Rows of words that a page may grow to; a higher picture gets a page of its own height.
const PAGE_HEIGHT: u32 = 4096;

struct Page {
    format: Format,
    allocator: AtlasAllocator,
    width: u32,
    words: Vec<[u32; 4]>,
}

impl Page {
    fn of(format: Format, [width, height]: [u32; 2]) -> Self {
        let allocator = AtlasAllocator::new(size2(width as i32, height as i32));
        Self { format, allocator, width, words: Vec::new() }
    }

    /// Writes a rectangle of words and gives the first.
    fn fill(&mut self, corner: [u32; 2], size: [u32; 2], block: impl Fn(u32, u32) -> [u32; 4]) -> u32 {
        let rows = (corner[1] + size[1]) as usize * self.width as usize;
        if self.words.len() < rows {
            self.words.resize(rows, [0; 4]);
        }
        let word = corner[1] * self.width + corner[0];
        for y in 0..size[1] {
            for x in 0..size[0] {
                self.words[(word + y * self.width + x) as usize] = block(x, y);
            }
        }
        word
    }
}

/// Where a picture is: page, and word in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    page: usize,
    word: u32,
    pub(super) format: Format,
}

/// Where a volume is, and rows of words from a slice to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct StackPlace {
    pub(super) place: Place,
    pub(super) slice_words: u32,
}

/// Pages that are being filled. A picture that several textures read in the same way is kept once.
#[derive(Default)]
pub(super) struct Atlas {
    pages: Vec<Page>,
    kept: BTreeMap<(Handle<Image>, ColorSpace), Place>,
    stacks: BTreeMap<(Vec<Handle<Image>>, ColorSpace), StackPlace>,
    pyramids: BTreeMap<(Handle<Image>, ColorSpace), Vec<Place>>,
}

impl Atlas {
    /// Puts the picture of a texture on a page, unless it is there.
    pub(super) fn place(&mut self, scene: &Scene, texture: &ImageTexture) -> Result<Place> {
        let key = (texture.image, texture.color_space);
        if let Some(place) = self.kept.get(&key) {
            return Ok(*place);
        }
        let (image, name) = (&scene.images[texture.image], scene.images.name(texture.image));
        let read = Reader { image, decode: texture.color_space == ColorSpace::Srgb };
        let place = self.put(&read, format_of(image, texture.color_space), name)?;
        self.kept.insert(key, place);
        Ok(place)
    }

    /// Puts the levels above the picture of a texture on pages, each half as large as the one below, down to one texel.
    pub(super) fn pyramid(&mut self, scene: &Scene, texture: &ImageTexture) -> Result<()> {
        let key = (texture.image, texture.color_space);
        if self.pyramids.contains_key(&key) {
            return Ok(());
        }
        let (image, name) = (&scene.images[texture.image], scene.images.name(texture.image));
        let format = self.place(scene, texture)?.format.coarse();
        let mut levels = Vec::new();
        let mut level = halved(&Reader { image, decode: texture.color_space == ColorSpace::Srgb });
        for _ in 0..level_count([image.width, image.height]) - 1 {
            let read = Reader { image: &level, decode: false };
            levels.push(self.put(&read, format, name)?);
            level = halved(&read);
        }
        self.pyramids.insert(key, levels);
        Ok(())
    }

    /// Puts the slices of a volume one below the other, all in one format.
    pub(super) fn stack(&mut self, scene: &Scene, stack: &StackTexture) -> Result<StackPlace> {
        let key = (stack.slices.clone(), stack.color_space);
        if let Some(place) = self.stacks.get(&key) {
            return Ok(*place);
        }
        let images: Vec<_> = stack.slices.iter().map(|slice| &scene.images[*slice]).collect();
        let Some(&first) = images.first() else { return Err(Error::scene("a stack without slices")) };
        let size = [first.width, first.height];
        if images.iter().any(|image| [image.width, image.height] != size) {
            return Err(Error::scene("the slices of a stack differ in size"));
        }
        let formats: Vec<_> = images.iter().map(|image| format_of(image, stack.color_space)).collect();
        let same = formats.iter().all(|format| *format == formats[0]);
        let format = if same { formats[0] } else { Format::RgbaF32 };
        let [bx, by] = format.block();
        let slice_words = size[1].div_ceil(by);
        let blocks = [size[0].div_ceil(bx), slice_words.saturating_mul(images.len() as u32)];
        let reads: Vec<_> = images
            .iter()
            .map(|&image| Reader { image, decode: stack.color_space == ColorSpace::Srgb })
            .collect();
        // A page of its own: a high pile of narrow slices would leave most of another page empty
        self.pages.push(Page::of(format, blocks));
        let page = self.pages.len() - 1;
        self.pages[page].allocator.allocate(size2(blocks[0] as i32, blocks[1] as i32));
        let block = |x, y| reads[(y / slice_words) as usize].block(format, x, y % slice_words);
        let word = self.pages[page].fill([0, 0], blocks, block);
        let place = StackPlace { place: Place { page, word, format }, slice_words };
        self.stacks.insert(key, place);
        Ok(place)
    }

    /// The levels above the picture of a texture, when it has any.
    pub(super) fn levels(&self, texture: &ImageTexture) -> &[Place] {
        self.pyramids.get(&(texture.image, texture.color_space)).map_or(&[], Vec::as_slice)
    }

    /// Puts a picture on a page.
    fn put(&mut self, read: &Reader<'_>, format: Format, name: &str) -> Result<Place> {
        let image = read.image;
        let [bx, by] = format.block();
        let size = [image.width.div_ceil(bx).max(1), image.height.div_ceil(by).max(1)];
        let (page, corner) = self.allocate(format, size).ok_or_else(|| {
            Error::scene(format!(
                "picture `{name}` of {} x {} does not fit the atlas",
                image.width, image.height
            ))
        })?;
        let word = self.pages[page].fill(corner, size, |x, y| read.block(format, x, y));
        Ok(Place { page, word, format })
    }

    fn allocate(&mut self, format: Format, [w, h]: [u32; 2]) -> Option<(usize, [u32; 2])> {
        let size = size2(i32::try_from(w).ok()?, i32::try_from(h).ok()?);
        let corner = |a: etagere::Allocation| [a.rectangle.min.x as u32, a.rectangle.min.y as u32];
        for (i, page) in self.pages.iter_mut().enumerate().filter(|(_, page)| page.format == format) {
            if let Some(found) = page.allocator.allocate(size) {
                return Some((i, corner(found)));
            }
        }
        let (width, height) = (PAGE_WIDTH.max(w), PAGE_HEIGHT.max(h));
        let mut page = Page::of(format, [width, height]);
        let found = page.allocator.allocate(size)?;
        self.pages.push(page);
        Some((self.pages.len() - 1, corner(found)))
    }

    /// First word and pitch of a picture, once all are placed.
    pub(super) fn address(&self, place: Place) -> (u32, u32) {
        let before: usize = self.pages[..place.page].iter().map(|page| page.words.len()).sum();
        (before as u32 + place.word, self.pages[place.page].width)
    }

    /// All pages one after the other.
    pub(super) fn into_words(self) -> Vec<[u32; 4]> {
        self.pages.into_iter().flat_map(|page| page.words).collect()
    }
}

/// 8 bits stay as they are; halves where they hold every texel exactly; else floats.
fn format_of(image: &Image, space: ColorSpace) -> Format {
    match (&image.texels, space) {
        (Texels::Rgba8(_), ColorSpace::Linear) => Format::Rgba8,
        (Texels::Rgba8(_), ColorSpace::Srgb) => Format::Rgba8Srgb,
        (Texels::RgbaF32(texels), ColorSpace::Linear) if texels.iter().flatten().all(is_half) => {
            Format::Rgba16F
        }
        _ => Format::RgbaF32,
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "called by Iterator::all on references")]
fn is_half(x: &f32) -> bool {
    f16::from_f32(*x).to_f32() == *x
}

/// Reads texels as the kernels shall see them.
pub(super) struct Reader<'a> {
    pub(super) image: &'a Image,
    pub(super) decode: bool,
}

impl Reader<'_> {
    fn block(&self, format: Format, x: u32, y: u32) -> [u32; 4] {
        match format {
            Format::Rgba8 | Format::Rgba8Srgb => [[0, 0], [1, 0], [0, 1], [1, 1]]
                .map(|[i, j]| u32::from_le_bytes(self.bytes(2 * x + i, 2 * y + j))),
            Format::Rgba16F => {
                let pair = |a: f32, b: f32| {
                    u32::from(f16::from_f32(a).to_bits()) | u32::from(f16::from_f32(b).to_bits()) << 16
                };
                let ([r, g, b, a], [s, h, c, d]) = (self.linear(2 * x, y), self.linear(2 * x + 1, y));
                [pair(r, g), pair(b, a), pair(s, h), pair(c, d)]
            }
            Format::RgbaF32 => self.linear(x, y).map(f32::to_bits),
        }
    }

    /// Index of a texel; those past the edge of a block are the edge again.
    fn index(&self, x: u32, y: u32) -> usize {
        let (x, y) = (x.min(self.image.width - 1), y.min(self.image.height - 1));
        y as usize * self.image.width as usize + x as usize
    }

    fn bytes(&self, x: u32, y: u32) -> [u8; 4] {
        match &self.image.texels {
            Texels::Rgba8(texels) => texels[self.index(x, y)],
            _ => [0; 4],
        }
    }

    /// A texel as linear light; alpha is linear always.
    pub(super) fn linear(&self, x: u32, y: u32) -> [f32; 4] {
        let space = if self.decode { ColorSpace::Srgb } else { ColorSpace::Linear };
        self.image.linear(self.index(x, y), space)
    }
}
