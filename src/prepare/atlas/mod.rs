//! Pictures packed into atlas pages: rectangles of words of which each holds a block of texels.
//!
//! Each picture keeps its own size; nothing lies between neighbours, because the kernels filter by themselves and never
//! read outside a picture. Where they lie is decided first; their texels are written page by page when they are asked for, so
//! that no more than a few pages are in memory beside the pictures.

mod layout;
mod pyramid;
#[cfg(test)]
mod tests;
mod texels;

pub(super) use layout::{Layout, Placed, StackPlace};
pub(super) use texels::{Format, Reader};

use crate::Result;
use crate::scene::{Handle, Image};
use pyramid::halved;
use std::sync::Arc;

/// The size of a picture of half the width and height, rounded up.
pub(super) fn half_size(size: [u32; 2]) -> [u32; 2] {
    size.map(|n| n.div_ceil(2).max(1))
}

/// Levels of the pyramid of a picture, itself among them.
pub(super) fn level_count(size: [u32; 2]) -> u32 {
    size.map(|n| n.max(1).next_power_of_two().trailing_zeros() + 1).into_iter().max().unwrap_or(1)
}

/// Where a picture is: page, and word in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    page: usize,
    word: u32,
    pub(super) format: Format,
}

/// A rectangle of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Page {
    /// Its first word among those of all pages.
    first: usize,
    width: u32,
    rows: u32,
}

impl Page {
    fn words(&self) -> usize {
        self.width as usize * self.rows as usize
    }

    fn end(&self) -> usize {
        self.first + self.words()
    }
}

/// A picture in the atlas, and the levels of its pyramid.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Picture {
    image: Handle<Image>,
    /// Its numbers are sRGB.
    decode: bool,
    place: Place,
    above: Vec<Place>,
}

impl Picture {
    fn pages(&self) -> impl Iterator<Item = usize> {
        std::iter::once(self.place.page).chain(self.above.iter().map(|level| level.page))
    }
}

/// The pages of an atlas, and which picture lies where.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Atlas {
    pages: Vec<Page>,
    pictures: Vec<Picture>,
}

impl Atlas {
    /// Words of all pages, of 16 bytes.
    pub fn words(&self) -> usize {
        self.pages.last().map_or(0, Page::end)
    }

    /// The images of which there are pictures, in the order in which [`Self::fill`] asks for them.
    pub fn images(&self) -> impl Iterator<Item = Handle<Image>> {
        self.pictures.chunk_by(|a, b| a.image == b.image).map(|group| group[0].image)
    }

    /// First word and pitch of a picture.
    pub(super) fn address(&self, place: Place) -> (u32, u32) {
        let page = self.pages[place.page];
        (page.first as u32 + place.word, page.width)
    }

    /// Writes the pages. `picture` gives each image once, and `write` gets each page once: its first word among those of all pages, and
    /// its words.
    ///
    /// # Errors
    /// Those of `write`.
    pub fn fill(
        &self,
        mut picture: impl FnMut(Handle<Image>) -> Arc<Image>,
        mut write: impl FnMut(usize, &[[u32; 4]]) -> Result<()>,
    ) -> Result<()> {
        let mut last = vec![0; self.pages.len()];
        for (i, picture) in self.pictures.iter().enumerate() {
            picture.pages().for_each(|page| last[page] = i);
        }
        let mut open = vec![Vec::new(); self.pages.len()];
        let mut done = 0;
        for group in self.pictures.chunk_by(|a, b| a.image == b.image) {
            {
                let image = picture(group[0].image);
                group.iter().for_each(|picture| self.draw(&image, picture, &mut open));
            }
            done += group.len();
            for page in group.iter().flat_map(Picture::pages) {
                if last[page] < done && !open[page].is_empty() {
                    write(self.pages[page].first, &std::mem::take(&mut open[page]))?;
                }
            }
        }
        Ok(())
    }

    /// Writes a picture, and its pyramid, to pages that begin when they are first written to.
    fn draw(&self, image: &Image, picture: &Picture, open: &mut [Vec<[u32; 4]>]) {
        let mut draw = |read: &Reader<'_>, place: Place| {
            let page = self.pages[place.page];
            let words = &mut open[place.page];
            words.resize(page.words(), [0; 4]);
            let [width, height] = place.format.words([read.image.width, read.image.height]);
            for y in 0..height {
                let start = place.word as usize + y as usize * page.width as usize;
                for (word, x) in words[start..][..width as usize].iter_mut().zip(0..) {
                    *word = read.word(place.format, x, y);
                }
            }
        };
        let whole = Reader { image, decode: picture.decode };
        draw(&whole, picture.place);
        let mut below: Option<Image> = None;
        for &place in &picture.above {
            let level = halved(
                &below.as_ref().map_or(Reader { image, ..whole }, |image| Reader { image, decode: false }),
            );
            draw(&Reader { image: &level, decode: false }, place);
            below = Some(level);
        }
    }
}
