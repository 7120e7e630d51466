//! Where pictures lie: rectangles of words on pages.

use super::texels::Format;
use super::{Atlas, Page, Picture, Place, half_size, level_count};
use crate::scene::{ColorSpace, Handle, Image, ImageTexture, Scene, StackTexture};
use crate::{Error, Result};
use etagere::{AtlasAllocator, size2};
use std::collections::BTreeMap;

/// Columns of words of a page; a wider picture gets a page of its own width.
const PAGE_WIDTH: u32 = 512;
/// Rows of words that a page may grow to; a higher picture gets a page of its own height.
const PAGE_HEIGHT: u32 = 4096;

/// Where the picture of a texture is, and the levels above it, when it has any.
#[derive(Debug, Clone)]
pub(in crate::prepare) struct Placed {
    pub picture: Place,
    pub above: Vec<Place>,
}

/// Where a volume is, and rows of words from a slice to the next.
#[derive(Debug, Clone, Copy)]
pub(in crate::prepare) struct StackPlace {
    pub place: Place,
    pub slice_words: u32,
}

/// A page that is being laid out.
struct Open {
    format: Format,
    allocator: AtlasAllocator,
    width: u32,
    rows: u32,
}

impl Open {
    fn of(format: Format, [width, height]: [u32; 2]) -> Self {
        let allocator = AtlasAllocator::new(size2(width as i32, height as i32));
        Self { format, allocator, width, rows: 0 }
    }

    /// The first word of a free rectangle.
    fn allocate(&mut self, [width, height]: [u32; 2]) -> Option<u32> {
        let size = size2(i32::try_from(width).ok()?, i32::try_from(height).ok()?);
        let corner = self.allocator.allocate(size)?.rectangle.min;
        self.rows = self.rows.max(corner.y as u32 + height);
        Some(corner.y as u32 * self.width + corner.x as u32)
    }
}

/// An atlas in the making. A picture that several textures read in the same way is kept once.
#[derive(Default)]
pub(in crate::prepare) struct Layout {
    pages: Vec<Open>,
    pictures: Vec<Picture>,
    /// Of those, the ones that textures have.
    kept: BTreeMap<(Handle<Image>, ColorSpace), usize>,
    stacks: BTreeMap<(Vec<Handle<Image>>, ColorSpace), StackPlace>,
}

impl Layout {
    /// A place for the picture of a texture, and for the levels of a pyramid above it, each half as large as the one below, down
    /// to one texel, where one is asked for.
    pub(in crate::prepare) fn place(
        &mut self,
        scene: &Scene,
        texture: &ImageTexture,
        pyramid: bool,
    ) -> Result<Placed> {
        let key = (texture.image, texture.color_space);
        let image = &scene.images[texture.image];
        let mut size = [image.width, image.height];
        let failed = || {
            let name = scene.images.name(texture.image);
            Error::scene(format!(
                "picture `{name}` of {} x {} does not fit the atlas",
                image.width, image.height
            ))
        };
        let index = match self.kept.get(&key) {
            Some(&index) => index,
            None => {
                let format = Format::of(image, texture.color_space);
                let place = self.allocate(format, format.words(size)).ok_or_else(failed)?;
                let decode = texture.color_space == ColorSpace::Srgb;
                self.pictures.push(Picture { image: texture.image, decode, place, above: Vec::new() });
                self.kept.insert(key, self.pictures.len() - 1);
                self.pictures.len() - 1
            }
        };
        let picture = self.pictures[index].place;
        if !pyramid {
            return Ok(Placed { picture, above: Vec::new() });
        }
        if self.pictures[index].above.is_empty() {
            let format = picture.format.coarse();
            for _ in 1..level_count(size) {
                size = half_size(size);
                let level = self.allocate(format, format.words(size)).ok_or_else(failed)?;
                self.pictures[index].above.push(level);
            }
        }
        Ok(Placed { picture, above: self.pictures[index].above.clone() })
    }

    /// A place for the slices of a volume one below the other, all in one format.
    pub(in crate::prepare) fn stack(&mut self, scene: &Scene, stack: &StackTexture) -> Result<StackPlace> {
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
        let formats: Vec<_> = images.iter().map(|image| Format::of(image, stack.color_space)).collect();
        let same = formats.iter().all(|format| *format == formats[0]);
        let format = if same { formats[0] } else { Format::RgbaF32 };
        let [width, slice_words] = format.words(size);
        let whole = [width, slice_words.saturating_mul(images.len() as u32)];
        // A page of its own: a high pile of narrow slices would leave most of another page empty
        let mut page = Open::of(format, whole);
        page.allocate(whole).ok_or_else(|| Error::scene("a stack does not fit the atlas"))?;
        self.pages.push(page);
        let place = Place { page: self.pages.len() - 1, word: 0, format };
        let decode = stack.color_space == ColorSpace::Srgb;
        for (&image, k) in stack.slices.iter().zip(0..) {
            let place = Place { word: k * slice_words * width, ..place };
            self.pictures.push(Picture { image, decode, place, above: Vec::new() });
        }
        let place = StackPlace { place, slice_words };
        self.stacks.insert(key, place);
        Ok(place)
    }

    fn allocate(&mut self, format: Format, size: [u32; 2]) -> Option<Place> {
        for (page, open) in self.pages.iter_mut().enumerate().filter(|(_, open)| open.format == format) {
            if let Some(word) = open.allocate(size) {
                return Some(Place { page, word, format });
            }
        }
        let mut open = Open::of(format, [PAGE_WIDTH.max(size[0]), PAGE_HEIGHT.max(size[1])]);
        let word = open.allocate(size)?;
        self.pages.push(open);
        Some(Place { page: self.pages.len() - 1, word, format })
    }

    /// All pages one after the other.
    pub(in crate::prepare) fn finish(mut self) -> Atlas {
        let mut pages: Vec<Page> = Vec::with_capacity(self.pages.len());
        for open in &self.pages {
            let first = pages.last().map_or(0, Page::end);
            pages.push(Page { first, width: open.width, rows: open.rows });
        }
        // Those of one image side by side, so that it is looked at once
        self.pictures.sort_by_key(|picture| picture.image);
        Atlas { pages, pictures: self.pictures }
    }
}
