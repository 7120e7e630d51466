//! Lights with images in scenes of pbrt: what its axes say must be where they say.
//!
//! All around a camera at the light is a white sphere of radius 1, which shows the intensity of the light over π.

use crate::common::render::render;
use dapple::import::{Assets, ModelChoice, Spacing, read_scene_with};
use dapple::scene::{Image, LensSystem, Mesh, Texels};
use dapple::{Error, Result};
use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_1_PI, PI, TAU};
use std::path::Path;
use std::sync::Arc;

const WIDTH: usize = 64;
const HEIGHT: usize = 32;

/// One scene, and a picture of three by three greys.
struct Files(String);

impl Assets for Files {
    fn image(&mut self, _: &Path) -> Result<Arc<Image>> {
        let texels = Texels::RgbaF32((1..=9).map(|i| [i as f32, i as f32, i as f32, 1.0]).collect());
        Ok(Arc::new(Image { width: 3, height: 3, texels }))
    }

    fn mesh(&mut self, _: &Path) -> Result<Mesh> {
        Err(Error::scene("no mesh"))
    }

    fn lens(&mut self, _: &Path, _: Spacing) -> Result<LensSystem> {
        Err(Error::scene("no lens"))
    }

    fn exists(&mut self, _: &Path) -> bool {
        true
    }

    fn text(&mut self, _: &Path) -> Result<String> {
        Ok(self.0.clone())
    }
}

/// The grey of the texel in a column and a row, from the upper left.
fn texel(column: usize, row: usize) -> f64 {
    (1 + column + 3 * row) as f64
}

/// What the world shows in a direction from the origin.
fn seen(world: &str) -> impl Fn(DVec3) -> f64 + use<> {
    let text = format!(
        "Film \"rgb\" \"integer xresolution\" {WIDTH} \"integer yresolution\" {HEIGHT} PixelFilter \"box\" \
         \"float xradius\" 0.5 \"float yradius\" 0.5 Sampler \"independent\" \"integer pixelsamples\" 4 \
         Integrator \"path\" \"integer maxdepth\" 1 Camera \"spherical\" \"string mapping\" \"equirectangular\" WorldBegin {world}"
    );
    let choice = ModelChoice::default();
    let (scene, warnings) = read_scene_with(Path::new("a.pbrt"), &[], &choice, &mut Files(text)).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    let picture = render(&scene);
    move |d: DVec3| {
        // The azimuth of the camera goes from x to z, and its rows from y down
        let across = d.z.atan2(d.x).rem_euclid(TAU) / TAU;
        let down = d.normalize().y.acos() / PI;
        let at = [across * WIDTH as f64, down * HEIGHT as f64].map(|at| at as usize);
        f64::from(picture.rgb[at[1].min(HEIGHT - 1) * WIDTH + at[0].min(WIDTH - 1)][0])
    }
}

/// Transforms of a light, as they are written and as they are.
fn transforms() -> [(&'static str, DMat3); 3] {
    let turn = DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z);
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    [("", DMat3::IDENTITY), ("Rotate 90 0 0 1", turn), ("Scale -1 1 1", mirror)]
}

/// Demands of a light that it shows texels of its picture in directions of its own space, over π where it lights the sphere.
fn expect(light: &str, around: &str, factor: f64, expected: &[([f64; 3], f64)]) {
    for (transform, map) in transforms() {
        let shown = seen(&format!("AttributeBegin {transform} {light} AttributeEnd {around}"));
        for &(direction, value) in expected {
            let found = shown(map * DVec3::from(direction));
            let off = (found - factor * value).abs();
            assert!(
                off <= 2e-3 * factor,
                "{light} {transform} {direction:?}: {found}, not {value} · {factor}"
            );
        }
    }
}

const SPHERE: &str = "Material \"diffuse\" \"rgb reflectance\" [1 1 1] Shape \"sphere\"";

#[test]
fn a_goniometric_light_of_pbrt_has_y_in_the_middle_and_z_below() {
    let light = "LightSource \"goniometric\" \"string filename\" \"a.exr\" \"rgb I\" [2 2 2]";
    let expected = [
        ([0.1, 1.0, 0.1], texel(1, 1)),
        ([1.0, 0.2, 0.1], texel(2, 1)),
        ([-1.0, 0.2, 0.1], texel(0, 1)),
        ([0.1, 0.2, 1.0], texel(1, 2)),
        ([0.1, 0.2, -1.0], texel(1, 0)),
        ([0.5, -1.0, 0.5], texel(2, 2)),
        ([-0.5, -1.0, 0.5], texel(0, 2)),
        ([0.5, -1.0, -0.5], texel(2, 0)),
    ];
    expect(light, SPHERE, 2.0 * FRAC_1_PI, &expected);
    // 4π times the mean is what it sends out
    let power =
        "LightSource \"goniometric\" \"string filename\" \"a.exr\" \"rgb I\" [1 1 1] \"float power\" 10";
    expect(power, SPHERE, FRAC_1_PI * 10.0 / (4.0 * PI * 5.0), &expected);
}

#[test]
fn an_environment_of_pbrt_has_z_in_the_middle_and_y_below() {
    let light = "LightSource \"infinite\" \"string filename\" \"a.exr\" \"float scale\" 3";
    let expected = [
        ([0.1, 0.1, 1.0], texel(1, 1)),
        ([1.0, 0.1, 0.2], texel(2, 1)),
        ([-1.0, 0.1, 0.2], texel(0, 1)),
        ([0.1, 1.0, 0.2], texel(1, 2)),
        ([0.1, -1.0, 0.2], texel(1, 0)),
        ([0.5, 0.5, -1.0], texel(2, 2)),
        ([-0.5, -0.5, -1.0], texel(0, 0)),
    ];
    expect(light, "", 3.0, &expected);
}

#[test]
fn a_projection_of_pbrt_is_thrown_along_z_with_y_up_and_x_to_the_right() {
    let light = "LightSource \"projection\" \"string filename\" \"a.exr\" \"float fov\" 90 \"float scale\" 2";
    let expected = [
        ([0.0, 0.0, 1.0], texel(1, 1)),
        ([0.65, 0.0, 1.0], texel(2, 1)),
        ([-0.65, 0.0, 1.0], texel(0, 1)),
        ([0.0, 0.65, 1.0], texel(1, 0)),
        ([0.0, -0.65, 1.0], texel(1, 2)),
        ([0.65, 0.65, 1.0], texel(2, 0)),
        ([1.4, 0.0, 1.0], 0.0),
        ([0.0, 0.0, -1.0], 0.0),
    ];
    expect(light, SPHERE, 2.0 * FRAC_1_PI, &expected);
    // A square of 4, of which a texel sends out its light times cos³ / 9
    let slant = |x: f64, y: f64| (1.0 + x * x + y * y).powf(-1.5);
    let third = [-2.0 / 3.0, 0.0, 2.0 / 3.0];
    let sent: f64 = (0..9).map(|i| texel(i % 3, i / 3) * slant(third[i % 3], third[i / 3]) * 4.0 / 9.0).sum();
    let power = "LightSource \"projection\" \"string filename\" \"a.exr\" \"float power\" 10";
    expect(power, SPHERE, FRAC_1_PI * 10.0 / sent, &expected);
}

#[test]
fn an_image_of_an_area_light_of_pbrt_has_its_top_where_v_is_1() {
    let corners = "\"point3 P\" [-1 -1 1  1 -1 1  -1 1 1  1 1 1]";
    let light = "AreaLightSource \"diffuse\" \"string filename\" \"a.exr\"";
    let shown = seen(&format!("{light} \"bool twosided\" true Shape \"bilinearmesh\" {corners}"));
    for ([x, y], value) in
        [([0.8, 0.8], texel(2, 0)), ([-0.8, 0.8], texel(0, 0)), ([-0.8, -0.8], texel(0, 2))]
    {
        let found = shown(DVec3::new(x, y, 1.0));
        assert!((found - value).abs() < 0.02, "{x} {y}: {found}, not {value}");
    }
    // The front is towards +z, away from the camera, unless it is reversed
    for (before, value) in [("", 0.0), ("ReverseOrientation", texel(2, 0))] {
        let found =
            seen(&format!("{light} {before} Shape \"bilinearmesh\" {corners}"))(DVec3::new(0.8, 0.8, 1.0));
        assert!((found - value).abs() < 0.02, "{before}: {found}, not {value}");
    }
}
