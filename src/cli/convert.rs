//! `dapple convert`: any scene as one of dapple's own language.

use super::args::ConvertArgs;
use super::console::Console;
use super::devices::bytes_text;
use super::job::read;
use dapple::export::{Written, write_scene};
use dapple::import::{Warning, read_scene};
use dapple::{Error, Result};
use serde::Serialize;
use std::path::Path;

/// What was written.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    /// All files, the scene last.
    files: Vec<String>,
    bytes: u64,
    warnings: Vec<String>,
}

/// Reads, writes, tells.
pub fn run(args: &ConvertArgs, console: &mut Console) -> Result<()> {
    let (scene, warnings) = read(&args.scene, &args.read)?;
    if !args.json {
        warnings.iter().for_each(|warning| console.note(&format!("warning: {warning}")));
    }
    let Written { files, bytes } =
        write_scene(&scene, &args.output, args.force, &mut |path| read_back(path, &args.output))?;
    let report = Report {
        scene: args.output.display().to_string(),
        files: files.iter().map(|file| file.display().to_string()).collect(),
        bytes,
        warnings: warnings.iter().map(Warning::to_string).collect(),
    };
    if args.json {
        console.event(&report);
    } else {
        let beside = match files.len() {
            0 | 1 => String::new(),
            2 => " and 1 file beside it".to_owned(),
            n => format!(" and {} files beside it", n - 1),
        };
        console.note(&format!("wrote {}{beside}, {}", report.scene, bytes_text(bytes)));
    }
    Ok(())
}

/// Sees to it that what was written is a scene.
fn read_back(written: &Path, output: &Path) -> Result<()> {
    let Err(Error { message, help, .. }) = read_scene(written, &[]) else { return Ok(()) };
    let help = help.map_or_else(String::new, |help| format!(" ({help})"));
    Err(Error::output(format!("what would be written is no scene: {message}{help}"))
        .help("nothing was written; change that in the scene that is converted, and please report it")
        .in_file(output))
}
