//! Files of shaders that are generated from tables: what is a row there needs a file of its own, and nothing else.

mod lights;
mod materials;

pub use lights::lights;
pub use materials::materials;

use crate::scene::{BsdfKind, PunctualKind};

/// Virtual files that are generated, with their texts: from the tables, and the functions of a scene's textures.
pub fn generated(
    texture_glsl: &str,
    bsdfs: &[&'static BsdfKind],
    punctual_lights: &[&'static PunctualKind],
) -> [(&'static str, String); 5] {
    [
        ("generated/textures.glsl", texture_glsl.to_owned()),
        ("material/generated/inputs.glsl", materials::inputs_glsl(bsdfs)),
        ("material/generated/menu.glsl", materials::menu_glsl(bsdfs)),
        ("light/generated/inputs.glsl", lights::inputs_glsl(punctual_lights)),
        ("light/generated/menu.glsl", lights::menu_glsl(punctual_lights)),
    ]
}

/// `CamelCase` of `snake_case`.
fn camel_case(name: &str) -> String {
    let capital = |word: &str| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_uppercase() + rest
    };
    name.split('_').map(capital).collect()
}
