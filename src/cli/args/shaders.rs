//! Arguments of `dapple shaders`.

use clap::{Args as ClapArgs, Subcommand};
use std::path::PathBuf;

/// `dapple shaders`.
#[derive(Debug, ClapArgs)]
pub struct ShadersArgs {
    /// What to do with them
    #[command(subcommand)]
    pub verb: ShadersVerb,
}

/// What to do with shaders.
#[derive(Debug, Subcommand)]
pub enum ShadersVerb {
    /// Write the shaders of the program into a folder, to be changed there and given to --shaders
    Export(ExportShadersArgs),
    /// Compile and examine all variants of the kernels with a folder of shaders
    Check(CheckShadersArgs),
}

/// `dapple shaders export`.
#[derive(Debug, ClapArgs)]
pub struct ExportShadersArgs {
    /// The folder; made if it is not there
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Replace the files that are there already
    #[arg(long)]
    pub force: bool,
}

/// `dapple shaders check`.
#[derive(Debug, ClapArgs)]
#[command(after_help = CHECK_HELP)]
pub struct CheckShadersArgs {
    /// The folder of shaders, which come before those of the program as with --shaders
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Print what is found as JSON, one event a line
    #[arg(long)]
    pub json: bool,
}

const CHECK_HELP: &str = "Prints FILE:LINE:COLUMN: error: MESSAGE for each error. The exit code is 0 when there is none, else 1.\n\
    Warnings of the compiler are errors, as in a render. Some errors may follow from others above them.";

impl ShadersVerb {
    /// Whether events are asked for.
    pub fn json(&self) -> bool {
        match self {
            Self::Export(_) => false,
            Self::Check(args) => args.json,
        }
    }
}
