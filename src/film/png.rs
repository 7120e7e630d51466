//! PNG: exposure, a tone curve, 8 or 16 bits, straight alpha, and what made the picture.

use std::io;

use ::png::{BitDepth, ColorType, Encoder, EncodingError, ScaledFloat, SrgbRenderingIntent};

use super::{Meta, Picture, meter, tone};
use crate::scene::{self, ToneCurve};

/// Bytes of a PNG file of the window of the picture. The same input gives the same bytes.
pub(super) fn encode(picture: &Picture, film: &scene::Film, meta: &Meta) -> io::Result<Vec<u8>> {
    let pixels = straight(picture, film);
    let (depth, bytes) = match film.png_bits {
        8 => (BitDepth::Eight, pixels.map(|v| quantize(v, 255.0) as u8).collect()),
        16 => {
            (BitDepth::Sixteen, pixels.flat_map(|v| quantize(v, 65535.0).to_be_bytes()).collect::<Vec<u8>>())
        }
        bits => return Err(io::Error::other(format!("{bits} bits a channel, a PNG has 8 or 16"))),
    };
    let window = picture.frame.window;
    let head = Head {
        width: window.width(),
        height: window.height(),
        color: if film.transparent { ColorType::Rgba } else { ColorType::Rgb },
        depth,
        linear: film.tone_curve == ToneCurve::Linear,
        texts: &texts(meta),
    };
    file(&head, &bytes)
}

/// What a file says about its numbers.
pub(super) struct Head<'a> {
    pub width: u32,
    pub height: u32,
    pub color: ColorType,
    pub depth: BitDepth,
    /// Whether they are linear; else they are sRGB.
    pub linear: bool,
    pub texts: &'a [(&'static str, String)],
}

/// Bytes of a PNG file with these numbers, row by row from the top, the higher byte first.
pub(super) fn file(head: &Head<'_>, bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, head.width, head.height);
    encoder.set_color(head.color);
    encoder.set_depth(head.depth);
    if head.linear {
        encoder.set_source_gamma(ScaledFloat::from_scaled(100_000));
    } else {
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        // For readers that do not know the chunk of sRGB: the gamma that the standard has for them
        encoder.set_source_gamma(ScaledFloat::from_scaled(45_455));
    }
    let write = |mut encoder: Encoder<'_, _>| -> Result<(), EncodingError> {
        for (keyword, text) in head.texts {
            encoder.add_text_chunk((*keyword).to_owned(), text.clone())?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()
    };
    write(encoder).map_err(|error| match error {
        EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    })?;
    Ok(file)
}

/// What made the picture, under the names that an EXR has for it.
fn texts(meta: &Meta) -> [(&'static str, String); 3] {
    [
        software(),
        ("dapple.seed", meta.seed.to_string()),
        ("dapple.samplesPerPixel", meta.samples_per_pixel.to_string()),
    ]
}

/// Which program wrote the file.
pub(super) fn software() -> (&'static str, String) {
    ("Software", concat!("dapple ", env!("CARGO_PKG_VERSION")).to_owned())
}

/// Channels of all pixels in order, encoded but not yet rounded; alpha, where it is written, is linear.
fn straight<'a>(picture: &'a Picture, film: &scene::Film) -> impl Iterator<Item = f64> + 'a {
    let gain = meter::gain(picture, film);
    let (transparent, curve) = (film.transparent, film.tone_curve);
    picture.rgb.iter().zip(&picture.alpha).flat_map(move |(rgb, &alpha)| {
        // Colour in the film is premultiplied by coverage, in a PNG it is not
        let alpha = f64::from(alpha);
        let scale = match (transparent, alpha > 0.0) {
            (false, _) => gain,
            (true, true) => gain / alpha,
            (true, false) => 0.0,
        };
        let [r, g, b] = tone::encode(curve, rgb.map(|v| f64::from(v) * scale));
        [r, g, b, alpha].into_iter().take(if transparent { 4 } else { 3 })
    })
}

/// The nearest whole number of `1 / top`, with values outside 0 to 1 clamped.
pub(super) fn quantize(value: f64, top: f64) -> u16 {
    (value.clamp(0.0, 1.0) * top).round() as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::exr;
    use crate::film::tests::picture_of;
    use crate::film::tone::srgb;
    use crate::scene::{Exposure, Meter, Rect, Shot};
    use image::{DynamicImage, ImageReader};
    use std::io::Cursor;

    const META: Meta =
        Meta { seed: u32::MAX, samples_per_pixel: 1 << 20, radiance_exponent: -24, depth_exponent: -12 };

    fn decode(file: Vec<u8>) -> DynamicImage {
        ImageReader::with_format(Cursor::new(file), image::ImageFormat::Png).decode().unwrap()
    }

    fn film(stops: f32, png_bits: u32, transparent: bool) -> scene::Film {
        let exposure = Exposure { stops, ..Exposure::default() };
        scene::Film { exposure, png_bits, transparent, ..Default::default() }
    }

    #[test]
    fn curve_has_the_values_of_the_standard() {
        assert_eq!(srgb(0.0), 0.0);
        assert!((srgb(1.0) - 1.0).abs() < 1e-15);
        // The two pieces of the standard meet to about 1e-8, so its rounded constants leave no visible step
        assert!((srgb(0.003_130_8) - srgb(0.003_130_800_1)).abs() < 1e-7);
        // Middle values of every 8-bit code come back as that code
        for code in 0..=255u16 {
            let encoded = f64::from(code) / 255.0;
            let linear =
                if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
            assert_eq!(quantize(srgb(linear), 255.0), code);
        }
    }

    #[test]
    fn rounds_to_nearest_and_clamps() {
        assert_eq!(quantize(0.4999 / 255.0, 255.0), 0);
        assert_eq!(quantize(0.5001 / 255.0, 255.0), 1);
        assert_eq!(quantize(7.0, 255.0), 255);
        assert_eq!(quantize(-7.0, 65535.0), 0);
        assert_eq!(quantize(f64::INFINITY, 65535.0), 65535);
        assert_eq!(quantize(f64::NAN, 255.0), 0);
    }

    #[test]
    fn opaque_pictures_round_trip_in_8_and_16_bits() {
        let window = Rect { x0: 1, y0: 2, x1: 3, y1: 3 };
        let mut picture = picture_of(5, 4, window);
        picture.rgb = vec![[0.0, 0.5, 1.0], [0.25, 2.0, 0.001]];
        let eight = decode(encode(&picture, &film(0.0, 8, false), &META).unwrap());
        assert_eq!(eight.color(), image::ColorType::Rgb8);
        assert_eq!((eight.width(), eight.height()), (2, 1));
        // 0.5 is 187.5 -> 188, 0.25 is 136.96 -> 137, 0.001 is 3.29 -> 3
        assert_eq!(eight.as_bytes(), [0, 188, 255, 137, 255, 3]);
        let sixteen = decode(encode(&picture, &film(0.0, 16, false), &META).unwrap());
        assert_eq!(sixteen.color(), image::ColorType::Rgb16);
        assert_eq!(sixteen.into_rgb16().into_raw(), [0, 48192, 65535, 35199, 65535, 847]);
    }

    #[test]
    fn exposure_is_in_stops() {
        let mut picture = picture_of(1, 1, Rect { x0: 0, y0: 0, x1: 1, y1: 1 });
        picture.rgb = vec![[0.125, 0.25, 0.5]];
        let lifted = decode(encode(&picture, &film(1.0, 8, false), &META).unwrap());
        picture.rgb = vec![[0.25, 0.5, 1.0]];
        assert_eq!(
            lifted.as_bytes(),
            decode(encode(&picture, &film(0.0, 8, false), &META).unwrap()).as_bytes()
        );
    }

    #[test]
    fn exposure_and_curves_change_a_png_and_no_exr() {
        let mut picture = picture_of(1, 1, Rect { x0: 0, y0: 0, x1: 1, y1: 1 });
        picture.rgb = vec![[0.125, 0.25, 0.5]];
        let shot = Shot { shutter: 0.01, iso: 200.0, f_number: Some(2.8) };
        let exposure =
            |meter, stops| scene::Film { exposure: Exposure { meter, stops }, ..scene::Film::default() };
        let curve = |tone_curve| scene::Film { tone_curve, ..scene::Film::default() };
        let films = [
            scene::Film::default(),
            exposure(Meter::Fixed, -1.0),
            exposure(Meter::Auto, 0.0),
            exposure(Meter::Shot(shot), 0.0),
            curve(ToneCurve::Linear),
            curve(ToneCurve::Aces),
            curve(ToneCurve::Agx),
        ];
        let pixel = |film| decode(encode(&picture, film, &META).unwrap()).into_bytes();
        for (i, film) in films.iter().enumerate() {
            for other in &films[..i] {
                assert_ne!(pixel(film), pixel(other), "{film:?} and {other:?}");
            }
            let file = exr::encode(&picture, film, &META).unwrap();
            assert!(file == exr::encode(&picture, &films[0], &META).unwrap(), "{film:?}");
        }
    }

    #[test]
    fn a_linear_png_has_the_numbers_and_says_so() {
        let mut picture = picture_of(1, 1, Rect { x0: 0, y0: 0, x1: 1, y1: 1 });
        picture.rgb = vec![[0.2, 0.4, 7.0]];
        let film = scene::Film { tone_curve: ToneCurve::Linear, ..film(0.0, 8, false) };
        let file = encode(&picture, &film, &META).unwrap();
        assert_eq!(decode(file.clone()).as_bytes(), [51, 102, 255]);
        let reader = ::png::Decoder::new(Cursor::new(file)).read_info().unwrap();
        assert_eq!(reader.info().srgb, None);
        assert_eq!(reader.info().gama_chunk.map(|gamma| gamma.into_scaled()), Some(100_000));
    }

    #[test]
    fn alpha_is_straight_and_linear() {
        let mut picture = picture_of(3, 1, Rect { x0: 0, y0: 0, x1: 3, y1: 1 });
        picture.rgb = vec![[0.25, 0.125, 0.0], [0.5, 0.5, 0.5], [0.5, 0.0, 0.0]];
        picture.alpha = vec![0.5, 1.0, 0.0];
        let file = decode(encode(&picture, &film(0.0, 8, true), &META).unwrap());
        assert_eq!(file.color(), image::ColorType::Rgba8);
        assert_eq!(file.as_bytes(), [188, 137, 0, 128, 188, 188, 188, 255, 0, 0, 0, 0]);
        let file = decode(encode(&picture, &film(0.0, 16, true), &META).unwrap()).into_rgba16().into_raw();
        assert_eq!(file[..4], [48192, 35199, 0, 32768]);
    }

    #[test]
    fn says_what_made_it_and_that_it_is_srgb() {
        let picture = picture_of(1, 1, Rect { x0: 0, y0: 0, x1: 1, y1: 1 });
        for (bits, transparent) in [(8, false), (16, true)] {
            let file = encode(&picture, &film(0.0, bits, transparent), &META).unwrap();
            assert!(encode(&picture, &film(0.0, bits, transparent), &META).unwrap() == file);
            let reader = ::png::Decoder::new(Cursor::new(file)).read_info().unwrap();
            let info = reader.info();
            let texts: Vec<(&str, &str)> = info
                .uncompressed_latin1_text
                .iter()
                .map(|chunk| (chunk.keyword.as_str(), chunk.text.as_str()))
                .collect();
            let software = concat!("dapple ", env!("CARGO_PKG_VERSION"));
            let expected = [
                ("Software", software),
                ("dapple.seed", "4294967295"),
                ("dapple.samplesPerPixel", "1048576"),
            ];
            assert_eq!(texts, expected);
            assert_eq!(info.srgb, Some(SrgbRenderingIntent::RelativeColorimetric));
            assert_eq!(info.gama_chunk.map(|gamma| gamma.into_scaled()), Some(45_455));
        }
    }

    #[test]
    fn refuses_other_depths() {
        let picture = picture_of(1, 1, Rect { x0: 0, y0: 0, x1: 1, y1: 1 });
        let error = encode(&picture, &film(0.0, 12, false), &META).unwrap_err();
        assert_eq!(error.to_string(), "12 bits a channel, a PNG has 8 or 16");
    }
}
