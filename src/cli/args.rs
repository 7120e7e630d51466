//! What the user typed: nothing here looks at the world.

mod diff;
mod shaders;

pub use diff::DiffArgs;
pub use shaders::{CheckShadersArgs, ExportShadersArgs, ShadersArgs, ShadersVerb};

use super::parse::{self, Pixel, Setting, Size};
use clap::{Args as ClapArgs, Parser, Subcommand};
use dapple::import::ModelChoice;
use dapple::scene::MAX_SAMPLES;
use dapple::scene::Rect;
use std::path::PathBuf;
use std::time::Duration;

mod live;
mod view;
pub use live::LiveArgs;
pub use view::View;

/// A ray tracer written in GLSL compute shaders on Vulkan
#[derive(Debug, Parser)]
#[command(name = "dapple", disable_version_flag = true, arg_required_else_help = true, after_help = AFTER_HELP)]
pub struct Args {
    /// Print the version of dapple and the device and driver that it would use
    #[arg(short = 'V', long)]
    pub version: bool,
    /// What to do
    #[command(subcommand)]
    pub command: Option<Command>,
}

const AFTER_HELP: &str = "Exit codes: 0 done, 1 the render failed, 2 bad usage or scene, 130 second Ctrl-C.\n\
    The language of scenes is described in scenes/README.md.";

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene to a PNG or EXR file
    Render(Box<RenderArgs>),
    /// Show a scene while it is edited: follows every change of the scene, its pictures and meshes, and of shaders
    Live(Box<LiveArgs>),
    /// List the Vulkan devices of this machine, and the variables that choose drivers
    Devices(DevicesArgs),
    /// Read and prepare a scene, and print what is in it; needs no device
    Check(CheckArgs),
    /// Write a scene, in whatever language it is, as a scene of dapple's own; needs no device
    Convert(ConvertArgs),
    /// Measure the speed of this machine on built-in scenes, or on one of yours
    Bench(BenchArgs),
    /// Print what a lens file is: focal length, f-number, principal planes and pupils; needs no device
    Lens(LensArgs),
    /// Turn a texture of a scene into an image, or into a stack of slices
    Bake(BakeArgs),
    /// Compare two pictures: relative error, ꟻLIP, and whether noise explains the difference; needs no device
    Diff(DiffArgs),
    /// Write the shaders of the program as files, or check those of your own; needs no device
    Shaders(ShadersArgs),
}

/// `dapple bake`.
#[derive(Debug, ClapArgs)]
#[command(after_help = BAKE_HELP)]
pub struct BakeArgs {
    /// The scene, a TOML file or a .pbrt file of pbrt-v4
    pub scene: PathBuf,
    /// Name of the texture; nothing else needs to use it
    pub texture: String,
    /// The image: .png (16 bits, linear) or .exr (32-bit floats); of slices NAME_000.png and so on
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Size of the image, or of each slice, in texels; default: 256x256
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub size: Option<Size>,
    /// Bake the unit cube in so many slices
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub slices: Option<u32>,
    /// The axis that goes through the slices
    #[arg(long, value_enum, default_value = "z", requires = "slices")]
    pub axis: Axis,
    /// Values that are written as 0 and 1; default: 0 1
    #[arg(long, num_args = 2, value_names = ["LOW", "HIGH"], allow_negative_numbers = true, value_parser = parse::finite)]
    pub range: Option<Vec<f64>>,
    /// Write alpha too, as it is
    #[arg(long)]
    pub alpha: bool,
    /// Device, by its number or a part of its name as `dapple devices` shows them
    #[arg(long, value_name = "NAME|INDEX")]
    pub device: Option<String>,
    /// Fail rather than bake on a CPU
    #[arg(long)]
    pub require_gpu: bool,
    /// Change a key of the scene, such as texture.marble.octaves=3; may be given several times
    #[arg(long, value_name = "key=value", value_parser = parse::setting)]
    pub set: Vec<Setting>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

const BAKE_HELP: &str = "Values are those of points, in the middles of texels, without a filter. An image is u to the right and v \
    upwards from 0 to 1, on the square of x and y from 0 to 1 at z = 0. Slices fill the cube from 0 to 1: columns are along \
    the axis after that of the slices, rows upwards along the one after that. World and object space are one.\n\
    A PNG is linear: read it with color_space = \"linear\".";

/// An axis of space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Axis {
    X,
    Y,
    Z,
}

impl BakeArgs {
    /// Values that become 0 and 1.
    pub fn range(&self) -> [f64; 2] {
        match self.range.as_deref() {
            Some([low, high]) => [*low, *high],
            _ => [0.0, 1.0],
        }
    }
}

/// `dapple lens`.
#[derive(Debug, ClapArgs)]
pub struct LensArgs {
    /// The lens file
    pub file: PathBuf,
    /// Focus on a plane so far in front of the film, in millimetres; default: on infinity
    #[arg(long, value_name = "MM", value_parser = parse::positive)]
    pub focus: Option<f64>,
    /// Stop down to an f-number; default: wide open
    #[arg(long, value_name = "N", value_parser = parse::positive)]
    pub f_number: Option<f64>,
    /// What the distances in the file are; default: what the end of the column shows that is 0
    #[arg(long, value_enum)]
    pub spacing: Option<Spacing>,
    /// Draw the lens, cut along its axis, with rays
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// What the distances in a lens file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Spacing {
    /// To the next row
    Next,
    /// From the row before
    Previous,
}

impl From<Spacing> for dapple::import::Spacing {
    fn from(spacing: Spacing) -> Self {
        match spacing {
            Spacing::Next => Self::Next,
            Spacing::Previous => Self::Previous,
        }
    }
}

/// `dapple bench`.
#[derive(Debug, ClapArgs)]
pub struct BenchArgs {
    /// A scene to measure in place of the built-in ones
    pub scene: Option<PathBuf>,
    /// Samples a pixel; default: what each scene says, more where that takes less than 0.2 s
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    pub spp: Option<u32>,
    /// Rounds of which the best counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=100))]
    pub rounds: u32,
    /// Device, by its number or a part of its name as `dapple devices` shows them
    #[arg(long, value_name = "NAME|INDEX")]
    pub device: Option<String>,
    /// Fail rather than measure a CPU
    #[arg(long)]
    pub require_gpu: bool,
    /// Read the kernels from a folder, file by file
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// How kernels read; default: what suits the device
    #[arg(long, value_enum)]
    pub fetch: Option<Fetch>,
    /// Print one JSON object in place of the table
    #[arg(long)]
    pub json: bool,
    /// Write the built-in scene `blob` as DIR/blob.toml and DIR/blob.ply, and measure nothing
    #[arg(long, value_name = "DIR")]
    pub write_scene: Option<PathBuf>,
}

/// How kernels read words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Fetch {
    /// Texel buffers
    Texel,
    /// Storage buffers
    Storage,
}

/// `dapple render`.
#[derive(Debug, ClapArgs)]
#[command(after_help = RENDER_HELP)]
pub struct RenderArgs {
    /// The scene: a TOML file, a model (.gltf, .glb, .obj), or a .pbrt file of pbrt-v4
    pub scene: PathBuf,
    /// The picture: .png (sRGB) or .exr (linear, all planes); default: name of the scene with .png, in this folder
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Samples a pixel; default: what the scene says
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    pub spp: Option<u32>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub size: Option<Size>,
    /// Seed of all random numbers
    #[arg(long, value_name = "N")]
    pub seed: Option<u32>,
    /// Device, by its number or a part of its name as `dapple devices` shows them
    #[arg(long, value_name = "NAME|INDEX")]
    pub device: Option<String>,
    /// Fail rather than render on a CPU
    #[arg(long)]
    pub require_gpu: bool,
    /// Render a part of the picture: columns x0 to x1 - 1, rows y0 to y1 - 1, row 0 on top
    #[arg(long, value_name = "x0,y0,x1,y1", value_parser = parse::crop)]
    pub crop: Option<Rect>,
    /// Stop at the first whole pass after so many seconds of rendering, and write the picture
    #[arg(long, value_name = "S", value_parser = parse::seconds)]
    pub time_limit: Option<Duration>,
    /// Render one pixel and print its values; a picture of it is written only where -o says so
    #[arg(long, value_name = "x,y", value_parser = parse::pixel, conflicts_with = "crop")]
    pub pixel: Option<Pixel>,
    /// Show something else in place of the picture, to find out about the scene
    ///
    /// Rays that meet nothing are black, but for what they cost. Exposure, tone curve and transparency of the scene do not count:
    /// a PNG has the curve of sRGB, and an EXR the numbers as they are. The picture is called SCENE.NAME.png where -o says nothing.
    #[arg(long, value_enum, value_name = "NAME")]
    pub view: Option<View>,
    /// Number of the first sample of each pixel
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub first_sample: u32,
    /// Folder of shaders that come before those of the program; `dapple shaders` writes one
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// Show the picture as it grows in tev, which runs already
    #[arg(long, value_name = "HOST:PORT")]
    pub display: Option<String>,
    /// How the scene is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print nothing but errors (and the values that --pixel asks for)
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    /// Print events as JSON, one a line, on stdout
    #[arg(long)]
    pub json: bool,
}

const RENDER_HELP: &str = "Ctrl-C, SIGTERM and --time-limit end the render at a whole pass over the picture and \
    write it. A second Ctrl-C quits at once.\n\
    DAPPLE_VALIDATION=1 loads the Vulkan validation layer and takes each of its messages as an error.";

/// How a scene is read.
#[derive(Debug, ClapArgs)]
pub struct ReadArgs {
    /// Change a key of the scene, such as render.max_depth=3; may be given several times
    #[arg(long, value_name = "key=value", value_parser = parse::setting)]
    pub set: Vec<Setting>,
    /// What is shown of models
    #[command(flatten)]
    pub model: ModelArgs,
    /// Take what is not supported, and every other warning about the scene, as an error
    #[arg(long)]
    pub strict: bool,
}

/// What is shown of the glTF models of a scene.
#[derive(Debug, ClapArgs)]
pub struct ModelArgs {
    /// Time of the animations of glTF models, in seconds; default: what the scene says, or the pose without animations
    #[arg(long, value_name = "S", value_parser = parse::finite, allow_negative_numbers = true)]
    pub time: Option<f64>,
    /// Camera of a glTF model, by its name or its number from 0; default: that of the scene, or the first of the model
    #[arg(long, value_name = "NAME|INDEX")]
    pub camera: Option<String>,
    /// Material variant of glTF models, by its name; default: what the scene says, or the materials without variants
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
}

impl ModelArgs {
    /// The same for the library.
    pub fn choice(&self) -> ModelChoice {
        ModelChoice {
            time: self.time.map(|time| time as f32),
            camera: self.camera.clone(),
            variant: self.variant.clone(),
        }
    }
}

/// `dapple devices`.
#[derive(Debug, ClapArgs)]
pub struct DevicesArgs {
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// `dapple check`.
#[derive(Debug, ClapArgs)]
pub struct CheckArgs {
    /// The scene: a TOML file, a model (.gltf, .glb, .obj), or a .pbrt file of pbrt-v4
    pub scene: PathBuf,
    /// How the scene is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// `dapple convert`.
#[derive(Debug, ClapArgs)]
pub struct ConvertArgs {
    /// The scene: a TOML file, a model (.gltf, .glb, .obj), or a .pbrt file of pbrt-v4
    pub scene: PathBuf,
    /// The scene to write, NAME.toml; meshes, pictures and lenses go into the folder NAME_files beside it. What nothing uses is left
    /// out
    pub output: PathBuf,
    /// Replace files of the same names; others in NAME_files stay
    #[arg(long)]
    pub force: bool,
    /// How the scene is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    /// Print what was written as one JSON object
    #[arg(long)]
    pub json: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_description_of_the_arguments_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn contradictions_are_refused() {
        let parse = |words: &str| Args::try_parse_from(words.split(' '));
        assert!(parse("dapple render a.toml --pixel 1,2 --spp 4 --set a.b=1 --set c.d=2").is_ok());
        for wrong in ["--pixel 1,2 --crop 0,0,1,1", "--quiet --json", "--spp 0", "--spp 1048577", "--seed -1"]
        {
            assert!(parse(&format!("dapple render a.toml {wrong}")).is_err(), "{wrong}");
        }
    }
}
