//! A mesh as a PLY file.

use crate::scene::Mesh;

/// Bytes of a mesh.
pub(super) fn ply(_mesh: &Mesh) -> Vec<u8> {
    Vec::new()
}
