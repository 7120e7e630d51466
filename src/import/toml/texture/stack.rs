//! `kind = "stack"`.

use super::image::{WRAPS, shading};
use super::pattern::space;
use crate::Result;
use crate::import::toml::include::identity;
use crate::import::toml::reader::Reader;
use crate::import::toml::text::shown;
use crate::import::toml::view::{Item, View};
use crate::scene::{Handle, Image, StackTexture, Wrap};
use glam::{Affine3A, Mat3A, Vec3A};
use std::path::PathBuf;

/// Most slices of a stack.
const MOST_SLICES: u32 = 4096;

impl Reader<'_> {
    pub(super) fn stack_texture(&mut self, view: &View<'_>) -> Result<StackTexture> {
        let smooth = view.choice_or("filter", true, &[("trilinear", true), ("nearest", false)])?;
        let wrap = view.get("wrap").map_or(Ok([Wrap::Repeat; 3]), wrap)?;
        let axis = view.choice_or("axis", 2, &[("x", 0), ("y", 1), ("z", 2)])?;
        let mut space = space(view)?;
        let source = view.need_either("files", "file")?;
        let slices =
            if view.get("file").is_some() { self.volume(source)? } else { self.slices(view, source)? };
        self.same_sizes(source, &slices)?;
        // Columns are along the axis after that of the slices, rows along the one after that
        let to = |k: usize| Vec3A::AXES[(k + 2 - axis) % 3];
        let turned = Mat3A::from_cols(to(0), to(1), to(2));
        space.pattern_from_space = Affine3A::from_mat3(turned.into()) * space.pattern_from_space;
        let wrap = [0, 1, 2].map(|k| wrap[(k + 1 + axis) % 3]);
        let (color_space, channel, scale, invert) = shading(view, &self.scene.images[slices[0]])?;
        Ok(StackTexture { slices, smooth, wrap, space, color_space, channel, scale, invert })
    }

    /// A volume in one file.
    fn volume(&mut self, file: Item<'_>) -> Result<Vec<Handle<Image>>> {
        let path = file.path()?;
        self.need_file(file.node.spot, &path)?;
        let slices = self.assets.volume(&path).map_err(|error| self.sources.locate(file.node.spot, error))?;
        Ok(slices.into_iter().map(|slice| self.scene.images.add(path.display().to_string(), slice)).collect())
    }

    /// Numbered files, or a list of them.
    fn slices(&mut self, view: &View<'_>, files: Item<'_>) -> Result<Vec<Handle<Image>>> {
        let mut paths: Vec<(Item<'_>, PathBuf)> = Vec::new();
        if files.is_list() {
            for key in ["first", "count"] {
                if let Some(item) = view.get(key) {
                    return Err(item.error(format!("`{key}` has no meaning beside a list of files")));
                }
            }
            for file in files.list("a list of files")? {
                paths.push((file, file.path()?));
            }
        } else {
            let pattern = files.string()?;
            let count = view.need("count")?.u32(1, MOST_SLICES)?;
            let first = view.u32_or("first", 0, 0, u32::MAX - MOST_SLICES)?;
            for number in first..first + count {
                let name = numbered(pattern, number).ok_or_else(|| {
                    files
                        .error(format!("`files` is \"{}\", which has no place for a number", shown(pattern)))
                        .help("write one %d, or %03d for three digits, in its place")
                })?;
                paths.push((files, self.sources.resolve(files.node.spot, &name)));
            }
        }
        if paths.is_empty() || paths.len() > MOST_SLICES as usize {
            return Err(files.mismatch(&format!("from 1 to {MOST_SLICES} files")));
        }
        paths.into_iter().map(|(item, path)| self.image_at(item, path)).collect()
    }

    fn same_sizes(&self, source: Item<'_>, slices: &[Handle<Image>]) -> Result<()> {
        let images = &self.scene.images;
        let first = &images[slices[0]];
        for &slice in slices {
            let image = &images[slice];
            if (image.width, image.height) != (first.width, first.height) {
                let message = format!(
                    "slice {} is {} x {}, but {} is {} x {}",
                    shown(images.name(slice)),
                    image.width,
                    image.height,
                    shown(images.name(slices[0])),
                    first.width,
                    first.height
                );
                return Err(source.error(message).help("make all slices of one size"));
            }
        }
        Ok(())
    }

    /// The picture of a path, loaded once.
    pub(super) fn image_at(&mut self, item: Item<'_>, path: PathBuf) -> Result<Handle<Image>> {
        let identity = identity(&path);
        if let Some(&handle) = self.images.get(&identity) {
            return Ok(handle);
        }
        self.need_file(item.node.spot, &path)?;
        let image = self.assets.image(&path).map_err(|error| self.sources.locate(item.node.spot, error))?;
        let handle = self.scene.images.add(path.display().to_string(), image);
        self.images.insert(identity, handle);
        Ok(handle)
    }
}

/// One word, or three for x, y and z.
fn wrap(item: Item<'_>) -> Result<[Wrap; 3]> {
    if !item.is_list() {
        return item.choice(&WRAPS).map(|all| [all; 3]);
    }
    let choices: Vec<_> = item.list("a list")?.map(|one| one.choice(&WRAPS)).collect::<Result<_>>()?;
    <[Wrap; 3]>::try_from(choices).map_err(|_| item.mismatch("one word or three"))
}

/// A name with a number in the place of its one `%d` or `%0Nd`.
fn numbered(pattern: &str, number: u32) -> Option<String> {
    let (before, rest) = pattern.split_once('%')?;
    let (digits, after) = rest.split_once('d')?;
    let width = match digits {
        "" => 0,
        _ => digits.strip_prefix('0')?.parse::<usize>().ok().filter(|width| *width <= 9)?,
    };
    (!after.contains('%')).then(|| format!("{before}{number:0width$}{after}"))
}

#[cfg(test)]
mod tests {
    use super::numbered;

    #[test]
    fn numbers_have_their_place() {
        assert_eq!(numbered("a/%d.png", 12).unwrap(), "a/12.png");
        assert_eq!(numbered("%04d", 12).unwrap(), "0012");
        assert_eq!(numbered("x%02dy", 123).unwrap(), "x123y");
        for wrong in ["a.png", "%", "%3d", "%d%d", "%xd", "%099d"] {
            assert_eq!(numbered(wrong, 1), None, "{wrong}");
        }
    }
}
