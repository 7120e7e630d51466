//! A picture as a file.

use crate::scene::Image;
use crate::{Error, Result};

/// Extension and bytes of a picture.
pub(super) fn picture(_image: &Image) -> Result<(&'static str, Vec<u8>)> {
    Err(Error::output("pictures are not written yet"))
}
