//! OpenEXR files.

use super::image::{check_plausible, check_size, finite};
use crate::scene::{Image, Texels};
use crate::{Error, Result};
use exr::prelude::{FlatSamples, MetaData, ReadChannels, ReadLayers, Text, Vec2, read};
use std::io::Cursor;

/// Decodes the first part of a file over its data window. R, G, B and A are taken when there is R, G or B; else Y
/// and A, or the only channel, as grey. Missing colours are 0, missing alpha is 1.
pub(super) fn decode(bytes: &[u8]) -> Result<Image> {
    // The headers say what will be allocated.
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(refused)?;
    let header = meta.headers.first().ok_or_else(|| Error::scene("the EXR file has no parts"))?;
    if header.deep {
        return Err(Error::scene("the EXR file has deep data").help("flatten it"));
    }
    if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(Error::scene("the EXR file has channels of less resolution than others")
            .help("write it again as R, G, B"));
    }
    let (width, height) = check_size(header.layer_size.width(), header.layer_size.height())?;
    check_plausible(header.total_pixel_bytes() as u64 * 8, bytes)?;

    let read = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let picture = read.all_attributes().non_parallel().from_buffered(Cursor::new(bytes)).map_err(refused)?;
    let channels = picture.layer_data.channel_data.list;
    let find = |name: &str| channels.iter().find(|c| c.name == *name).map(|c| &c.sample_data);
    let grey = || match &channels[..] {
        [only] => Some(&only.sample_data),
        _ => find("Y"),
    };
    let sources = match (find("R"), find("G"), find("B")) {
        (None, None, None) => {
            let grey = grey().ok_or_else(|| no_colour(channels.iter().map(|c| &c.name)))?;
            [Some(grey), Some(grey), Some(grey), find("A")]
        }
        (r, g, b) => [r, g, b, find("A")],
    };
    let mut texels = vec![[0.0, 0.0, 0.0, 1.0]; width as usize * height as usize];
    for (channel, samples) in sources.into_iter().enumerate().filter_map(|(i, s)| Some((i, s?))) {
        let values = texels.iter_mut().map(|texel| &mut texel[channel]);
        match samples {
            FlatSamples::F16(s) => values.zip(s).for_each(|(value, s)| *value = s.to_f32()),
            FlatSamples::F32(s) => values.zip(s).for_each(|(value, s)| *value = *s),
            FlatSamples::U32(s) => values.zip(s).for_each(|(value, s)| *value = *s as f32),
        }
    }
    finite(Image { width, height, texels: Texels::RgbaF32(texels) })
}

fn refused(error: exr::error::Error) -> Error {
    Error::scene(format!("the EXR file cannot be decoded: {error}"))
        .help("check that it is complete, or write it again")
}

fn no_colour<'a>(names: impl Iterator<Item = &'a Text>) -> Error {
    let names: Vec<String> = names.map(ToString::to_string).collect();
    Error::scene(format!("the EXR file has no colour, only the channels {}", names.join(", ")))
        .help("write it with R, G, B or Y")
}
