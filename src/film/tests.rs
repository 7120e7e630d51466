//! Tests of the sums, and pictures for the tests of the encoders.

use super::*;
use proptest::prelude::*;

/// A black picture of `width` x `height` pixels with all planes of the length of `window`.
pub(crate) fn picture_of(width: u32, height: u32, window: Rect) -> Picture {
    let seed = 0;
    let frame = Frame { width, height, window, radiance_exponent: -24, depth_exponent: -12, seed };
    Film::new(frame).unwrap().resolve()
}

const WINDOW: Rect = Rect { x0: 2, y0: 1, x1: 7, y1: 4 };
const FRAME: Frame =
    Frame { width: 8, height: 5, window: WINDOW, radiance_exponent: -24, depth_exponent: -12, seed: 7 };

/// Puts one pixel into the words of a band of `count` pixels.
fn put(words: &mut [u32], count: usize, index: usize, planes: &[[u32; 4]; 9]) {
    for (plane, values) in planes.iter().enumerate() {
        words[(plane * count + index) * 4..][..4].copy_from_slice(values);
    }
}

/// A film of one pixel with these planes.
fn pixel(planes: &[[u32; 4]; 9]) -> Film {
    let window = Rect { x0: 0, y0: 0, x1: 1, y1: 1 };
    let mut film = Film::new(Frame { width: 1, height: 1, window, ..FRAME }).unwrap();
    film.add(window, planes.as_flattened()).unwrap();
    film
}

fn low(value: i64) -> u32 {
    value as u32
}

fn high(value: i64) -> u32 {
    (value >> 32) as u32
}

#[test]
fn every_word_has_its_place() {
    let (r, g, b) = (3i64 << 24, -(1i64 << 22), 1i64 << 40);
    let depth = 10i64 << 12;
    let film = pixel(&[
        [low(r), high(r), low(g), high(g)],
        [low(b), high(b), 4, 3],
        [1, 2, 3, 5],
        [4, 5, 6, 6],
        [7, 8, 9, 99],
        [1 << 20, 0, 1 << 21, 0],
        [1 << 22, 0, low(depth), high(depth)],
        [low(-(1 << 20)), high(-(1 << 20)), 1 << 19, 0],
        [1 << 18, 0, 2, 99],
    ]);
    assert_eq!(film.pixels[0].squares, [1, 4, 7].map(|v| v | (v + 1) << 32 | (v + 2) << 64));
    assert_eq!((film.left_out(), film.clamped(), film.samples_per_pixel()), (5, 6, 4));
    let picture = film.resolve();
    assert_eq!(picture.rgb, [[0.75, -0.0625, 16384.0]]);
    assert_eq!(picture.alpha, [0.75]);
    assert_eq!(picture.albedo, [[0.25, 0.5, 1.0]]);
    assert_eq!(picture.depth, [5.0]);
    assert_eq!(picture.normal, [[-0.25, 0.125, 0.0625]]);
    assert_eq!(picture.samples, [4]);
}

#[test]
fn the_first_pixel_that_left_a_sample_out_has_its_place_in_the_picture() {
    let mut film = Film::new(FRAME).unwrap();
    assert_eq!(film.first_left_out(), None);
    let count = WINDOW.area() as usize;
    let mut words = vec![0; count * WORDS_PER_PIXEL];
    let mut planes = [[0; 4]; 9];
    planes[2][3] = 1;
    // Window of 5 columns from 2,1: pixel 8 is 5,2 and pixel 11 is 3,3
    put(&mut words, count, 8, &planes);
    put(&mut words, count, 11, &planes);
    film.add(WINDOW, &words).unwrap();
    assert_eq!(film.first_left_out(), Some([5, 2]));
}

#[test]
fn variance_is_in_squared_radiance() {
    // Red samples 1 and 3 in units of 2^-24: mean 2, variance of the mean 1
    let (unit, mut planes) = (1u64 << 24, [[0; 4]; 9]);
    planes[0][0] = (4 * unit) as u32;
    planes[1][2] = 2;
    let squares = 10 * u128::from(unit * unit);
    planes[2] = [squares as u32, (squares >> 32) as u32, (squares >> 64) as u32, 0];
    let picture = pixel(&planes).resolve();
    assert_eq!(picture.rgb, [[2.0, 0.0, 0.0]]);
    assert_eq!(picture.variance, [[1.0, 0.0, 0.0]]);
}

#[test]
fn no_samples_is_black_at_infinity() {
    let picture = Film::new(FRAME).unwrap().resolve();
    assert_eq!(picture.rgb, [[0.0; 3]; 15]);
    assert_eq!(picture.alpha, [0.0; 15]);
    assert_eq!(picture.variance, [[0.0; 3]; 15]);
    assert_eq!(picture.depth, [f32::INFINITY; 15]);
}

#[test]
fn squares_carry_through_and_past_96_bits() {
    let mut planes = [[0; 4]; 9];
    planes[2] = [u32::MAX; 4];
    let mut film = pixel(&planes);
    planes[2] = [1, 0, 0, 0];
    film.merge(&pixel(&planes)).unwrap();
    assert_eq!(film.pixels[0].squares[0], 1 << 96);
    planes[2] = [u32::MAX, 0, 0, 0];
    let mut film = pixel(&planes);
    film.merge(&pixel(&planes)).unwrap();
    assert_eq!(film.pixels[0].squares[0], 2 * u128::from(u32::MAX));
}

#[test]
fn negative_sums_cancel() {
    let mut planes = [[0; 4]; 9];
    planes[0] = [low(-5), high(-5), low(i64::MIN), high(i64::MIN)];
    let mut film = pixel(&planes);
    planes[0] = [7, 0, low(i64::MAX), high(i64::MAX)];
    film.merge(&pixel(&planes)).unwrap();
    assert_eq!(film.pixels[0].radiance, [2, -1, 0]);
}

#[test]
fn bands_land_in_their_rows() {
    let mut film = Film::new(FRAME).unwrap();
    let band = Rect { x0: 4, y0: 2, x1: 6, y1: 4 };
    let mut words = vec![0; 4 * WORDS_PER_PIXEL];
    for index in 0..4 {
        let mut planes = [[0; 4]; 9];
        planes[1][2] = index as u32 + 1;
        put(&mut words, 4, index, &planes);
    }
    film.add(band, &words).unwrap();
    assert_eq!(film.resolve().samples, [0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 3, 4, 0]);
}

#[test]
fn add_refuses_other_bands() {
    let mut film = Film::new(FRAME).unwrap();
    let before = film.clone();
    let message = |result: Result<()>| result.unwrap_err().to_string();
    assert_eq!(
        message(film.add(Rect { x1: 8, ..WINDOW }, &[])),
        "the band 2,1,8,4 is not inside the window 2,1,7,4 of the film"
    );
    assert!(film.add(Rect { x0: 5, x1: 3, ..WINDOW }, &[]).is_err());
    assert_eq!(
        message(film.add(WINDOW, &[0; 539])),
        "the band 2,1,7,4 came with 539 words from the device, expected 540"
    );
    film.add(Rect { x1: WINDOW.x0, ..WINDOW }, &[]).unwrap();
    // The last pixel of the band has too many samples: none of the band may be added
    let mut words = vec![1; 540];
    words[(15 + 14) * 4 + 2] = MAX_SAMPLES + 1;
    assert_eq!(
        message(film.add(WINDOW, &words)),
        "1048577 samples in one pixel, the film holds at most 1048576; render with fewer samples a pixel (--spp)"
    );
    assert!(film == before);
}

#[test]
fn merge_refuses_films_of_other_pictures() {
    let mut film = Film::new(FRAME).unwrap();
    let small = Rect { x1: 6, ..WINDOW };
    for (frame, reason) in [
        (Frame { width: 9, ..FRAME }, "the size in pixels differs, 8 x 5 and 9 x 5"),
        (Frame { height: 6, ..FRAME }, "the size in pixels differs, 8 x 5 and 8 x 6"),
        (Frame { window: small, ..FRAME }, "the window differs, 2,1,7,4 and 2,1,6,4"),
        (Frame { radiance_exponent: -20, ..FRAME }, "the unit of radiance differs, 2^-24 and 2^-20"),
        (Frame { depth_exponent: 0, ..FRAME }, "the unit of depth differs, 2^-12 and 2^0"),
        (Frame { seed: 8, ..FRAME }, "the seed differs, 7 and 8"),
    ] {
        let error = film.merge(&Film::new(frame).unwrap()).unwrap_err().to_string();
        assert!(error.starts_with(&format!("cannot merge films: {reason}; ")), "{error}");
    }
    let mut planes = [[0; 4]; 9];
    planes[1][2] = MAX_SAMPLES;
    let mut full = pixel(&planes);
    assert!(full.merge(&full.clone()).is_err());
}

#[test]
fn new_refuses_windows_outside_the_picture() {
    let windows = [
        Rect { x1: 9, ..WINDOW },
        Rect { y1: 6, ..WINDOW },
        Rect { x0: 7, ..WINDOW },
        Rect { x0: 6, x1: 5, ..WINDOW },
        Rect { y0: 4, ..WINDOW },
    ];
    for window in windows {
        let error = Film::new(Frame { window, ..FRAME }).unwrap_err();
        assert!(error.to_string().contains("is empty or not inside the picture of 8 x 5"), "{error}");
    }
}

#[test]
fn absurd_sizes_are_an_error() {
    let window = Rect { x0: 0, y0: 0, x1: u32::MAX, y1: u32::MAX };
    let error = Film::new(Frame { width: u32::MAX, height: u32::MAX, window, ..FRAME }).unwrap_err();
    assert!(error.to_string().contains("MiB of host memory"), "{error}");
}

/// Words of `bands` bands over the whole window, with samples few enough to fit together.
fn bands() -> impl Strategy<Value = Vec<Vec<u32>>> {
    let count = WINDOW.area() as usize;
    let band = prop::collection::vec(any::<u32>(), count * WORDS_PER_PIXEL).prop_map(move |mut words| {
        words.chunks_exact_mut(4).skip(count).take(count).for_each(|word| word[2] %= 1000);
        words
    });
    prop::collection::vec(band, 1..8)
}

/// The part of a band over the window that lies in `rows`.
fn rows_of(words: &[u32], rows: std::ops::Range<u32>) -> (Rect, Vec<u32>) {
    let rect = Rect { y0: WINDOW.y0 + rows.start, y1: WINDOW.y0 + rows.end, ..WINDOW };
    let row = WINDOW.width() as usize * 4;
    let planes = words.chunks_exact(WINDOW.area() as usize * 4);
    let part = planes.flat_map(|plane| &plane[rows.start as usize * row..rows.end as usize * row]);
    (rect, part.copied().collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_split_gives_the_same_film(
        bands in bands(),
        films in prop::collection::vec(0usize..3, 8),
        cuts in prop::collection::vec(0u32..=3, 8),
        backwards: bool,
    ) {
        let mut whole = Film::new(FRAME).unwrap();
        for words in &bands {
            whole.add(WINDOW, words).unwrap();
        }
        // Each band cut in two at some row, its parts in a film of their own, films merged in either order
        let mut parts = vec![Film::new(FRAME).unwrap(); 3];
        for ((words, &film), &cut) in bands.iter().zip(&films).zip(&cuts) {
            for (film, rows) in [(film, 0..cut), ((film + 1) % 3, cut..WINDOW.height())] {
                let (rect, words) = rows_of(words, rows);
                parts[film].add(rect, &words).unwrap();
            }
        }
        if backwards {
            parts.reverse();
        }
        let mut merged = Film::new(FRAME).unwrap();
        for part in &parts {
            merged.merge(part).unwrap();
        }
        prop_assert!(merged == whole);
        prop_assert_eq!(merged.resolve().rgb, whole.resolve().rgb);
    }
}
