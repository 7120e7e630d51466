//! `dapple live`.

use super::ReadArgs;
use crate::cli::parse::{self, Size};
use clap::Args as ClapArgs;
use dapple::scene::MAX_SAMPLES;
use std::net::IpAddr;
use std::path::PathBuf;

/// `dapple live`.
#[derive(Debug, ClapArgs)]
#[command(after_help = LIVE_HELP)]
pub struct LiveArgs {
    /// The scene: a TOML file, a model (.gltf, .glb, .obj), or a .pbrt file of pbrt-v4
    pub scene: PathBuf,
    /// Samples a pixel, after which it is only waited for edits
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    pub spp: u32,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub size: Option<Size>,
    /// Device, by its number or a part of its name as `dapple devices` shows them
    #[arg(long, value_name = "NAME|INDEX")]
    pub device: Option<String>,
    /// Fail rather than render on a CPU
    #[arg(long)]
    pub require_gpu: bool,
    /// Folder of shaders that come before those of the program, and are followed too
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// How the scene is read
    #[command(flatten)]
    pub read: ReadArgs,
    /// Port of the page; 0 = any that is free
    #[arg(long, value_name = "N", default_value_t = 8270, conflicts_with = "no_page")]
    pub port: u16,
    /// Address at which the page is served. Another than one of this machine alone needs a token, which is in the URL that is printed
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1", conflicts_with = "no_page")]
    pub host: IpAddr,
    /// Open the page in the browser
    #[arg(long, conflicts_with = "no_page")]
    pub open: bool,
    /// Serve no page: print only what becomes of each edit
    #[arg(long)]
    pub no_page: bool,
    /// Print events as JSON, one a line, on stdout
    #[arg(long)]
    pub json: bool,
}

const LIVE_HELP: &str = "The page shows the picture as it grows. From another machine, go through an SSH tunnel: ssh -L 8270:localhost:8270 MACHINE.\n\
    On stdout is a line for each error, as FILE:LINE:COLUMN: error: MESSAGE, and for each edit that was taken over. \
    Ctrl-C ends it.";
