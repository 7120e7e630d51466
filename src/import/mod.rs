//! Files → [`crate::scene::Scene`].

mod exr;
mod file;
mod image;
mod mesh;
mod obj;
mod ply;
mod ply_header;

pub use image::read_image;
pub use mesh::read_mesh;
pub use obj::read_obj;
pub use ply::read_ply;
