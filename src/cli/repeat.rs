//! The command that shows a failure again.

use std::ffi::OsString;

const FIRST_SAMPLE: &str = "--first-sample";

/// Options that say what is rendered and where it goes, with a value each.
const WINDOW: [&str; 5] = ["--crop", "--pixel", "--output", "-o", FIRST_SAMPLE];

/// The arguments of this program again, but from sample `first` on.
pub fn from_sample(first: u32) -> String {
    format!("{} {FIRST_SAMPLE} {first}", command(std::env::args_os().skip(1), &[FIRST_SAMPLE]))
}

/// The arguments of this program again, but for one pixel, from sample `first` on, and without a picture.
pub fn of_pixel([x, y]: [u32; 2], first: u32) -> String {
    format!("{} --pixel {x},{y} {FIRST_SAMPLE} {first}", command(std::env::args_os().skip(1), &WINDOW))
}

/// The arguments without some options and their values.
fn command(args: impl Iterator<Item = OsString>, without: &[&str]) -> String {
    let mut words = vec!["dapple".to_owned()];
    let mut args = args.map(|arg| arg.to_string_lossy().into_owned());
    while let Some(arg) = args.next() {
        // `--name value`, `--name=value`, `-n value`, `-nvalue`
        let joined = |option: &&&str| match option.starts_with("--") {
            true => arg.strip_prefix(**option).is_some_and(|rest| rest.starts_with('=')),
            false => !arg.starts_with("--") && arg.starts_with(**option),
        };
        if without.contains(&arg.as_str()) {
            args.next();
        } else if !without.iter().any(|option| joined(&option)) {
            words.push(quoted(&arg));
        }
    }
    words.join(" ")
}

/// A word for a POSIX shell.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "_-./,=:@%+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_replaced_and_the_rest_is_kept() {
        let of = |words: &[&str], without: &[&str]| command(words.iter().map(OsString::from), without);
        let first = |words: &[&str]| of(words, &[FIRST_SAMPLE]);
        assert_eq!(first(&["render", "a.toml"]), "dapple render a.toml");
        assert_eq!(
            first(&["render", "--first-sample", "3", "my scene.toml", "--set", "a.b=[1, 'x']"]),
            r"dapple render 'my scene.toml' --set 'a.b=[1, '\''x'\'']'"
        );
        assert_eq!(first(&["render", "--first-sample=3", "", "-oa.png"]), "dapple render '' -oa.png");
        for output in [&["-o", "a.png"][..], &["-oa.png"], &["--output", "a.png"], &["--output=a.png"]] {
            let words =
                [&["render", "a.toml", "--crop=0,0,1,1", "--spp", "4"], output, &["--size=4x4"]].concat();
            assert_eq!(of(&words, &WINDOW), "dapple render a.toml --spp 4 --size=4x4", "{output:?}");
        }
    }
}
