//! A neutral studio, for models that bring no light: grey walls, brighter towards the ceiling, and soft lamps without a colour.

use crate::scene::{
    Channel, ColorSpace, Environment, Image, ImageTexture, Scene, TexelFilter, Texels, Texture, UvTransform,
    Value, Wrap,
};
use glam::Vec3;
use std::f32::consts::{PI, TAU};

/// A round, soft lamp at infinity.
struct Lamp {
    towards: Vec3,
    /// Radiance in its middle, W/(m² sr).
    radiance: f32,
    /// Half-angle in degrees.
    angle: f32,
}

/// Radiance of the floor and of the ceiling.
const WALLS: [f32; 2] = [0.12, 0.32];
/// For a camera that looks along −z: the key light from the upper left, a fill from the right, a rim light from behind, and the
/// ceiling.
const LAMPS: [Lamp; 4] = [
    Lamp { towards: Vec3::new(-0.6, 0.7, 0.8), radiance: 4.5, angle: 26.0 },
    Lamp { towards: Vec3::new(0.95, 0.35, 0.35), radiance: 1.5, angle: 30.0 },
    Lamp { towards: Vec3::new(0.35, 0.6, -0.9), radiance: 2.8, angle: 22.0 },
    Lamp { towards: Vec3::new(0.0, 1.0, 0.05), radiance: 0.7, angle: 40.0 },
];
/// Part of the angle of a lamp within which it is at its brightest.
const CORE: f32 = 0.75;
/// Rows of the picture, which has twice as many columns.
const ROWS: u32 = 64;

/// The studio as an environment, with a picture of its own in the scene.
pub(super) fn add(scene: &mut Scene) -> Environment {
    let texel = |i: u32| {
        let (row, column) = (i / (2 * ROWS), i % (2 * ROWS));
        let grey = radiance(direction(row, column));
        [grey, grey, grey, 1.0]
    };
    let texels = Texels::RgbaF32((0..2 * ROWS * ROWS).map(texel).collect());
    let image = scene.images.add("studio", Image { width: 2 * ROWS, height: ROWS, texels });
    let texture = Texture::Image(ImageTexture {
        image,
        filter: TexelFilter::Bilinear,
        wrap: [Wrap::Repeat, Wrap::Clamp],
        uv: UvTransform::default(),
        color_space: ColorSpace::Linear,
        channel: Channel::Rgb,
        scale: 1.0,
        invert: false,
    });
    let radiance = Value::Texture(scene.textures.add("studio", texture));
    Environment::new(radiance)
}

/// Middle of a texel, as [`Environment`] sees it.
fn direction(row: u32, column: u32) -> Vec3 {
    let latitude = PI * (0.5 - (row as f32 + 0.5) / ROWS as f32);
    let longitude = TAU * ((column as f32 + 0.5) / (2 * ROWS) as f32 - 0.5);
    let around = latitude.cos();
    Vec3::new(around * longitude.sin(), latitude.sin(), -around * longitude.cos())
}

fn radiance(direction: Vec3) -> f32 {
    let [floor, ceiling] = WALLS;
    let wall = floor + (ceiling - floor) * smoothstep(-0.6, 0.9, direction.y);
    let lamp = |lamp: &Lamp| {
        let cos = lamp.towards.normalize().dot(direction);
        let edge = lamp.angle.to_radians();
        lamp.radiance * smoothstep(edge.cos(), (CORE * edge).cos(), cos)
    };
    wall + LAMPS.iter().map(lamp).sum::<f32>()
}

fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a white, matt surface of this normal reflects.
    fn reflected(normal: Vec3) -> f32 {
        let cell = (PI / ROWS as f32).powi(2);
        let cells = (0..ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| direction(row, column)));
        let light = cells.map(|d| radiance(d) * normal.dot(d).max(0.0) * d.with_y(0.0).length() * cell);
        light.sum::<f32>() / PI
    }

    #[test]
    fn white_things_are_nearly_white_from_the_front_and_have_a_dark_side() {
        let [front, top, back, below] = [Vec3::Z, Vec3::Y, -Vec3::Z, -Vec3::Y].map(reflected);
        assert!((0.7..0.95).contains(&front), "{front}");
        assert!(top > front && top < 1.3, "{top}");
        assert!(back < 0.7 * front && below < 0.3 * front && below > 0.1, "{back} {below}");
        // The key light is on the left of the camera
        assert!(
            reflected(Vec3::new(-1.0, 0.0, 1.0).normalize())
                > reflected(Vec3::new(1.0, 0.0, 1.0).normalize())
        );
    }
}
