//! Arguments of `dapple diff`.

use crate::cli::parse;
use clap::Args as ClapArgs;
use std::path::PathBuf;

/// `dapple diff`.
#[derive(Debug, ClapArgs)]
#[command(after_help = DIFF_HELP)]
pub struct DiffArgs {
    /// The picture that is right: EXR or HDR (linear), PNG or JPEG (sRGB)
    pub reference: PathBuf,
    /// The picture that is tested
    pub picture: PathBuf,
    /// Variance of the means of the reference, a picture; default: its layer `variance`
    #[arg(long, value_name = "FILE")]
    pub variance: Option<PathBuf>,
    /// Relative difference that the statistical test lets pass
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = parse::not_negative)]
    pub systematic: f64,
    /// Fail where the relative mean squared error is larger
    #[arg(long, value_name = "X", value_parser = parse::not_negative)]
    pub max_rel_mse: Option<f64>,
    /// Fail where the mean ꟻLIP error is larger
    #[arg(long, value_name = "X", value_parser = parse::not_negative)]
    pub max_flip: Option<f64>,
    /// Write a PNG with the reference, the picture, and the ꟻLIP error as colours from black to light yellow
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print what was found as a line of JSON
    #[arg(long)]
    pub json: bool,
}

const DIFF_HELP: &str = "Exit code 0 when the pictures agree, 1 when they differ. What counts: the limits that are given; the \
    statistical test when the variance of the reference is known; with neither, whether all pixels are the same.\n\
    The test: Student's t for each pixel with the level of 1 % shared out among the pixels (Šidák), of which 99.75 % must \
    agree; the same for blocks of 8 × 8 pixels, of which 99 % must; and the mean of the picture within 4 standard errors.\n\
    relMSE is the mean of (b - a)² / (a² + 0.01) over pixels and channels.";
