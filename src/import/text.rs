//! Words of messages: quoted input, numbers, ranges, and the name that was perhaps meant.

use std::fmt;

/// Most characters of the user's text that a message repeats.
const MAX_SHOWN: usize = 60;

/// The user's text on one line and not too long.
pub(super) fn shown(text: &str) -> String {
    let mut out = String::new();
    for (index, char) in text.chars().enumerate() {
        if index == MAX_SHOWN {
            out.push('…');
            break;
        }
        if char.is_control() { out.extend(char.escape_default()) } else { out.push(char) }
    }
    out
}

/// A number for a message, short also when it is very large or very small.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    match size {
        _ if value.is_nan() => "nan".into(),
        _ if size != 0.0 && !(1e-4..1e9).contains(&size) => format!("{value:e}"),
        _ => format!("{value}"),
    }
}

/// The numbers that a key allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Limits {
    /// All finite numbers.
    Finite,
    /// All numbers but 0.
    NotZero,
    /// At least this.
    AtLeast(f32),
    /// More than this.
    Above(f32),
    /// Both ends included.
    From(f32, f32),
    /// Both ends excluded.
    Between(f32, f32),
    /// First end excluded, second included.
    AboveUpTo(f32, f32),
}

impl Limits {
    pub fn allows(self, value: f32) -> bool {
        match self {
            Self::Finite => true,
            Self::NotZero => value != 0.0,
            Self::AtLeast(low) => value >= low,
            Self::Above(low) => value > low,
            Self::From(low, high) => (low..=high).contains(&value),
            Self::Between(low, high) => low < value && value < high,
            Self::AboveUpTo(low, high) => low < value && value <= high,
        }
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => f.write_str("finite"),
            Self::NotZero => f.write_str("different from 0"),
            Self::AtLeast(low) => write!(f, "at least {low}"),
            Self::Above(low) => write!(f, "above {low}"),
            Self::From(low, high) => write!(f, "from {low} to {high}"),
            Self::Between(low, high) => write!(f, "above {low} and below {high}"),
            Self::AboveUpTo(low, high) => write!(f, "above {low} and at most {high}"),
        }
    }
}

/// The known name that was perhaps meant.
pub(super) fn closest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // Longer words are not worth the quadratic time.
    const MAX_LENGTH: usize = 64;
    let lower = word.to_lowercase();
    let candidates = known.filter(|name| word.len() <= MAX_LENGTH && name.len() <= MAX_LENGTH);
    let distances = candidates.filter_map(|name| {
        let distance = strsim::damerau_levenshtein(&lower, &name.to_lowercase());
        let longer = word.chars().count().max(name.chars().count());
        // A third of the letters may be wrong, and one in short words.
        (distance <= (longer / 3).max(1) && distance < longer).then_some((distance, name))
    });
    distances.min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// The next step after an unknown name: the closest known one, else the list of them.
pub(super) fn suggest<'a>(word: &str, known: impl Iterator<Item = &'a str>, what: &str) -> String {
    const MAX_LISTED: usize = 24;
    let known: Vec<_> = known.collect();
    if let Some(name) = closest(word, known.iter().copied()) {
        return format!("did you mean `{name}`?");
    }
    if known.is_empty() {
        return format!("there are no {what}");
    }
    let more = if known.len() > MAX_LISTED { ", …" } else { "" };
    let names: Vec<_> = known.iter().take(MAX_LISTED).map(|name| format!("`{}`", shown(name))).collect();
    format!("{what} are {}{more}", names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_what_is_close_and_lists_what_is_not() {
        let known = ["position", "target", "up"];
        let suggest = |word| suggest(word, known.into_iter(), "keys");
        assert_eq!(suggest("postion"), "did you mean `position`?");
        assert_eq!(suggest("pu"), "did you mean `up`?");
        assert_eq!(suggest("zoom"), "keys are `position`, `target`, `up`");
        assert_eq!(super::suggest("zoom", [].into_iter(), "meshes"), "there are no meshes");
    }

    #[test]
    fn shows_strange_text_on_one_short_line() {
        assert_eq!(shown("a\nb"), "a\\nb");
        assert_eq!(shown(&"x".repeat(99)).chars().count(), 61);
        assert_eq!(number(1e300), "1e300");
        assert_eq!(number(-0.25), "-0.25");
        assert_eq!(number(f64::INFINITY), "inf");
    }
}
