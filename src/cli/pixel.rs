//! The values of one pixel, for `--pixel`.

use super::console::Console;
use super::parse::Pixel;
use dapple::film::Picture;
use dapple::{Error, Result};
use serde::Serialize;

/// All planes of a pixel, under the names that they have in an EXR.
#[derive(Debug, Serialize)]
struct Values {
    event: &'static str,
    x: u32,
    y: u32,
    rgb: [f32; 3],
    alpha: f32,
    albedo: [f32; 3],
    normal: [f32; 3],
    /// None in JSON, where there is no infinity, when nothing was hit.
    depth: Option<f32>,
    variance: [f32; 3],
    samples: u32,
}

/// Prints the pixel of a picture that holds only it.
pub fn print(picture: &Picture, pixel: Pixel, console: &mut Console) -> Result<()> {
    let values = values(picture, pixel).ok_or_else(|| Error::device("the picture has no pixel"))?;
    if console.json() {
        console.event(&values);
    } else {
        console.result(&values.words());
    }
    Ok(())
}

fn values(picture: &Picture, Pixel { x, y }: Pixel) -> Option<Values> {
    Some(Values {
        event: "pixel",
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

impl Values {
    fn words(&self) -> String {
        let three = |[a, b, c]: [f32; 3]| format!("{a} {b} {c}");
        let depth = self.depth.map_or_else(|| "inf".to_owned(), |depth| depth.to_string());
        format!(
            "pixel    {} {}\nrgb      {}\nalpha    {}\nalbedo   {}\nnormal   {}\ndepth    {depth}\nvariance {}\nsamples  {}",
            self.x,
            self.y,
            three(self.rgb),
            self.alpha,
            three(self.albedo),
            three(self.normal),
            three(self.variance),
            self.samples
        )
    }
}
