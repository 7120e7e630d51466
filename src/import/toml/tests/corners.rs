//! What vertices have for textures alone.

use super::*;
use glam::{Vec2, Vec4};

#[test]
fn meshes_have_colours_and_a_second_set_of_texture_coordinates() {
    let scene = all();
    let inline = scene.meshes.iter().find(|found| found.1 == "inline").unwrap().2;
    assert_eq!(inline.uvs1, [Vec2::ZERO, Vec2::X * 2.0, Vec2::ONE * 2.0, Vec2::Y * 2.0]);
    let colors = [[1.0, 0.0, 0.0, 1.0], [0.0, 0.5, 1.0, 0.25], [0.5, 0.5, 0.5, 1.0], [2.0, 0.0, 0.0, 1.0]];
    assert_eq!(inline.colors, colors.map(Vec4::from_array));
}

#[test]
fn textures_see_them() {
    let scene = all();
    let texture = |name: &str| scene.textures.iter().find(|found| found.1 == name).unwrap().2;
    assert_eq!(*texture("dyed"), Texture::VertexColor(Channel::A));
    let Texture::Mapped { mapping, .. } = texture("stamp") else { panic!("not mapped") };
    assert_eq!((mapping.kind, mapping.seam_blend), (MappingKind::Uv1, 0.25));
}
