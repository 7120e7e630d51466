//! Files → [`crate::scene::Scene`].

mod file;
mod mesh;
mod obj;
mod ply;
mod ply_header;

pub use mesh::read_mesh;
pub use obj::read_obj;
pub use ply::read_ply;
