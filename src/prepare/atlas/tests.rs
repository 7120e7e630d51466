use super::*;
use crate::scene::{
    Channel, ColorSpace, Coordinates, ImageTexture, PatternSpace, Scene, StackTexture, TexelFilter, Texels,
    UvTransform, Wrap,
};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn image([width, height]: [u32; 2], kind: u32) -> Image {
    let value = |i: u32| i * 7 + 3;
    let count = 0..width * height;
    let texels = match kind {
        0 => Texels::Rgba8(count.map(|i| [0, 1, 2, 3].map(|c| (value(i) + c) as u8)).collect()),
        1 => Texels::Rgba16(count.map(|i| [0, 1, 2, 3].map(|c| (value(i) + c) as u16)).collect()),
        2 => Texels::RgbaF32(count.map(|i| [0.5 * (value(i) % 100) as f32; 4]).collect()),
        _ => Texels::RgbaF32(count.map(|i| [1.0 / value(i) as f32; 4]).collect()),
    };
    Image { width, height, texels }
}

fn texture(image: Handle<Image>, color_space: ColorSpace) -> ImageTexture {
    ImageTexture {
        image,
        filter: TexelFilter::Trilinear,
        wrap: [Wrap::Repeat; 2],
        uv: UvTransform::default(),
        color_space,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    }
}

fn slices(slices: Vec<Handle<Image>>) -> StackTexture {
    StackTexture {
        slices,
        smooth: true,
        wrap: [Wrap::Repeat; 3],
        space: PatternSpace::new(Coordinates::Object),
        color_space: ColorSpace::Linear,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    }
}

/// All words, with each page written once and each image looked at once.
fn filled(atlas: &Atlas, scene: &Scene) -> Vec<[u32; 4]> {
    let mut asked = BTreeMap::new();
    let mut words = vec![None; atlas.words()];
    let give = |handle| {
        *asked.entry(handle).or_insert(0) += 1;
        scene.images.shared(handle)
    };
    let write = |first: usize, page: &[[u32; 4]]| {
        for (word, from) in words[first..][..page.len()].iter_mut().zip(page) {
            assert!(word.replace(*from).is_none());
        }
        Ok(())
    };
    atlas.fill(give, write).unwrap();
    assert!(asked.values().all(|&times| times == 1));
    words.into_iter().map(Option::unwrap).collect()
}

fn assert_there(words: &[[u32; 4]], atlas: &Atlas, place: Place, read: &Reader<'_>) {
    let (base, pitch) = atlas.address(place);
    let [width, height] = place.format.words([read.image.width, read.image.height]);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        assert_eq!(words[(base + y * pitch + x) as usize], read.word(place.format, x, y), "{x} {y}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn every_picture_and_level_is_where_the_layout_says(
        pictures in prop::collection::vec((1..40_u32, 1..40_u32, 0..4_u32, any::<bool>(), any::<bool>()), 1..12)
    ) {
        let mut scene = Scene::default();
        let mut layout = Layout::default();
        let mut placed = Vec::new();
        for (width, height, kind, srgb, pyramid) in pictures {
            let handle = scene.images.add("picture", image([width, height], kind));
            let space = if srgb { ColorSpace::Srgb } else { ColorSpace::Linear };
            placed.push((handle, true, layout.place(&scene, &texture(handle, space), pyramid).unwrap(), srgb));
            // A second look at it, in another way
            placed.push((handle, false, layout.place(&scene, &texture(handle, ColorSpace::Linear), false).unwrap(), false));
        }
        let of_stack: Vec<_> = (0..3).map(|kind| scene.images.add("slice", image([9, 5], kind))).collect();
        let stack = layout.stack(&scene, &slices(of_stack.clone())).unwrap();
        let atlas = layout.finish();
        let words = filled(&atlas, &scene);
        for (handle, with_levels, placed, decode) in placed {
            let whole = Reader { image: &scene.images[handle], decode };
            assert_there(&words, &atlas, placed.picture, &whole);
            let mut level = halved(&whole);
            for &place in placed.above.iter().filter(|_| with_levels) {
                assert_there(&words, &atlas, place, &Reader { image: &level, decode: false });
                level = halved(&Reader { image: &level, decode: false });
            }
        }
        for (&slice, k) in of_stack.iter().zip(0..) {
            let (_, pitch) = atlas.address(stack.place);
            let place = Place { word: stack.place.word + k * stack.slice_words * pitch, ..stack.place };
            assert_there(&words, &atlas, place, &Reader { image: &scene.images[slice], decode: false });
        }
    }
}

#[test]
fn what_cannot_be_written_ends_the_work() {
    let mut scene = Scene::default();
    let handle = scene.images.add("picture", image([4, 4], 0));
    let mut layout = Layout::default();
    layout.place(&scene, &texture(handle, ColorSpace::Linear), true).unwrap();
    let failed = |_, _: &[_]| Err(crate::Error::device("full"));
    assert!(layout.finish().fill(|handle| scene.images.shared(handle), failed).is_err());
    assert_eq!(Atlas::default().words(), 0);
}
