//! Where a word of a scene file is.

use crate::{Error, Place};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// File, line and column of a word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Spot {
    pub file: Rc<Path>,
    pub line: u32,
    pub column: u32,
}

impl Spot {
    /// An error here.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.locate(Error::scene(message))
    }

    /// An error of something that is named here, unless it knows its place.
    pub fn locate(&self, error: Error) -> Error {
        error.at(&self.file, self.line, self.column)
    }

    /// The place for a warning.
    pub fn place(&self) -> Place {
        Place { file: self.file.to_path_buf(), line: self.line, column: self.column }
    }

    /// A name for what is made here and has none: it has the name of the file without its folders, as scenes are written for others to
    /// read.
    pub fn name(&self, thing: &str) -> String {
        let file = self.file.file_name().map_or_else(PathBuf::new, PathBuf::from);
        format!("{thing} at {}", Place { file, ..self.place() })
    }

    /// The path of a file that is named here: relative to the file that names it.
    pub fn resolve(&self, name: &str) -> PathBuf {
        self.file.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name))
    }
}
