//! `dapple bake`: a texture of a scene as an image, or as a stack of slices.

use super::args::BakeArgs;
use super::console::Console;
use super::event::Event;
use super::parse::Size;
use dapple::film::{self, Format, Grid};
use dapple::gpu::{DeviceChoice, DeviceType, Gpu, validation_from_environment};
use dapple::import::read_scene;
use dapple::layout::TexturePoint;
use dapple::render::{Evaluator, backend_of};
use dapple::scene::{Handle, Scene, Texture};
use dapple::shader::{CacheOptions, Compiler, Sources};
use dapple::{Error, Result};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Columns and rows of an image of which nobody says how large it should be.
const SIZE: Size = Size { width: 256, height: 256 };
/// Points that the device is asked for at once.
const POINTS: u32 = 1 << 16;
/// Axis across an image that is not one of several slices.
const Z: usize = 2;

/// Bakes what the arguments say.
pub fn run(args: &BakeArgs, console: &mut Console) -> Result<()> {
    let range = args.range();
    if range[0] == range[1] {
        return Err(Error::scene("--range: what becomes 0 and 1 cannot be the same number"));
    }
    let files = files(&args.output, args.slices);
    let format = film::check_target(&files[0])?;
    let (scene, _) = read_scene(&args.scene, &args.set)?;
    let texture = find(&scene, &args.texture)?;
    let device = DeviceChoice {
        wanted: args.device.clone(),
        require_gpu: args.require_gpu,
        validation: validation_from_environment(),
    };
    let gpu = Arc::new(Gpu::open(&device)?);
    if gpu.info().kind == DeviceType::Cpu {
        console.note(&format!("baking on the CPU: {}", gpu.info().name));
    }
    let start = Instant::now();
    let mut compiler = Compiler::new(Sources::embedded(), CacheOptions::from_environment());
    let backend = backend_of(&gpu);
    let evaluator = Evaluator::new(gpu, &mut compiler, &scene, &[texture], backend)?;
    let size = args.size.unwrap_or(SIZE);
    let mut found = Found::default();
    for (i, file) in files.iter().enumerate() {
        let plane = match args.slices {
            Some(count) => Plane { size, axis: args.axis as usize, depth: centre(i as u32, count) },
            None => Plane { size, axis: Z, depth: 0.0 },
        };
        let mut texels = plane.values(&evaluator, texture)?;
        found.look(&mut texels, range, format);
        let grid = Grid { width: size.width, height: size.height, texels: &texels, alpha: args.alpha };
        film::write_grid(file, &grid)?;
    }
    found.tell(&files, size, start.elapsed().as_secs_f64(), console);
    Ok(())
}

/// Where the image goes, or each of its slices: `marble_007.png`.
fn files(output: &Path, slices: Option<u32>) -> Vec<PathBuf> {
    let Some(count) = slices else { return vec![output.to_owned()] };
    let digits = (count.max(1) - 1).to_string().len().max(3);
    let [stem, extension] =
        [output.file_stem(), output.extension()].map(|part| part.unwrap_or_default().to_string_lossy());
    let dot = if extension.is_empty() { "" } else { "." };
    (0..count).map(|i| output.with_file_name(format!("{stem}_{i:0digits$}{dot}{extension}"))).collect()
}

fn find(scene: &Scene, wanted: &str) -> Result<Handle<Texture>> {
    if let Some((texture, ..)) = scene.textures.iter().find(|(_, name, _)| *name == wanted) {
        return Ok(texture);
    }
    let names: Vec<_> = scene.textures.iter().map(|(_, name, _)| format!("`{name}`")).collect();
    let help = if names.is_empty() {
        "it has no textures".to_owned()
    } else {
        format!("its textures are {}", names.join(", "))
    };
    Err(Error::scene(format!("the scene has no texture `{wanted}`")).help(help))
}

/// Middle of texel `i` of `n` that fill 0 to 1.
fn centre(i: u32, n: u32) -> f32 {
    ((f64::from(i) + 0.5) / f64::from(n)) as f32
}

/// Texels side by side in the unit cube.
struct Plane {
    size: Size,
    /// The axis across it: 0 is x.
    axis: usize,
    /// Where it is on that axis.
    depth: f32,
}

impl Plane {
    /// The values in the middles of all texels, row by row from the top.
    fn values(&self, evaluator: &Evaluator, texture: Handle<Texture>) -> Result<Vec<[f32; 4]>> {
        let Size { width, height } = self.size;
        let (area, mut values) = (width as usize * height as usize, Vec::new());
        values.try_reserve_exact(area).map_err(|_| {
            Error::device(format!("the system refuses memory for {width} x {height} texels"))
                .help("bake a smaller image")
        })?;
        let rows_at_once = (POINTS / width).max(1);
        for first in (0..height).step_by(rows_at_once as usize) {
            let rows = first..height.min(first + rows_at_once);
            let points: Vec<_> =
                rows.flat_map(|row| (0..width).map(move |column| self.point(column, row))).collect();
            values.extend(evaluator.values(texture, &points)?);
        }
        Ok(values)
    }

    /// The middle of a texel. Columns are along the axis after that across the plane, rows upwards along the one after that.
    fn point(&self, column: u32, row: u32) -> TexturePoint {
        let uv = [centre(column, self.size.width), centre(self.size.height - 1 - row, self.size.height)];
        let (mut position, mut normal) = ([0.0; 3], [0.0; 3]);
        position[self.axis] = self.depth;
        position[(self.axis + 1) % 3] = uv[0];
        position[(self.axis + 2) % 3] = uv[1];
        normal[self.axis] = 1.0;
        TexturePoint {
            position,
            object_position: position,
            uv,
            uv1: uv,
            vertex_color: [1.0; 4],
            normal,
            object_normal: normal,
            ..TexturePoint::default()
        }
    }
}

/// What the values were.
struct Found {
    /// Least and greatest of red, green and blue, before `--range`.
    least: [f32; 3],
    greatest: [f32; 3],
    /// Texels with a colour that a PNG cannot hold.
    clamped: u64,
    /// Texels that were not finite.
    not_finite: u64,
    texels: u64,
}

impl Default for Found {
    fn default() -> Self {
        let (least, greatest) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        Self { least, greatest, clamped: 0, not_finite: 0, texels: 0 }
    }
}

impl Found {
    /// Notes what there is, and puts the range at 0 to 1.
    fn look(&mut self, texels: &mut [[f32; 4]], [low, high]: [f64; 2], format: Format) {
        for texel in texels {
            self.texels += 1;
            if !texel.iter().all(|v| v.is_finite()) {
                self.not_finite += 1;
                *texel = texel.map(|v| if v.is_finite() { v } else { 0.0 });
            }
            let mut outside = false;
            for (c, value) in texel[..3].iter_mut().enumerate() {
                self.least[c] = self.least[c].min(*value);
                self.greatest[c] = self.greatest[c].max(*value);
                *value = ((f64::from(*value) - low) / (high - low)) as f32;
                outside |= !(0.0..=1.0).contains(value);
            }
            self.clamped += u64::from(outside && format == Format::Png);
        }
    }

    fn tell(&self, files: &[PathBuf], size: Size, seconds: f64, console: &mut Console) {
        let Self { least, greatest, clamped, not_finite, texels } = *self;
        let names: Vec<_> = files.iter().map(|file| file.to_string_lossy().into_owned()).collect();
        let shown = match names.as_slice() {
            [first, .., last] => format!("{first} to {last}"),
            _ => names.concat(),
        };
        let Size { width, height } = size;
        if console.json() {
            let size = [width, height];
            console.event(&Event::Baked {
                files: names,
                size,
                least,
                greatest,
                clamped,
                not_finite,
                seconds,
            });
            return;
        }
        if not_finite > 0 {
            console.note(&format!("warning: {not_finite} of {texels} texels were not finite and are black"));
        }
        if clamped > 0 {
            console.note(&format!(
                "warning: {clamped} of {texels} texels are outside of what a PNG holds and are clamped; say what 0 and 1 \
                 are with --range, or bake an EXR"
            ));
        }
        let least = least.into_iter().fold(f32::INFINITY, f32::min);
        let greatest = greatest.into_iter().fold(f32::NEG_INFINITY, f32::max);
        console.note(&format!(
            "{shown}: {width} x {height} texels, values from {least} to {greatest}, {seconds:.1} s"
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_have_numbers_of_one_length() {
        let names = |count| files(Path::new("a/b.c.png"), count);
        assert_eq!(names(None), [Path::new("a/b.c.png")]);
        assert_eq!(names(Some(2)), [Path::new("a/b.c_000.png"), Path::new("a/b.c_001.png")]);
        assert_eq!(names(Some(1000))[999], Path::new("a/b.c_999.png"));
        assert_eq!(names(Some(1001))[7], Path::new("a/b.c_0007.png"));
        assert_eq!(files(Path::new("a"), Some(1)), [Path::new("a_000")]);
    }

    #[test]
    fn a_range_becomes_0_to_1() {
        let mut found = Found::default();
        let mut texels = [[-1.0, 0.0, 3.0, 7.0], [f32::NAN, 1.0, 1.0, 1.0]];
        found.look(&mut texels, [-1.0, 1.0], Format::Png);
        assert_eq!(texels, [[0.0, 0.5, 2.0, 7.0], [0.5, 1.0, 1.0, 1.0]]);
        assert_eq!((found.least, found.greatest), ([-1.0, 0.0, 1.0], [0.0, 1.0, 3.0]));
        assert_eq!((found.clamped, found.not_finite, found.texels), (1, 1, 2));
    }
}
