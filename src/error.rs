//! The one error type of the library: where, what, and the next step.

use std::fmt;
use std::path::{Path, PathBuf};

/// What kind of thing went wrong. It decides the exit code of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// The scene, a file that it names, or an argument is wrong (exit code 2).
    Scene,
    /// The device, the driver or a kernel failed, or a limit was exceeded (exit code 1).
    Device,
    /// A result could not be written (exit code 1).
    Output,
}

/// A place in a text or binary file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Place {
    /// The file, as the user would name it.
    pub file: PathBuf,
    /// Line, counted from 1; 0 when only the file is known.
    pub line: u32,
    /// Column in characters, counted from 1; 0 when only the line is known.
    pub column: u32,
}

/// An error with its place, the thing that is wrong and why, and the next step.
///
/// Printed as `file:line:column: message` followed by `; help` when there is a next step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    /// What kind of error this is.
    pub kind: ErrorKind,
    /// Where, when it is known.
    pub place: Option<Place>,
    /// The thing and why it is wrong, in one sentence without a full stop.
    pub message: String,
    /// The next step for the user, in one sentence without a full stop.
    pub help: Option<String>,
}

/// Result with [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    /// An error in a scene, in a file that a scene names, or in an argument.
    pub fn scene(message: impl Into<String>) -> Self {
        Self::new(ErrorKind::Scene, message)
    }

    /// An error of the device, its driver or a kernel.
    pub fn device(message: impl Into<String>) -> Self {
        Self::new(ErrorKind::Device, message)
    }

    /// A result that could not be written.
    pub fn output(message: impl Into<String>) -> Self {
        Self::new(ErrorKind::Output, message)
    }

    fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self { kind, place: None, message: message.into(), help: None }
    }

    /// Adds the next step.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds the file, unless a place is known already.
    #[must_use]
    pub fn in_file(self, file: &Path) -> Self {
        self.at(file, 0, 0)
    }

    /// Adds file, line and column (0 = unknown), unless a place is known already.
    #[must_use]
    pub fn at(mut self, file: &Path, line: u32, column: u32) -> Self {
        self.place.get_or_insert_with(|| Place { file: file.to_path_buf(), line, column });
        self
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
            if self.column > 0 {
                write!(f, ":{}", self.column)?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prints_place_message_and_next_step() {
        let error = Error::scene("radius is -1, must be positive").help("use a length above 0");
        assert_eq!(error.to_string(), "radius is -1, must be positive; use a length above 0");
        let placed = error.at(Path::new("a.toml"), 14, 9).at(Path::new("b.toml"), 1, 1);
        assert_eq!(placed.to_string(), "a.toml:14:9: radius is -1, must be positive; use a length above 0");
        assert_eq!(Error::output("disk full").in_file(Path::new("x.png")).to_string(), "x.png: disk full");
    }
}
