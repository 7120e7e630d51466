//! `dapple convert`: any scene as one of dapple's own language.

use super::args::ConvertArgs;
use super::console::Console;
use super::devices::bytes_text;
use super::job::read;
use dapple::Result;
use dapple::export::{Written, write_scene};
use dapple::import::Warning;
use serde::Serialize;

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
    let Written { files, bytes } = write_scene(&scene, &args.output, args.force)?;
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
