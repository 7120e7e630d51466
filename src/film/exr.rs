//! OpenEXR: all planes of a picture in one part of 32-bit floats.

use std::io::{self, Cursor};

use ::exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Compression, Encoding, FlatSamples, Image,
    ImageAttributes, IntegerBounds, Layer, LayerAttributes, LineOrder, Text, Vec2, WritableImage,
};

use super::{Frame, Meta, Picture};
use crate::scene;

/// Bytes of an EXR file: the data window is the window of the picture, the display window all of it. The same
/// input gives the same bytes.
pub(super) fn encode(picture: &Picture, film: &scene::Film, meta: &Meta) -> io::Result<Vec<u8>> {
    file(&picture.frame, channels(picture, film.transparent), attributes(meta))
}

/// Bytes of an EXR file with these channels over the window of a picture.
pub(super) fn file<const N: usize>(
    frame: &Frame,
    channels: Vec<AnyChannel<FlatSamples>>,
    attributes: [(Text, AttributeValue); N],
) -> io::Result<Vec<u8>> {
    let whole = |v: u32| {
        i32::try_from(v).map_err(|_| io::Error::other(format!("{v} pixels, an EXR has at most {}", i32::MAX)))
    };
    whole(frame.width)?;
    whole(frame.height)?;
    let mut own = LayerAttributes {
        layer_position: Vec2(whole(frame.window.x0)?, whole(frame.window.y0)?),
        software_name: Text::new_or_none(format!("dapple {}", env!("CARGO_PKG_VERSION"))),
        ..Default::default()
    };
    own.other.extend(attributes);
    let shared = ImageAttributes::new(IntegerBounds::from_dimensions(Vec2(
        frame.width as usize,
        frame.height as usize,
    )));
    let layer = Layer::new(
        (frame.window.width() as usize, frame.window.height() as usize),
        own,
        // Increasing lines, because blocks in the order in which threads finish would change the bytes
        Encoding {
            compression: Compression::ZIP16,
            blocks: Blocks::ScanLines,
            line_order: LineOrder::Increasing,
        },
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut file = Cursor::new(Vec::new());
    Image::new(shared, layer).write().to_buffered(&mut file).map_err(|error| match error {
        ::exr::error::Error::Io(error) => error,
        other => io::Error::other(other),
    })?;
    let mut bytes = file.into_inner();
    sort_attributes(&mut bytes)?;
    Ok(bytes)
}

/// All channels of the file. The number of samples is a float like the others, which readers that know one type
/// a file prefer; it is exact up to 2^24, above what a film can hold.
fn channels(picture: &Picture, transparent: bool) -> Vec<AnyChannel<FlatSamples>> {
    let plane = |name: &str, values: Vec<f32>| AnyChannel::new(name, FlatSamples::F32(values));
    let part = |values: &[[f32; 3]], c: usize| values.iter().map(|v| v[c]).collect::<Vec<_>>();
    let mut list = Vec::new();
    for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
        list.push(plane(name, part(&picture.rgb, c)));
        list.push(plane(&format!("albedo.{name}"), part(&picture.albedo, c)));
        list.push(plane(&format!("variance.{name}"), part(&picture.variance, c)));
    }
    for (c, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        list.push(plane(&format!("normal.{name}"), part(&picture.normal, c)));
    }
    list.push(plane("depth.Z", picture.depth.clone()));
    list.push(plane("samples", picture.samples.iter().map(|&n| n as f32).collect()));
    if transparent {
        list.push(plane("A", picture.alpha.clone()));
    }
    list
}

/// What made the picture. Whole numbers that may exceed 2^31 are doubles, which hold them exactly.
fn attributes(meta: &Meta) -> [(Text, AttributeValue); 4] {
    [
        ("dapple.seed", f64::from(meta.seed)),
        ("dapple.samplesPerPixel", f64::from(meta.samples_per_pixel)),
        ("dapple.radianceUnit", 2f64.powi(meta.radiance_exponent)),
        ("dapple.depthUnit", 2f64.powi(meta.depth_exponent)),
    ]
    .map(|(name, value)| (Text::from(name), AttributeValue::F64(value)))
}

/// Sorts the attributes of the header by name. The encoder keeps some in a hash map, whose order changes from
/// run to run; their order means nothing to readers, and sorting moves nothing behind the header.
///
/// An attribute is: name, zero, type, zero, size in 4 bytes, value; an empty name ends the header
/// (<https://openexr.com/en/latest/OpenEXRFileLayout.html>, "Header").
fn sort_attributes(file: &mut [u8]) -> io::Result<()> {
    const BEFORE_HEADER: usize = 8; // magic number and version
    let broken = || io::Error::other("the encoder made a header that cannot be read");
    let header = file.get(BEFORE_HEADER..).ok_or_else(broken)?;
    let after_text = |from: usize| {
        header.get(from..).and_then(|rest| rest.iter().position(|&b| b == 0)).map(|at| from + at + 1)
    };
    let mut attributes = Vec::new();
    let mut start = 0;
    while header.get(start).ok_or_else(broken)? != &0 {
        let size_at = after_text(start).and_then(after_text).ok_or_else(broken)?;
        let size = header.get(size_at..).and_then(|rest| rest.first_chunk::<4>()).ok_or_else(broken)?;
        let end = size_at + 4 + u32::from_le_bytes(*size) as usize;
        attributes.push(header.get(start..end).ok_or_else(broken)?);
        start = end;
    }
    // Names end with a zero, which sorts before any letter, so whole attributes sort by name
    attributes.sort_unstable();
    let sorted = attributes.concat();
    file[BEFORE_HEADER..BEFORE_HEADER + sorted.len()].copy_from_slice(&sorted);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::tests::picture_of;
    use crate::scene::Rect;
    use ::exr::prelude::{FlatImage, ReadChannels, ReadLayers, read};

    const WINDOW: Rect = Rect { x0: 3, y0: 1, x1: 43, y1: 38 };
    const META: Meta =
        Meta { seed: u32::MAX, samples_per_pixel: 64, radiance_exponent: -24, depth_exponent: -12 };

    /// A picture whose values all differ, with a miss in the first pixel.
    fn sample() -> Picture {
        let mut picture = picture_of(50, 40, WINDOW);
        let mut next = 0.0f32;
        let mut value = || {
            next += 0.37;
            next
        };
        let mut triple =
            |list: &mut Vec<[f32; 3]>| list.iter_mut().for_each(|v| *v = [(); 3].map(|()| value()));
        triple(&mut picture.rgb);
        triple(&mut picture.albedo);
        triple(&mut picture.normal);
        triple(&mut picture.variance);
        picture.alpha.iter_mut().for_each(|v| *v = value());
        picture.depth.iter_mut().for_each(|v| *v = value());
        picture.depth[0] = f32::INFINITY;
        picture.samples.iter_mut().zip(1..).for_each(|(v, i)| *v = i);
        picture.samples[1] = crate::scene::MAX_SAMPLES;
        picture
    }

    fn write_and_read(picture: &Picture, transparent: bool) -> FlatImage {
        let film = scene::Film { transparent, ..Default::default() };
        let file = encode(picture, &film, &META).unwrap();
        let reader = read().no_deep_data().largest_resolution_level().all_channels().all_layers();
        reader.all_attributes().from_buffered(Cursor::new(file)).unwrap()
    }

    fn values(image: &FlatImage, name: &str) -> Vec<f32> {
        let channel = image.layer_data[0].channel_data.list.iter().find(|c| c.name == *name).unwrap();
        match &channel.sample_data {
            FlatSamples::F32(values) => values.clone(),
            _ => panic!("{name} is not 32-bit float"),
        }
    }

    #[test]
    fn channels_windows_and_values_come_back() {
        let picture = sample();
        let image = write_and_read(&picture, true);
        assert_eq!(image.layer_data.len(), 1);
        let names: Vec<_> =
            image.layer_data[0].channel_data.list.iter().map(|c| c.name.to_string()).collect();
        let expected = "A B G R albedo.B albedo.G albedo.R depth.Z normal.X normal.Y normal.Z samples \
                        variance.B variance.G variance.R";
        assert_eq!(names, expected.split_whitespace().collect::<Vec<_>>());
        assert_eq!(image.attributes.display_window, IntegerBounds::from_dimensions(Vec2(50, 40)));
        assert_eq!(image.layer_data[0].absolute_bounds(), IntegerBounds::new((3, 1), (40, 37)));
        assert_eq!(image.layer_data[0].encoding.compression, Compression::ZIP16);
        for (layer, list) in
            [("", &picture.rgb), ("albedo.", &picture.albedo), ("variance.", &picture.variance)]
        {
            for (c, channel) in ["R", "G", "B"].iter().enumerate() {
                let expected: Vec<f32> = list.iter().map(|v| v[c]).collect();
                assert_eq!(values(&image, &format!("{layer}{channel}")), expected);
            }
        }
        for (c, channel) in ["X", "Y", "Z"].iter().enumerate() {
            let expected: Vec<f32> = picture.normal.iter().map(|v| v[c]).collect();
            assert_eq!(values(&image, &format!("normal.{channel}")), expected);
        }
        assert_eq!(values(&image, "A"), picture.alpha);
        assert_eq!(values(&image, "depth.Z"), picture.depth);
        let samples: Vec<u32> = values(&image, "samples").iter().map(|&n| n as u32).collect();
        assert_eq!(samples, picture.samples);
    }

    #[test]
    fn attributes_come_back() {
        let image = write_and_read(&sample(), false);
        let own = &image.layer_data[0].attributes;
        assert_eq!(
            own.software_name.as_ref().unwrap().to_string(),
            concat!("dapple ", env!("CARGO_PKG_VERSION"))
        );
        let number = |name: &str| match own.other.get(&Text::from(name)) {
            Some(AttributeValue::F64(value)) => *value,
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(number("dapple.seed"), 4_294_967_295.0);
        assert_eq!(number("dapple.samplesPerPixel"), 64.0);
        assert_eq!(number("dapple.radianceUnit"), 1.0 / 16_777_216.0);
        assert_eq!(number("dapple.depthUnit"), 1.0 / 4096.0);
    }

    #[test]
    fn opaque_pictures_have_no_alpha() {
        let image = write_and_read(&sample(), false);
        assert!(image.layer_data[0].channel_data.list.iter().all(|c| c.name != *"A"));
    }

    #[test]
    fn same_picture_same_bytes() {
        let (picture, film) = (sample(), scene::Film::default());
        let first = encode(&picture, &film, &META).unwrap();
        // Four attributes in a hash map have 24 orders: 8 equal files by chance are unlikely
        for _ in 0..8 {
            assert!(encode(&picture, &film, &META).unwrap() == first);
        }
    }

    #[test]
    fn refuses_headers_that_do_not_end() {
        let mut file = encode(&sample(), &scene::Film::default(), &META).unwrap();
        assert!(sort_attributes(&mut file).is_ok());
        assert!(sort_attributes(&mut file[..100]).is_err());
        assert!(sort_attributes(&mut file[..5]).is_err());
    }
}
