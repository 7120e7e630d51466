//! An error as the user sees it: with the lines of the file that it is about, or as an event.

use super::Failure;
use super::console::{Console, say};
use super::event::{Event, Where};
use dapple::{Error, Place};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::io::IsTerminal;

/// Files above this size are not opened for an excerpt.
const MAX_FILE_BYTES: u64 = 16 << 20;
/// Lines above this length are not shown.
const MAX_LINE_CHARS: usize = 300;

/// Prints a failure.
pub fn print(failure: &Failure, console: &mut Console) {
    console.clear_bar();
    let error = &failure.error;
    if console.json() {
        console.event(&Event::Error {
            message: error.message.clone(),
            help: error.help.clone(),
            place: error.place.as_ref().map(Where::from),
            repeat: failure.repeat.clone(),
        });
        // Where the event cannot go, words can.
        if console.finish().is_ok() {
            return;
        }
    }
    say(&text(error));
    if let Some(command) = &failure.repeat {
        say(&format!("repeat with: {command}"));
    }
}

fn text(error: &Error) -> String {
    Excerpt::of(error).and_then(|excerpt| excerpt.draw()).unwrap_or_else(|| plain(error))
}

/// `error: place: message` and a line with the next step.
fn plain(error: &Error) -> String {
    let place = error.place.as_ref().map_or_else(String::new, |place| format!("{place}: "));
    let help = error.help.as_ref().map_or_else(String::new, |help| format!("\nhelp: {help}"));
    format!("error: {place}{}{help}", error.message)
}

/// An error with the text that it is about.
#[derive(Debug)]
struct Excerpt {
    message: String,
    help: Option<String>,
    source: NamedSource<String>,
    start: usize,
    length: usize,
}

impl Excerpt {
    /// None when the place is not known to the line, or the file is not a text that can be shown.
    fn of(error: &Error) -> Option<Self> {
        let place = error.place.as_ref().filter(|place| place.line > 0)?;
        let meta = std::fs::metadata(&place.file).ok()?;
        if !meta.is_file() || meta.len() > MAX_FILE_BYTES {
            return None;
        }
        let text = std::fs::read_to_string(&place.file).ok()?;
        let (start, length) = span_of(&text, place)?;
        Some(Self {
            message: format!("{place}: {}", error.message),
            help: error.help.clone(),
            source: NamedSource::new(place.file.to_string_lossy(), text),
            start,
            length,
        })
    }

    fn draw(&self) -> Option<String> {
        let mut theme = match std::env::var_os("NO_COLOR") {
            None if std::io::stderr().is_terminal() => GraphicalTheme::unicode(),
            _ => GraphicalTheme::unicode_nocolor(),
        };
        theme.characters.error = "error:".into();
        let mut drawn = String::new();
        // Messages stay on one line, so that they can be searched for.
        let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false).with_links(false);
        handler.render_report(&mut drawn, self).ok()?;
        Some(drawn.trim_matches('\n').trim_start().to_owned())
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Excerpt {}

impl Diagnostic for Excerpt {
    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(LabeledSpan::new(None, self.start, self.length))))
    }
}

/// Offset and length in bytes of the word at a place; of the whole line when the column is not known.
fn span_of(text: &str, place: &Place) -> Option<(usize, usize)> {
    let line = text.split_inclusive('\n').nth(place.line as usize - 1)?;
    let start = line.as_ptr() as usize - text.as_ptr() as usize;
    let line = line.trim_end();
    if line.chars().count() > MAX_LINE_CHARS {
        return None;
    }
    let Some(column) = (place.column as usize).checked_sub(1) else {
        let shift = line.len() - line.trim_start().len();
        return Some((start + shift, line.len() - shift));
    };
    let shift = line.char_indices().nth(column).map_or(line.len(), |(at, _)| at);
    let rest = &line[shift..];
    let in_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '+' | '.');
    let word = rest.find(|c| !in_word(c)).unwrap_or(rest.len());
    let length = if word > 0 { word } else { rest.chars().next().map_or(0, char::len_utf8) };
    Some((start + shift, length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::{Path, PathBuf};

    #[test]
    fn the_word_at_a_place_is_found() {
        let text = "[film]\n\twdith = 3 # ä\nö = \"x\"\n";
        let found = |line, column| {
            let place = Place { file: PathBuf::new(), line, column };
            span_of(text, &place).map(|(start, length)| &text[start..start + length])
        };
        assert_eq!(found(1, 1), Some("["));
        assert_eq!(found(2, 2), Some("wdith"));
        assert_eq!(found(2, 0), Some("wdith = 3 # ä"));
        assert_eq!(found(3, 1), Some("ö"));
        assert_eq!(found(3, 5), Some("\""));
        assert_eq!(found(3, 99), Some(""));
        assert_eq!(found(9, 1), None);
    }

    #[test]
    fn an_error_without_a_readable_place_is_one_line_and_its_help() {
        let error = Error::scene("it is wrong").help("mend it");
        assert_eq!(text(&error), "error: it is wrong\nhelp: mend it");
        assert_eq!(
            text(&error.at(Path::new("/no/file"), 3, 4)),
            "error: /no/file:3:4: it is wrong\nhelp: mend it"
        );
    }
}
