//! Values of options, from their text.

use dapple::scene::{MAX_SIDE, Rect};
use std::time::Duration;

/// Width and height of a picture, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    pub width: u32,
    pub height: u32,
}

/// Column and row of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pixel {
    pub x: u32,
    pub y: u32,
}

/// Key and value of a `--set key=value`.
pub type Setting = (String, String);

/// `WxH`, both from 1 to [`MAX_SIDE`].
pub fn size(text: &str) -> Result<Size, String> {
    let numbers = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some((number(w)?, number(h)?)));
    let (width, height) = numbers.ok_or("write width and height in pixels as 640x480")?;
    if (1..=MAX_SIDE).contains(&width) && (1..=MAX_SIDE).contains(&height) {
        Ok(Size { width, height })
    } else {
        Err(format!("width and height are from 1 to {MAX_SIDE} pixels"))
    }
}

/// `x0,y0,x1,y1`, not empty.
pub fn crop(text: &str) -> Result<Rect, String> {
    let [x0, y0, x1, y1] = numbers(text).ok_or("write four whole numbers as x0,y0,x1,y1")?;
    if x0 < x1 && y0 < y1 {
        Ok(Rect { x0, y0, x1, y1 })
    } else {
        Err("the crop is empty: x0 must be below x1 and y0 below y1".into())
    }
}

/// `x,y`.
pub fn pixel(text: &str) -> Result<Pixel, String> {
    let [x, y] = numbers(text).ok_or("write column and row as x,y, counted from 0 at the top left")?;
    Ok(Pixel { x, y })
}

/// A number of seconds, 0 or more.
pub fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    seconds.ok_or_else(|| "write a number of seconds that is not negative, such as 60 or 0.5".into())
}

/// A finite number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| *number > 0.0 && number.is_finite());
    number.ok_or_else(|| "write a number above 0, such as 1000 or 5.6".into())
}

/// A finite number that is not below 0.
pub fn not_negative(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| *number >= 0.0 && number.is_finite());
    number.ok_or_else(|| "write a number that is not below 0, such as 0.015".into())
}

/// A finite number.
pub fn finite(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| "write a finite number, such as -1 or 0.5".into())
}

/// `key=value`.
pub fn setting(text: &str) -> Result<Setting, String> {
    let (key, value) = text.split_once('=').ok_or("write key=value, such as render.max_depth=3")?;
    Ok((key.trim().to_owned(), value.to_owned()))
}

/// Exactly `N` whole numbers between commas.
fn numbers<const N: usize>(text: &str) -> Option<[u32; N]> {
    let numbers: Option<Vec<u32>> = text.split(',').map(number).collect();
    numbers?.try_into().ok()
}

fn number(text: &str) -> Option<u32> {
    text.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read() {
        assert_eq!(size("640x480"), Ok(Size { width: 640, height: 480 }));
        assert_eq!(size("1x16384"), Ok(Size { width: 1, height: 16384 }));
        assert_eq!(crop("1,2,3,4"), Ok(Rect { x0: 1, y0: 2, x1: 3, y1: 4 }));
        assert_eq!(crop("1, 2, 3, 4"), Ok(Rect { x0: 1, y0: 2, x1: 3, y1: 4 }));
        assert_eq!(pixel("0,7"), Ok(Pixel { x: 0, y: 7 }));
        assert_eq!(seconds("0.5"), Ok(Duration::from_millis(500)));
        assert_eq!(setting("a.b=c=d"), Ok(("a.b".into(), "c=d".into())));
    }

    #[test]
    fn nonsense_is_refused() {
        for text in ["", "640", "640x", "0x1", "1x16385", "-1x1", "1x1x1", "axb"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["", "1,2,3", "1,2,3,4,5", "1,2,1,4", "3,2,1,4", "1,2,3,-4", "a,b,c,d"] {
            assert!(crop(text).is_err(), "{text}");
        }
        for text in ["", "1", "1,2,3", "-1,0"] {
            assert!(pixel(text).is_err(), "{text}");
        }
        for text in ["", "-1", "NaN", "inf", "1e300", "s"] {
            assert!(seconds(text).is_err(), "{text}");
        }
        assert!(setting("render.spp").is_err());
    }
}
