//! Pictures: PNG, JPEG, WebP, Radiance HDR and OpenEXR.

use super::exr;
use super::file::read_bytes;
use crate::scene::{Image, Texels};
use crate::{Error, Result};
use image::codecs::{hdr::HdrDecoder, jpeg::JpegDecoder, png::PngDecoder, webp::WebPDecoder};
use image::{DynamicImage, ImageDecoder, ImageError, Limits};
use std::io::{Cursor, Read};
use std::path::Path;

/// Most columns and most rows.
const LARGEST_SIDE: u32 = 16384;

/// Reads a picture, with its format taken from the content of the file and not from its name.
///
/// Numbers stay as they are stored: 8 and 16 bits for PNG, 8 for JPEG and WebP, floats for HDR and EXR. Palettes become
/// colours, CMYK becomes RGB. Of an EXR file the first part is read, over its data window: R, G, B, A, or else Y
/// or the only channel as grey. Orientation tags and colour profiles are passed over.
///
/// # Errors
/// A file that cannot be read, is of another format, is damaged, is larger than 16384 × 16384, announces more
/// pixels than its bytes could hold, or has a number that is not finite.
pub fn read_image(path: &Path) -> Result<Image> {
    decode(&read_bytes(path)?).map_err(|error| error.in_file(path))
}

/// The same from the bytes of a file.
pub(super) fn decode(bytes: &[u8]) -> Result<Image> {
    match bytes {
        [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => {
            let limits = Limits::default();
            with_decoder(PngDecoder::with_limits(Cursor::new(bytes), limits), bytes)
        }
        [0xff, 0xd8, 0xff, ..] => with_decoder(JpegDecoder::new(Cursor::new(bytes)), bytes),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => {
            with_decoder(WebPDecoder::new(Cursor::new(bytes)), bytes)
        }
        [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode(bytes),
        [b'#', b'?', ..] => {
            // `image` takes no other first line than its own; programs have written `#?RGBE` and their names.
            let first = bytes.iter().position(|&b| b == b'\n').map_or(bytes.len(), |end| end + 1);
            let rest = bytes.get(first..).unwrap_or_default();
            // Where overflow is checked, as in debug builds, `image` 0.25.10 panics on eight run markers in a row
            // (`rl_mult *= 256` in codecs/hdr/decoder.rs).
            let decode = || with_decoder(HdrDecoder::new(b"#?RADIANCE\n".chain(rest)), bytes);
            std::panic::catch_unwind(decode).unwrap_or_else(|_| {
                Err(Error::scene("the picture has too long a run of pixels").help("write it again"))
            })
        }
        _ => {
            Err(Error::scene("this is no picture of a known format").help("use PNG, JPEG, WebP, HDR or EXR"))
        }
    }
}

fn with_decoder<D: ImageDecoder>(decoder: Result<D, ImageError>, bytes: &[u8]) -> Result<Image> {
    let mut decoder = decoder.map_err(refused)?;
    let (columns, rows) = decoder.dimensions();
    let (width, height) = check_size(columns as usize, rows as usize)?;
    // A pixel takes at least 1 bit before compression.
    check_plausible(u64::from(width) * u64::from(height), bytes)?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(decoder.total_bytes().saturating_mul(2).saturating_add(64 << 20));
    decoder.set_limits(limits).map_err(refused)?;

    let picture = DynamicImage::from_decoder(decoder).map_err(refused)?;
    let texels = match picture.color().bytes_per_pixel() / picture.color().channel_count() {
        1 => Texels::Rgba8(group(picture.into_rgba8().into_raw())),
        2 => Texels::Rgba16(group(picture.into_rgba16().into_raw())),
        _ => Texels::RgbaF32(group(picture.into_rgba32f().into_raw())),
    };
    finite(Image { width, height, texels })
}

/// Refuses numbers that are not finite: one of them would spread over its neighbours by filtering, and over the
/// table by which light is chosen.
pub(super) fn finite(image: Image) -> Result<Image> {
    let Texels::RgbaF32(texels) = &image.texels else { return Ok(image) };
    let Some(at) = texels.iter().position(|texel| !texel.iter().all(|x| x.is_finite())) else {
        return Ok(image);
    };
    let (x, y) = (at % image.width as usize, at / image.width as usize);
    let named = ["red", "green", "blue", "alpha"].into_iter().zip(texels[at]);
    let wrong: Vec<String> = named
        .filter(|(_, value)| !value.is_finite())
        .map(|(name, value)| format!("{name} of the pixel {x},{y} is {value}"))
        .collect();
    Err(Error::scene(format!("{}, must be a finite number", wrong.join(", ")))
        .help("write the picture again with finite numbers, at most 65504 in 16-bit floats"))
}

/// The same channels by texels: without a copy, unless the list has room for more.
fn group<T: bytemuck::Pod>(channels: Vec<T>) -> Vec<[T; 4]> {
    bytemuck::allocation::try_cast_vec(channels)
        .unwrap_or_else(|(_, channels)| channels.as_chunks().0.to_vec())
}

fn refused(error: ImageError) -> Error {
    // Some messages of the decoders have line ends.
    let reason = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    Error::scene(format!("the picture cannot be decoded: {reason}"))
        .help("check that it is complete, or write it again")
}

/// Refuses pictures without pixels and those that are too large.
pub(super) fn check_size(columns: usize, rows: usize) -> Result<(u32, u32)> {
    let side = |n: usize| u32::try_from(n).ok().filter(|n| (1..=LARGEST_SIDE).contains(n));
    side(columns).zip(side(rows)).ok_or_else(|| {
        let limit = LARGEST_SIDE;
        Error::scene(format!(
            "the picture has {columns} × {rows} pixels, must have 1 × 1 to {limit} × {limit}"
        ))
        .help("scale it down")
    })
}

/// Refuses pictures whose size their file cannot hold. Of all methods of compression here, deflate shrinks most:
/// to 1/1032, with 258 bytes a 2-bit pair of codes.
pub(super) fn check_plausible(bits: u64, file: &[u8]) -> Result<()> {
    let most = (file.len() as u64).saturating_mul(1032 * 8).saturating_add(1 << 20);
    if bits > most {
        let message = format!("the picture announces more pixels than {} bytes can hold", file.len());
        return Err(Error::scene(message).help("check that the file is complete"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::exr::prelude::{
        AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Layer, LayerAttributes, Vec2,
        WritableImage, f16,
    };
    use image::{ColorType, ImageEncoder};
    use proptest::prelude::*;

    fn png(color: ColorType, data: &[u8], width: u32, height: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        encoder.write_image(data, width, height, color.into()).unwrap();
        bytes
    }

    fn jpeg() -> Vec<u8> {
        let mut bytes = Vec::new();
        let data: Vec<u8> = (0..16 * 16 * 3).map(|i| (i % 251) as u8).collect();
        let encoder = image::codecs::jpeg::JpegEncoder::new(&mut bytes);
        encoder.write_image(&data, 16, 16, ColorType::Rgb8.into()).unwrap();
        bytes
    }

    const HDR: &[u8] = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x00\x81\x80\x00\x00\x82";

    fn exr_file(compression: Compression, names: &[&str]) -> Vec<u8> {
        let size = Vec2(20, 10);
        let channel = |(i, name): (usize, &&str)| {
            let samples = (0..200).map(|p| f16::from_f32((p + 1000 * i) as f32)).collect();
            AnyChannel::new(*name, FlatSamples::F16(samples))
        };
        let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
        let encoding = Encoding { compression, ..Encoding::UNCOMPRESSED };
        let layer = Layer::new(size, LayerAttributes::named("l"), encoding, channels);
        let mut bytes = Cursor::new(Vec::new());
        ::exr::image::Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    }

    fn floats(bytes: &[u8]) -> Vec<[f32; 4]> {
        match decode(bytes).unwrap().texels {
            Texels::RgbaF32(texels) => texels,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn depth_is_kept_and_grey_repeated() {
        let image = decode(&png(ColorType::L8, &[7, 9], 2, 1)).unwrap();
        assert_eq!((image.width, image.height), (2, 1));
        assert_eq!(image.texels, Texels::Rgba8(vec![[7, 7, 7, 255], [9, 9, 9, 255]]));
        let image = decode(&png(ColorType::La16, &[1, 0, 2, 0], 1, 1)).unwrap();
        assert_eq!(image.texels, Texels::Rgba16(vec![[1, 1, 1, 2]]));
        let image = decode(&jpeg()).unwrap();
        assert!(matches!(image.texels, Texels::Rgba8(texels) if texels.len() == 256));
    }

    #[test]
    fn hdr_is_read_whatever_its_first_line_says() {
        let wanted = [[1.0, 0.5, 0.0, 1.0], [2.0, 0.0, 0.0, 1.0]];
        assert_eq!(floats(HDR), wanted);
        let text = HDR.strip_prefix(b"#?RADIANCE").unwrap();
        assert_eq!(floats(&[b"#?RGBE", text].concat()), wanted);
    }

    #[test]
    fn hdr_with_many_run_markers_does_not_panic() {
        let head = b"#?RGBE\n\n-Y 1 +X 16\n\x80\x40\x00\x81".to_vec();
        let _ = decode(&[head, [1, 1, 1, 0].repeat(9), vec![9; 80]].concat());
    }

    #[test]
    fn exr_channels_become_colour_or_grey() {
        let all = exr_file(Compression::ZIP16, &["A", "B", "G", "R", "Z"]);
        assert_eq!(floats(&all)[3], [3003.0, 2003.0, 1003.0, 3.0].map(|x| f16::from_f32(x).to_f32()));
        assert_eq!(floats(&exr_file(Compression::RLE, &["Y"]))[199], [199.0, 199.0, 199.0, 1.0]);
        assert_eq!(floats(&exr_file(Compression::PIZ, &["depth"]))[5], [5.0, 5.0, 5.0, 1.0]);
        assert_eq!(floats(&exr_file(Compression::PXR24, &["R"]))[5], [5.0, 0.0, 0.0, 1.0]);
        let error = decode(&exr_file(Compression::RLE, &["P", "Q"])).unwrap_err();
        assert!(error.message.contains("only the channels P, Q"), "{error}");
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused_with_their_pixel() {
        let file = |name: &str, at: usize, value: f32| {
            let mut samples = vec![1.0_f32; 12];
            samples[at] = value;
            let channels =
                AnyChannels::sort([AnyChannel::new(name, FlatSamples::F32(samples))].into_iter().collect());
            let layer = Layer::new(Vec2(4, 3), LayerAttributes::named("l"), Encoding::UNCOMPRESSED, channels);
            let mut bytes = Cursor::new(Vec::new());
            ::exr::image::Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
            bytes.into_inner()
        };
        for (name, at, value, expected) in [
            ("R", 0, f32::NAN, "red of the pixel 0,0 is NaN"),
            ("G", 6, f32::INFINITY, "green of the pixel 2,1 is inf"),
            ("B", 11, f32::NEG_INFINITY, "blue of the pixel 3,2 is -inf"),
        ] {
            let error = decode(&file(name, at, value)).unwrap_err();
            assert_eq!(error.message, format!("{expected}, must be a finite number"));
            assert!(error.help.is_some());
        }
        // With the name of the file
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sun.exr");
        std::fs::write(&path, file("R", 5, f32::NAN)).unwrap();
        let error = read_image(&path).unwrap_err();
        assert_eq!(error.place.unwrap().file, path);
        assert!(decode(&file("R", 5, f32::MAX)).is_ok());
    }

    #[test]
    fn unknown_damaged_and_absurd_files_are_errors() {
        for (bytes, part) in [
            (&b""[..], "no picture of a known format"),
            (b"GIF89a", "no picture of a known format"),
            (b"\x89PNG\r\n\x1a\n", "cannot be decoded"),
            (b"#?RGBE", "cannot be decoded"),
            (b"#?RGBE\n\n-Y 20000 +X 2\n", "2 × 20000 pixels, must have"),
            (b"#?RGBE\n\n-Y 0 +X 2\n", "2 × 0 pixels, must have"),
            (b"#?RGBE\n\n-Y 16000 +X 16000\n", "more pixels than 26 bytes can hold"),
        ] {
            let error = decode(bytes).unwrap_err();
            assert!(error.message.contains(part), "{error}");
        }
        let whole = png(ColorType::L8, &[7; 100], 10, 10);
        assert!((0..whole.len() - 12).all(|length| decode(&whole[..length]).is_err()));
        let whole = exr_file(Compression::PIZ, &["Y"]);
        assert!((0..whole.len()).all(|length| decode(&whole[..length]).is_err()));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn damaged_files_give_a_picture_or_an_error(
            kind in 0_usize..9,
            damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        ) {
            let exr = |compression| exr_file(compression, &["R", "G"]);
            let mut bytes = match kind {
                0 => png(ColorType::L8, &[7; 100], 10, 10),
                1 => jpeg(),
                2 => HDR.to_vec(),
                3 => exr(Compression::PIZ),
                4 => exr(Compression::ZIP16),
                5 => exr(Compression::RLE),
                6 => exr(Compression::B44),
                7 => exr(Compression::PXR24),
                _ => exr(Compression::Uncompressed),
            };
            for (at, byte) in damage {
                let at = at.index(bytes.len());
                bytes[at] = byte;
            }
            if let Ok(image) = decode(&bytes) {
                let pixels = image.width as usize * image.height as usize;
                let count = match image.texels {
                    Texels::Rgba8(t) => t.len(),
                    Texels::Rgba16(t) => t.len(),
                    Texels::RgbaF32(t) => t.len(),
                };
                prop_assert_eq!(count, pixels);
            }
        }
    }
}
