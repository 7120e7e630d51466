//! A lens as a file.

use crate::scene::LensSystem;

/// Text of a lens file.
pub(super) fn lens(_system: &LensSystem) -> String {
    String::new()
}
