//! How bright a picture is on the way to PNG, and through which curve it goes there. EXR files have none of it.

/// Luminance of white light of 1 W/(m² sr), in cd/m²: the luminous efficacy in lm/W of equal energy over the visible spectrum, as
/// Radiance has it (Ward Larson and Shakespeare 1998, Rendering with Radiance).
const EFFICACY: f64 = 179.0;
/// Exposure of the film in lx s that saturates it at ISO 1 (ISO 12232).
const SATURATION: f64 = 78.0;
/// Part q of L t / N² that reaches the film (Lagarde and de Rousiers 2014, section 5.1.1).
const THROUGHPUT: f64 = 0.65;

/// A photograph: how long the shutter is open, and how sensitive the film is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shot {
    /// Time that the shutter is open, in seconds.
    pub shutter: f32,
    /// Speed of the film, ISO.
    pub iso: f32,
    /// The f-number of the lens; none = the picture is of the irradiance of the film, which the lens has dimmed already.
    pub f_number: Option<f32>,
}

impl Shot {
    /// The factor that turns the brightest value that the film can tell from white into 1: 1 / L_max with EV₁₀₀ = log₂(N²/t · 100/S)
    /// and L_max = 78/(100 q) · 2^EV₁₀₀ = 1.2 · 2^EV₁₀₀ cd/m² (Lagarde and de Rousiers 2014, section 5.1), or 1 / E_max with
    /// E_max = 78 / (S t) lx.
    pub fn gain(&self) -> f64 {
        let [shutter, iso] = [self.shutter, self.iso].map(f64::from);
        let throughput = self.f_number.map_or(1.0, |n| THROUGHPUT / f64::from(n).powi(2));
        EFFICACY * throughput * shutter * iso / SATURATION
    }
}

/// What decides which radiance is 1 in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meter {
    /// Radiance 1 is 1.
    Fixed,
    /// Shutter, film and lens do.
    Shot(Shot),
    /// The picture itself: its log-average luminance becomes [`Meter::MIDDLE_GREY`] (Reinhard et al. 2002, section 3.1).
    Auto,
}

impl Meter {
    /// What most scenes are on average, and grey cards are: 0.18.
    pub const MIDDLE_GREY: f64 = 0.18;
}

/// How bright a picture is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposure {
    /// What decides.
    pub meter: Meter,
    /// Compensation in stops: then the picture is brighter by 2 to this power.
    pub stops: f32,
}

impl Exposure {
    /// Stops, either way, beyond which the factor leaves 32-bit floats.
    pub const MOST_STOPS: f32 = 64.0;
}

impl Default for Exposure {
    fn default() -> Self {
        Self { meter: Meter::Fixed, stops: 0.0 }
    }
}

/// From linear colour to the numbers in a PNG.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToneCurve {
    /// The curve of sRGB (IEC 61966-2-1): a screen shows the colours as they are, up to 1.
    Srgb,
    /// No curve; the file says that it is linear.
    Linear,
    /// The film look of the Academy Color Encoding System, by Hill's fit.
    Aces,
    /// AgX of Sobotka, by Wrensch's fit.
    Agx,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The brightest luminance in cd/m².
    fn most(f_number: f32, shutter: f32, iso: f32) -> f64 {
        EFFICACY / Shot { shutter, iso, f_number: Some(f_number) }.gain()
    }

    #[test]
    fn a_shot_is_that_of_the_paper() {
        // EV₁₀₀ = 0, and one stop more by each of the three
        assert!((most(1.0, 1.0, 100.0) - 1.2).abs() < 1e-12);
        for (n, t, s) in [(2f32.sqrt(), 1.0, 100.0), (1.0, 0.5, 100.0), (1.0, 1.0, 50.0)] {
            assert!((most(n, t, s) - 2.4).abs() < 1e-6, "{n} {t} {s}");
        }
        // f/16, 1/100 s, ISO 100 in the sun: EV 14.64, and paper of 0.9 under 100,000 lx is just below white
        let (white, paper) = (most(16.0, 0.01, 100.0), 0.9 * 100_000.0 / std::f64::consts::PI);
        assert!((white - 1.2 * 25600.0).abs() < 1.0, "{white}");
        assert!(0.9 < paper / white && paper / white < 1.0, "{}", paper / white);
    }

    #[test]
    fn the_irradiance_of_a_film_has_no_f_number() {
        // 78 lx for a second at ISO 1, through a lens of f/1 that lets 0.65 through: L = 78 / 0.65
        let film = Shot { shutter: 1.0, iso: 1.0, f_number: None };
        assert!((EFFICACY / film.gain() - 78.0).abs() < 1e-12);
        let lens = Shot { f_number: Some(1.0), ..film };
        assert!((film.gain() / lens.gain() - 1.0 / 0.65).abs() < 1e-12);
    }
}
