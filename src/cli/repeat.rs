//! The command that shows a failure again.

use std::ffi::OsString;

const FIRST_SAMPLE: &str = "--first-sample";

/// The arguments of this program again, but from sample `first` on.
pub fn from_sample(first: u32) -> String {
    command(std::env::args_os().skip(1), first)
}

fn command(args: impl Iterator<Item = OsString>, first: u32) -> String {
    let mut words = vec!["dapple".to_owned()];
    let mut args = args.map(|arg| arg.to_string_lossy().into_owned());
    while let Some(arg) = args.next() {
        if arg == FIRST_SAMPLE {
            args.next();
        } else if !arg.starts_with("--first-sample=") {
            words.push(quoted(&arg));
        }
    }
    format!("{} {FIRST_SAMPLE} {first}", words.join(" "))
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
    fn the_first_sample_replaces_that_of_the_user() {
        let of = |words: &[&str]| command(words.iter().map(OsString::from), 12);
        assert_eq!(of(&["render", "a.toml"]), "dapple render a.toml --first-sample 12");
        assert_eq!(
            of(&["render", "--first-sample", "3", "my scene.toml", "--set", "a.b=[1, 'x']"]),
            r"dapple render 'my scene.toml' --set 'a.b=[1, '\''x'\'']' --first-sample 12"
        );
        assert_eq!(of(&["render", "--first-sample=3", ""]), "dapple render '' --first-sample 12");
    }
}
