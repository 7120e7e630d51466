//! glslang's log to an error with its place.

use std::collections::BTreeMap;
use std::path::Path;

use crate::{Error, ErrorKind};

/// How many problems beyond the first are listed.
const MAX_FURTHER: usize = 10;

/// Ends of lines that say nothing beyond the messages around them.
const NOISE: [&str; 2] = ["compilation errors.  No code generated.", "'' : compilation terminated"];

/// One message of the log.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Message {
    file: String,
    line: u32,
    text: String,
}

/// The errors that a log describes, in its order, each with its place. Warnings are errors.
///
/// `refused` says why an include failed; `kernel` is the file that messages without a place belong to; `of_user`
/// tells which files came with the scene instead of with the program.
pub(super) fn errors_of(
    log: &str,
    kernel: &str,
    refused: &BTreeMap<String, Error>,
    of_user: &dyn Fn(&str) -> bool,
) -> Vec<Error> {
    let mut messages = messages(log, kernel);
    messages.dedup();
    let error = |message: &Message| {
        let include = refused.iter().find(|(name, _)| failed_include(&message.text) == Some(name.as_str()));
        let error = match include {
            Some((name, why)) => explain_include(name, why),
            None => Error::device(&message.text),
        };
        let mut error = error.at(Path::new(&message.file), message.line, 0);
        if of_user(&message.file) {
            error.kind = ErrorKind::Scene;
        }
        error
    };
    messages.iter().map(error).collect()
}

/// One error for several: the first, with up to ten more on lines of their own.
pub(super) fn joined(errors: &[Error]) -> Option<Error> {
    let (first, further) = errors.split_first()?;
    let mut error = first.clone();
    for further in further.iter().take(MAX_FURTHER) {
        let further = Error { help: None, ..further.clone() };
        error.message.push_str(&format!("\n{further}"));
    }
    let left = further.len().saturating_sub(MAX_FURTHER);
    if left > 0 {
        error.message.push_str(&format!("\n(and {left} more)"));
    }
    Some(error)
}

fn messages(log: &str, kernel: &str) -> Vec<Message> {
    let mut messages: Vec<Message> = Vec::new();
    for line in log.lines().map(str::trim_end).filter(|l| !l.is_empty()) {
        let Some(text) = without_severity(line) else {
            // A line without a severity continues the message above it.
            if let Some(last) = messages.last_mut() {
                last.text.push(' ');
                last.text.push_str(line.trim());
            }
            continue;
        };
        if NOISE.iter().any(|noise| text.trim_end().ends_with(noise)) {
            continue;
        }
        let (file, line, text) = split_place(text).unwrap_or((kernel, 0, text));
        // Text that no file was named for is string 0: what the compiler wrote in front of the kernel.
        let file = if file.parse::<u32>().is_ok() { kernel } else { file };
        messages.push(Message { file: file.to_owned(), line, text: tidy(text) });
    }
    messages
}

fn without_severity(line: &str) -> Option<&str> {
    ["ERROR: ", "WARNING: ", "INTERNAL ERROR: ", "UNIMPLEMENTED: ", "UNKNOWN ERROR: ", "NOTE: "]
        .iter()
        .find_map(|severity| line.strip_prefix(severity))
}

/// `file:line: text` to its parts.
fn split_place(text: &str) -> Option<(&str, u32, &str)> {
    text.match_indices(": ").find_map(|(at, _)| {
        let (file, line) = text.get(..at)?.rsplit_once(':')?;
        // A `#line` in generated text may have set any number; below zero counts as unknown.
        let line: i64 = line.parse().ok()?;
        Some((file, u32::try_from(line).unwrap_or(0), text.get(at + 2..)?))
    })
}

/// glslang writes `'name' : reason`, or `'' : reason` when no name is to blame.
fn tidy(text: &str) -> String {
    let text = text.trim();
    match text.split_once("' : ") {
        Some(("'", reason)) => reason.trim().to_owned(),
        Some((name, reason)) => format!("{name}': {}", reason.trim()),
        None => text.to_owned(),
    }
}

/// The name in a message about an include that failed.
fn failed_include(text: &str) -> Option<&str> {
    text.strip_prefix("'#include': ")?.rsplit_once("for header name: ").map(|(_, name)| name.trim())
}

/// What is wrong in the text of the file is told where it is; that there is no such file, where it is asked for.
fn explain_include(name: &str, why: &Error) -> Error {
    match why.place {
        Some(_) => why.clone(),
        None => Error { message: format!("cannot include `{name}`: {}", why.message), ..why.clone() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(log: &str) -> Option<Error> {
        let of_user = |file: &str| file == "generated/textures.glsl";
        joined(&errors_of(log, "stages/a.comp", &BTreeMap::new(), &of_user))
    }

    #[test]
    fn a_quiet_log_is_no_error() {
        assert_eq!(error("\n\n"), None);
        assert_eq!(error("ERROR: 2 compilation errors.  No code generated.\n"), None);
    }

    #[test]
    fn the_first_message_is_the_error_and_the_others_follow() {
        let log = "ERROR: base/b.glsl:3: 'x' : undeclared identifier \nERROR: base/b.glsl:3: '' : compilation terminated \n\
                   WARNING: 0:9: 'y' : odd\nmore\nERROR: Linking compute stage: Missing entry point\n";
        assert_eq!(
            error(log).unwrap().to_string(),
            "base/b.glsl:3: 'x': undeclared identifier\n\
             stages/a.comp:9: 'y': odd more\nstages/a.comp: Linking compute stage: Missing entry point"
        );
    }

    #[test]
    fn a_problem_in_the_text_of_a_scene_is_a_problem_of_the_scene() {
        assert_eq!(error("ERROR: base/b.glsl:3: 'x' : bad").unwrap().kind, ErrorKind::Device);
        assert_eq!(error("ERROR: generated/textures.glsl:3: 'x' : bad").unwrap().kind, ErrorKind::Scene);
    }

    #[test]
    fn a_line_below_zero_is_unknown() {
        assert_eq!(error("ERROR: a b.glsl:-1: 'x' : bad: 3").unwrap().to_string(), "a b.glsl: 'x': bad: 3");
    }

    #[test]
    fn a_long_log_is_cut() {
        let log: String = (1..=30).map(|n| format!("ERROR: a:{n}: 'x' : bad\n")).collect();
        let message = error(&log).unwrap().message;
        assert_eq!(message.lines().count(), 12);
        assert!(message.ends_with("\na:11: 'x': bad\n(and 19 more)"));
    }
}
