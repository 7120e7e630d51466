//! Files → [`crate::scene::Scene`].

mod toml;

pub use self::toml::{Assets, Warning, read_scene_with};
