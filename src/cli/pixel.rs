//! The values of one pixel, for `--pixel`.

use super::console::Console;
use super::event::Event;
use super::parse::Pixel;
use dapple::film::Picture;
use dapple::{Error, Result};

/// Prints the first pixel of a picture, which holds only that.
pub fn print(picture: &Picture, pixel: Pixel, console: &mut Console) -> Result<()> {
    let values = values(picture, pixel).ok_or_else(|| Error::device("the picture has no pixel"))?;
    if console.json() {
        console.event(&values);
    } else {
        console.result(&words(picture, pixel));
    }
    Ok(())
}

fn values(picture: &Picture, Pixel { x, y }: Pixel) -> Option<Event> {
    Some(Event::Pixel {
        x,
        y,
        rgb: *picture.rgb.first()?,
        alpha: *picture.alpha.first()?,
        albedo: *picture.albedo.first()?,
        normal: *picture.normal.first()?,
        depth: Some(*picture.depth.first()?).filter(|depth| depth.is_finite()),
        variance: *picture.variance.first()?,
        samples: *picture.samples.first()?,
    })
}

/// A name and its numbers a line.
fn words(picture: &Picture, Pixel { x, y }: Pixel) -> String {
    let three =
        |plane: &[[f32; 3]]| plane.first().map_or_else(String::new, |[a, b, c]| format!("{a} {b} {c}"));
    let one = |plane: &[f32]| plane.first().map_or_else(String::new, f32::to_string);
    let rows = [
        ("pixel", format!("{x} {y}")),
        ("rgb", three(&picture.rgb)),
        ("alpha", one(&picture.alpha)),
        ("albedo", three(&picture.albedo)),
        ("normal", three(&picture.normal)),
        ("depth", one(&picture.depth)),
        ("variance", three(&picture.variance)),
        ("samples", picture.samples.first().map_or_else(String::new, u32::to_string)),
    ];
    rows.map(|(name, value)| format!("{name:<8} {value}")).join("\n")
}
