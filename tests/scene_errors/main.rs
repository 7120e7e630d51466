//! Messages of scene errors, as text. Here: TOML itself, `[film]`, `[render]` and `[camera]`.

mod details;
mod files;
mod materials;
mod objects;
mod pbrt;
mod shapes;
mod textures;

use dapple::import::{Assets, ModelChoice, Spacing, read_lens, read_scene_with};
use dapple::scene::{Image, LensSystem, Mesh, MeshPart, Texels};
use dapple::{Error, Result};
use glam::Vec3;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Files in memory; names with `missing` in them are not there.
struct Memory(BTreeMap<&'static str, String>);

impl Assets for Memory {
    fn image(&mut self, path: &Path) -> Result<Arc<Image>> {
        match path.extension().is_some_and(|ext| ext == "png") {
            true => {
                let width = if path.display().to_string().contains("wide") { 2 } else { 1 };
                Ok(Arc::new(Image { width, height: 1, texels: Texels::Rgba8(vec![[0; 4]; width as usize]) }))
            }
            false => Err(Error::scene("the picture ends too early").at(path, 7, 0)),
        }
    }
    fn mesh(&mut self, _: &Path) -> Result<Mesh> {
        let part = |name: &str, at| MeshPart { name: name.into(), triangles: at..at + 1, material: None };
        let parts = vec![part("Steel", 0), part("Glass", 1)];
        Ok(Mesh { positions: vec![Vec3::ZERO; 3], triangles: vec![[0, 1, 2]; 2], parts, ..Mesh::default() })
    }
    fn lens(&mut self, path: &Path, spacing: Spacing) -> Result<LensSystem> {
        let text = match path.to_str() {
            Some("bad.dat") => "# bad\n50 4 1.5 20\n-50 x 1 20\n",
            Some("spreads.dat") => "-50 4 1.5 20\n50 0 1 20\n",
            _ => "50 4 1.5 20 60\n-50 2 1 20\n0 0 0 9\n",
        };
        let file = tempfile::NamedTempFile::new().map_err(|e| Error::scene(e.to_string()))?;
        std::fs::write(file.path(), text).map_err(|e| Error::scene(e.to_string()))?;
        read_lens(file.path(), spacing).map_err(|mut error| {
            error.place.iter_mut().for_each(|place| place.file = path.to_path_buf());
            error
        })
    }
    fn exists(&mut self, path: &Path) -> bool {
        !path.display().to_string().contains("missing")
    }
    fn text(&mut self, path: &Path) -> Result<String> {
        self.0.get(path.display().to_string().as_str()).cloned().ok_or_else(|| Error::scene("no such text"))
    }
}

fn message(files: &[(&'static str, String)], set: &[(&str, &str)]) -> String {
    let set: Vec<_> = set.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    match read_scene_with(
        Path::new("scene.toml"),
        &set,
        &ModelChoice::default(),
        &mut Memory(files.iter().cloned().collect()),
    ) {
        Ok(_) => "no error".into(),
        Err(error) => error.to_string(),
    }
}

/// Compares the messages of scene texts with the expected ones and reports all differences at once.
fn check(cases: &[(&str, &str)]) {
    let mut wrong = String::new();
    for (text, expected) in cases {
        let found = message(&[("scene.toml", text.to_string())], &[]);
        let found = found.strip_prefix("scene.toml:").unwrap_or(&found);
        if found != *expected {
            wrong += &format!("\n{text}\n  expected {expected}\n  found    {found}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

const MATERIAL: &str = "[material.red]\nkind = 'diffuse'\n";

fn check_with_material(cases: &[(&str, &str)]) {
    let texts: Vec<_> = cases.iter().map(|(text, _)| format!("{MATERIAL}{text}")).collect();
    check(&texts.iter().zip(cases).map(|(text, (_, message))| (text.as_str(), *message)).collect::<Vec<_>>());
}

#[test]
fn toml_that_is_none() {
    check(&[
        ("[film", "1:6: unclosed table, expected `]`"),
        ("[film]\nsize = [1, 2", "2:13: unclosed array, expected `]`"),
        ("[film]\n\n  exposure = x", "3:14: string values must be quoted, expected literal string"),
        ("[film]\nexposure = 1\nexposure = 2", "3:1: `exposure` is given twice"),
        ("[material.red]\nkind = 'diffuse'\n[material.red]\n", "3:11: `red` is given twice"),
        (
            "[render]\nseed = 99999999999999999999",
            "2:8: the whole number 99999999999999999999 needs more than 64 bits",
        ),
        (
            "x = [[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]",
            "1:22: the value is nested more than 16 levels deep",
        ),
        ("film = 3", "1:8: `film` must be a table [film], found a whole number"),
        ("[[camera]]", "1:1: `camera` must be a table [camera], found a list of 1"),
        ("[shape]\nkind = 'sphere'", "1:1: `shape` must be a list of tables [[shape]], found a table"),
        ("shape = [1]", "1:10: `shape` must hold tables [[shape]], found a whole number"),
        ("texture = []", "1:11: `texture` must be tables [texture.NAME], found an empty list"),
        (
            "[material]\nkind = 'diffuse'",
            "2:8: `material.kind` must be a table [material.NAME], found a string",
        ),
        ("[fim]\nsize = [1, 1]", "1:2: unknown key `fim` at the top of the scene; did you mean `film`?"),
        ("include = 'a.toml'", "1:11: `include` must be a list of file names, found a string"),
    ]);
}

#[test]
fn film_and_render() {
    check(&[
        ("[film]\nsise = [1, 1]", "2:1: unknown key `sise` in [film]; did you mean `size`?"),
        ("[film]\nsize = [0, 4]", "2:9: `size[0]` is 0, must be from 1 to 16384"),
        ("[film]\nsize = [1, 2, 3]", "2:8: `size` must be a list of 2 whole numbers, found a list of 3"),
        ("[film]\nsize = [1.5, 2]", "2:9: `size[0]` must be a whole number, found a decimal number"),
        ("[film]\nsize = '640x480'", "2:8: `size` must be a list of 2 whole numbers, found a string"),
        (
            "[film]\nsize = [8, 8]\ncrop = [0, 0, 9, 8]",
            "3:8: `crop` is [0, 0, 9, 8], must be inside the 8 × 8 pixels",
        ),
        (
            "[film]\ncrop = [4, 0, 4, 8]",
            "2:8: `crop` is [4, 0, 4, 8], must be [x0, y0, x1, y1] with x0 below x1 and y0 below y1",
        ),
        (
            "[film]\nfilter = \"guassian\"",
            "2:10: `filter` is \"guassian\", must be one of \"box\", \"tent\", \"gaussian\", \"blackman_harris\", \"mitchell\", \"sinc\"; did you mean \"gaussian\"?",
        ),
        (
            "[film]\nfilter = 3",
            "2:10: `filter` must be one of \"box\", \"tent\", \"gaussian\", \"blackman_harris\", \"mitchell\", \"sinc\", found a whole number",
        ),
        ("[film]\nfilter_radius = 0", "2:17: `filter_radius` is 0, must be above 0 and at most 64"),
        ("[film]\nexposure = nan", "2:12: `exposure` is nan, must be finite"),
        ("[film]\nexposure = 65", "2:12: `exposure` is 65, must be from -64 to 64"),
        (
            "[film]\nexposure = 'automatic'",
            "2:12: `exposure` is \"automatic\", must be a number of stops or \"auto\"",
        ),
        (
            "[film]\nexposure = true",
            "2:12: `exposure` must be a number of stops or \"auto\", found a boolean",
        ),
        (
            "[film]\ntone_curve = 'agX'",
            "2:14: `tone_curve` is \"agX\", must be one of \"srgb\", \"linear\", \"aces\", \"agx\"; did you mean \"agx\"?",
        ),
        ("[film]\npng_bits = 12", "2:12: `png_bits` is 12, must be 8 or 16"),
        ("[film]\ntransparent = 1", "2:15: `transparent` must be true or false, found a whole number"),
        ("[render]\nspp = 0", "2:7: `spp` is 0, must be from 1 to 1048576"),
        ("[render]\nspp = 16.0", "2:7: `spp` must be a whole number, found a decimal number"),
        (
            "[render]\nsampler = 'halton'",
            "2:11: `sampler` is \"halton\", must be one of \"sobol\", \"stratified\", \"random\", \"regular\", \"center\"",
        ),
        ("[render]\nstrata = [4, 0]", "2:14: `strata[1]` is 0, must be from 1 to 4096"),
        ("[render]\nmax_depth = -1", "2:13: `max_depth` is -1, must be from 0 to 1000"),
        ("[render]\nfirefly_clamp = 0", "2:17: `firefly_clamp` is 0, must be above 0"),
        (
            "[render]\nzoom = 0",
            "2:1: unknown key `zoom` in [render]; its keys are `spp`, `seed`, `sampler`, `strata`, `max_depth`, `diffuse_bounces`, `russian_roulette`, `firefly_clamp`, `geometric_veto`",
        ),
    ]);
}

#[test]
fn cameras() {
    check(&[
        ("[camera]\nfov = 180", "2:7: `fov` is 180, must be above 0 and below 180"),
        ("[camera]\nfov = '40'", "2:7: `fov` must be a number, found a string"),
        ("[camera]\nposition = [0, 0]", "2:12: `position` must be a list of 3 numbers, found a list of 2"),
        ("[camera]\nposition = [0, inf, 0]", "2:16: `position[1]` is inf, must be finite"),
        ("[camera]\nposition = [0, 1e39, 0]", "2:16: `position[1]` is 1e39, must be below 3.4e38"),
        ("[camera]\nposition = [1, 2, 3]\ntarget = [1, 2, 3]", "3:10: the camera looks at its own position"),
        ("[camera]\nposition = [0, 0, 0]", "2:12: the camera looks at its own position"),
        ("[camera]\nup = [0, 0, 0]", "2:6: `up` is the zero vector and gives no direction"),
        ("[camera]\nup = [0, 0, -2]", "2:6: `up` is parallel to the view"),
        ("[camera]\nposition = [0, 3, 0]", "2:12: `up` is parallel to the view"),
        ("[camera]\ntarget_close = [0, 0, 5]", "2:16: the camera looks at its own position"),
        ("[camera]\nup_close = [0, 0, -2]", "2:12: `up_close` is parallel to the view"),
        (
            "[camera]\nfocus_distance = 3",
            "2:18: `focus_distance` needs a lens, and the camera is a pinhole; add `lens_radius` or `f_number`",
        ),
        (
            "[camera]\nf_number = 2",
            "2:12: `f_number` needs a plane of focus; add `focus_distance` or `focus_point`",
        ),
        (
            "[camera]\nf_number = 2\nlens_radius = 1\nfocus_distance = 1",
            "3:15: [camera] has both `lens_radius` and `f_number`; keep one of them",
        ),
        ("[camera]\nlens_radius = -1\nfocus_distance = 1", "2:15: `lens_radius` is -1, must be at least 0"),
        ("[camera]\nlens_radius = 1\nfocus_distance = 0", "3:18: `focus_distance` is 0, must be above 0"),
        (
            "[camera]\nlens_radius = 1\nfocus_point = [0, 0, 9]",
            "3:15: `focus_point` is -4 in front of the camera along the view, must be above 0",
        ),
        (
            "[camera]\nlens_radius = 1\nfocus_distance = 1\nsensor_height = 1",
            "4:17: `sensor_height` has no meaning with `lens_radius`; remove it",
        ),
        (
            "[camera]\nlens_radius = 1\nfocus_distance = 1\nblades = 2",
            "4:10: `blades` is 2, must be 0 for a circle, or from 3 to 64",
        ),
        (
            "[camera]\nlens_radius = 1\nfocus_distance = 1\nblades = 5\naperture_image = 'a.png'",
            "5:18: [camera] has both `blades` and `aperture_image`; keep one of them",
        ),
        (
            "[camera]\nlens_radius = 1\nfocus_distance = 1\naperture_image = 'missing.png'",
            "4:18: there is no file missing.png",
        ),
        (
            "[camera]\nlens_radius = 1\nfocus_point = [0, 9, 5]\nfocus_normal = [1, 0, 0]",
            "4:16: the plane of focus goes through the camera",
        ),
        (
            "[camera]\nlens_radius = 1\nfocus_distance = 1\nanamorphic = 0",
            "4:14: `anamorphic` is 0, must be from 0.1 to 10",
        ),
        (
            "[camera]\ncat_eye = 1",
            "2:11: `cat_eye` needs a lens, and the camera is a pinhole; add `lens_radius` or `f_number`",
        ),
        ("[camera]\niso = 100", "2:7: `iso` needs a time that the shutter is open; add `shutter`"),
        (
            "[camera]\nlens_radius = 1\nfocus_distance = 1\nshutter = 0.01",
            "4:11: `shutter` needs the f-number of the lens; add `f_number`, or brighten the picture with `exposure` in [film]",
        ),
        (
            "[camera]\nf_number = 8\nfocus_distance = 1\nshutter = 0",
            "4:11: `shutter` is 0, must be above 0 and at most 1000000000",
        ),
        (
            "[camera]\nkind = 'orthographic'\nshutter = 1",
            "3:1: unknown key `shutter` in orthographic [camera]; it is a key of perspective, lens",
        ),
    ]);
}

#[test]
fn cameras_of_other_kinds() {
    check(&[
        (
            "[camera]\nkind = 'fish'",
            "2:8: `kind` is \"fish\", must be one of \"perspective\", \"orthographic\", \"equirectangular\", \"fisheye\", \"lens\"",
        ),
        (
            "[camera]\nkind = 'orthographic'\nfov = 40",
            "3:1: unknown key `fov` in orthographic [camera]; it is a key of perspective, fisheye",
        ),
        ("[camera]\nkind = 'orthographic'\nview_size = 0", "3:13: `view_size` is 0, must be above 0"),
        ("[camera]\nkind = 'fisheye'\nfov = 361", "3:7: `fov` is 361, must be above 0 and at most 360"),
        (
            "[camera]\nkind = 'fisheye'\nmapping = 'equiangular'",
            "3:11: `mapping` is \"equiangular\", must be one of \"equidistant\", \"equisolid\"",
        ),
        ("[camera]\nview_size = 3", "2:1: unknown key `view_size` in [camera]; it is a key of orthographic"),
        ("[camera]\nkind = 'lens'", "1:1: `file` is missing in lens [camera]"),
        (
            "[camera]\nkind = 'lens'\nfile = 'a.dat'",
            "3:8: `file` needs a plane of focus; add `focus_distance` or `focus_point`",
        ),
        (
            "[camera]\nkind = 'lens'\nfile = 'missing.dat'\nfocus_distance = 1",
            "3:8: there is no file missing.dat",
        ),
        ("[camera]\nkind = 'lens'\nfile = 'bad.dat'\nfocus_distance = 1", "bad.dat:3: `x` is not a number"),
        (
            "[camera]\nkind = 'lens'\nfile = 'spreads.dat'\nfocus_distance = 1",
            "spreads.dat: the lens spreads light: its focal length is -49.3421 mm; check the signs of the radii, and the order of the rows",
        ),
        (
            "[camera]\nkind = 'lens'\nfile = 'a.dat'\nfocus_distance = 0.1",
            "4:18: the lens cannot focus on 0.1 in front of the film, only from 0.2040 on; move the camera away, or check `unit`",
        ),
        (
            "[camera]\nkind = 'lens'\nfile = 'a.dat'\nfocus_distance = 1\nf_number = 1",
            "5:12: `f_number` is 1, must be at least 5.2583, what the lens has wide open",
        ),
        (
            "[camera]\nkind = 'lens'\nfile = 'a.dat'\nfocus_distance = 1\naperture = 0.01",
            "5:12: `aperture` is 0.01, must be at most 0.009, the stop of the lens",
        ),
        (
            "[camera]\nkind = 'lens'\nfile = 'a.dat'\nfocus_distance = 1\nlens_radius = 1",
            "5:1: unknown key `lens_radius` in lens [camera]; it is a key of perspective",
        ),
    ]);
}
