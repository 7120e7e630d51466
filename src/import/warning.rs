//! What a reader has to say about a scene that it read.

use crate::Place;
use std::fmt;

/// Something that is allowed in a scene and probably not meant.
///
/// Printed as `file:line:column: message`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Where.
    pub place: Place,
    /// The thing and why it is doubtful, in one sentence without a full stop.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}
