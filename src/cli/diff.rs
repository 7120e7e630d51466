//! `dapple diff`: how far two pictures are apart.

use super::args::DiffArgs;
use super::console::Console;
use dapple::diff::{Estimate, Verdict, compare, flip, read, read_variance, relative_mse, write_panel};
use dapple::{Error, Result};
use serde::Serialize;

/// What a comparison found.
#[derive(Debug, Serialize)]
struct Findings {
    rel_mse: f64,
    /// Mean ꟻLIP error.
    flip: f64,
    /// Pixels with any channel that differs.
    different_pixels: usize,
    /// The statistical test, where the variance of the reference is known.
    test: Option<Test>,
    agree: bool,
}

/// Numbers of the statistical test; none when the pictures cannot be put to it.
#[derive(Debug, Serialize)]
struct Test {
    accepted: bool,
    /// The line that says it all.
    words: String,
    /// Part of the pixels that agree, and of the blocks.
    pixels: Option<f64>,
    blocks: Option<f64>,
    mean_off: Option<f64>,
}

/// Compares, prints, writes the picture of the difference; an error when the pictures differ.
pub fn run(args: &DiffArgs, console: &mut Console) -> Result<()> {
    let (reference, noise_is_known) = reference(args)?;
    let picture = read(&args.picture)?.estimate;
    let size = |e: &Estimate| (e.width, e.height);
    if size(&reference) != size(&picture) {
        let (a, b) = (size(&reference), size(&picture));
        let message = format!("{} × {} pixels, the reference has {} × {}", b.0, b.1, a.0, a.1);
        return Err(Error::scene(message).help("render both in one size").in_file(&args.picture));
    }
    let errors = flip(&reference, &picture);
    let findings = Findings::of(args, &reference, &picture, errors.mean(), noise_is_known);
    if let Some(path) = &args.output {
        write_panel(path, &reference, &picture, &errors)?;
    }
    if args.json {
        console.event(&findings);
    } else {
        console.result(&findings.words());
    }
    if findings.agree { Ok(()) } else { Err(Error::output("the pictures differ").in_file(&args.picture)) }
}

/// The reference, and whether its variance is known.
fn reference(args: &DiffArgs) -> Result<(Estimate, bool)> {
    let reading = read(&args.reference)?;
    let mut reference = reading.estimate;
    let Some(path) = &args.variance else { return Ok((reference, reading.noise_is_known)) };
    reference.variance = read_variance(path)?;
    if reference.variance.len() != reference.mean.len() {
        return Err(Error::scene("the variance has not as many pixels as the reference").in_file(path));
    }
    Ok((reference, true))
}

impl Findings {
    fn of(
        args: &DiffArgs,
        reference: &Estimate,
        picture: &Estimate,
        flip: f64,
        noise_is_known: bool,
    ) -> Self {
        let rel_mse = relative_mse(&reference.mean, &picture.mean);
        let different_pixels = reference.mean.iter().zip(&picture.mean).filter(|(a, b)| a != b).count();
        let test = noise_is_known.then(|| Test::of(&compare(reference, picture, args.systematic)));
        let limits = [(rel_mse, args.max_rel_mse), (flip, args.max_flip)];
        let mut judged: Vec<bool> =
            limits.iter().filter_map(|(value, most)| Some(*value <= (*most)?)).collect();
        judged.extend(test.as_ref().map(|test| test.accepted));
        if judged.is_empty() {
            judged.push(different_pixels == 0);
        }
        let agree = judged.iter().all(|good| *good);
        Self { rel_mse, flip, different_pixels, test, agree }
    }

    fn words(&self) -> String {
        let test = self.test.as_ref().map_or("not done: no variance of the reference", |test| &test.words);
        format!(
            "relMSE            {:.3e}\nꟻLIP              {:.4}\ndifferent pixels  {}\nstatistical test  {test}",
            self.rel_mse, self.flip, self.different_pixels
        )
    }
}

impl Test {
    fn of(verdict: &Verdict) -> Self {
        let measured = match verdict {
            Verdict::Measured(measured) => Some(measured),
            Verdict::Refused(_) => None,
        };
        Self {
            accepted: verdict.accepted(),
            words: verdict.to_string(),
            pixels: measured.map(|m| m.pixels),
            blocks: measured.map(|m| m.blocks),
            mean_off: measured.map(|m| m.mean_off),
        }
    }
}
