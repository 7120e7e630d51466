//! How much a picture is brightened on the way to PNG.

use super::Picture;
use crate::scene::{self, Meter};

/// Pixels that are darker than this part of the mean count as black.
const BLACK: f64 = 1e-6;
/// Stops that an automatic exposure reaches.
const MOST_STOPS: f64 = 64.0;

/// The factor on all colours of a picture.
pub fn gain(picture: &Picture, film: &scene::Film) -> f64 {
    let metered = match film.exposure.meter {
        Meter::Fixed => 1.0,
        Meter::Shot(shot) => shot.gain(),
        Meter::Auto => log_average(picture, film.transparent).map_or(1.0, |average| {
            (Meter::MIDDLE_GREY / average).log2().clamp(-MOST_STOPS, MOST_STOPS).exp2()
        }),
    };
    metered * f64::from(film.exposure.stops).exp2()
}

/// The log-average luminance exp(Σ w ln Y / Σ w) (Reinhard et al. 2002, equation 1) over the pixels that are not black; w is the
/// coverage in a transparent film, else 1. None when all are black. It is taken in 64 bits in the order of the pixels.
fn log_average(picture: &Picture, transparent: bool) -> Option<f64> {
    let pixels = picture.rgb.iter().zip(&picture.alpha).map(|(rgb, &alpha)| {
        let weight = if transparent { f64::from(alpha) } else { 1.0 };
        (weight, luminance(rgb.map(f64::from)))
    });
    // Sums of w Y: colour in a transparent film is premultiplied
    let (mut weight, mut sum) = (0.0, 0.0);
    for (w, y) in pixels.clone() {
        weight += w;
        sum += y;
    }
    let black = BLACK * sum / weight;
    let (mut lit, mut logs) = (0.0, 0.0);
    for (w, y) in pixels {
        if w > 0.0 && y / w > black {
            lit += w;
            logs += w * (y / w).ln();
        }
    }
    (lit > 0.0).then(|| (logs / lit).exp())
}

/// Luminance of linear Rec. 709.
fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::tests::picture_of;
    use crate::scene::{Exposure, Rect};

    fn row(rgb: &[[f32; 3]]) -> Picture {
        let mut picture = picture_of(rgb.len() as u32, 1, Rect { x0: 0, y0: 0, x1: rgb.len() as u32, y1: 1 });
        picture.rgb = rgb.to_vec();
        picture
    }

    fn auto(picture: &Picture, transparent: bool, stops: f32) -> f64 {
        let exposure = Exposure { meter: Meter::Auto, stops };
        gain(picture, &scene::Film { exposure, transparent, ..Default::default() })
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-6 * b
    }

    #[test]
    fn an_automatic_exposure_turns_the_log_average_into_middle_grey() {
        // The geometric mean of 2 and 8 is 4, whatever is black
        let picture = row(&[[2.0; 3], [8.0; 3], [0.0; 3], [1e-9; 3]]);
        assert!(close(auto(&picture, false, 0.0), 0.18 / 4.0));
        assert!(close(auto(&picture, false, 1.0), 0.36 / 4.0));
        // Green counts for more than blue
        assert!(close(auto(&row(&[[0.0, 1.0, 0.0]]), false, 0.0), 0.18 / 0.7152));
        // A picture twice as bright gets half of the gain
        let double = row(&[[4.0; 3], [16.0; 3], [0.0; 3], [2e-9; 3]]);
        assert!(close(auto(&double, false, 0.0), 0.18 / 8.0));
    }

    #[test]
    fn what_a_transparent_film_leaves_out_has_no_weight() {
        let mut picture = row(&[[2.0; 3], [2.0; 3], [0.0; 3]]);
        picture.alpha = vec![1.0, 0.25, 0.0];
        // Straight colours 2 and 8 with weights 1 and 1/4: 2^(1 · 0.8 + 3 · 0.2)
        assert!(close(auto(&picture, true, 0.0), 0.18 / 1.4f64.exp2()));
        assert!(close(auto(&picture, false, 0.0), 0.18 / 2.0));
    }

    #[test]
    fn black_and_extreme_pictures_have_finite_exposures() {
        assert_eq!(auto(&row(&[[0.0; 3]; 2]), false, 0.0), 1.0);
        let mut hidden = row(&[[0.0; 3]; 2]);
        hidden.alpha = vec![0.0; 2];
        assert_eq!(auto(&hidden, true, 0.0), 1.0);
        assert_eq!(auto(&row(&[[1e-30; 3]]), false, 0.0), 64f64.exp2());
        assert_eq!(auto(&row(&[[1e30; 3]]), false, 0.0), (-64f64).exp2());
    }
}
