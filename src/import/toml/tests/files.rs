//! Several files, `--set`, and warnings.

use super::{Memory, read, read_scene_with, read_set};
use crate::import::ModelChoice;
use crate::scene::*;
use glam::Vec3;
use std::path::Path;

#[test]
fn includes_join_tables_and_the_including_file_wins() {
    let files = [
        (
            "a/scene.toml",
            "include = ['lib/x.toml', 'lib/y.toml']\n[render]\nspp = 5\n[camera]\nf_number = 4\n",
        ),
        (
            "a/lib/x.toml",
            "include = ['../base.toml']\n[render]\nspp = 1\nseed = 3\n[texture.t]\nkind = 'image'\nfile = 't.png'\n",
        ),
        (
            "a/lib/y.toml",
            "include = ['../base.toml']\n[render]\nseed = 4\n[camera]\nlens_radius = 1\nfocus_distance = 2\n",
        ),
        (
            "a/lib/../base.toml",
            "[material.m]\nkind = 'diffuse'\n[[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'm'\n",
        ),
    ];
    let mut memory = Memory::new(&files);
    let (scene, warnings) =
        read_scene_with(Path::new("a/scene.toml"), &[], &ModelChoice::default(), &mut memory).unwrap();
    assert_eq!((scene.render.spp, scene.render.seed), (5, 4));
    assert_eq!(scene.shapes.len(), 1, "base.toml is read once");
    let lens = scene.camera.thin_lens().unwrap();
    assert_eq!(lens.aperture, Aperture::FNumber { number: 4.0, sensor_height: 0.024 });
    assert_eq!(memory.loaded, ["a/lib/t.png"], "relative to the file that names it");
    let warnings: Vec<_> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings, ["a/lib/x.toml:5:10: nothing uses the texture `t`"]);
}

#[test]
fn set_changes_the_scene() {
    let text = "[material.'my red']\nkind = 'diffuse'\n[material.metal]\nkind = 'conductor'\nroughness = 0.5\n\
                [[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'my red'\n\
                [[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'metal'\n";
    let set = [
        ("render.spp", "16"),
        ("render.spp", "17"),
        ("render.sampler", "random"),
        ("film.size", "[8, 4]"),
        ("material.'my red'.color", "[1, 0, 0]"),
        ("material.metal.alpha", "0.125"),
        ("shape.2.radius", "3"),
    ];
    let (scene, _) = read_set(text, &set).unwrap();
    assert_eq!((scene.render.spp, scene.render.sampler), (17, Sampler::Random));
    assert_eq!((scene.film.width, scene.film.height), (8, 4));
    let red = Surface::diffuse(Value::Constant(Vec3::X));
    assert_eq!(scene.materials[scene.shapes[0].material].surface, red);
    let Surface::Conductor(metal) = &scene.materials[scene.shapes[1].material].surface else {
        panic!("metal")
    };
    assert_eq!(metal.roughness, Roughness::alpha(0.125), "in place of `roughness`");
    let radius = |shape: &Shape| matches!(shape.kind, ShapeKind::Sphere { radius, .. } if radius == 3.0);
    assert_eq!(scene.shapes.iter().map(radius).collect::<Vec<_>>(), [false, true]);
}

#[test]
fn doubtful_things_are_warnings() {
    let text = "[texture.t]\nkind = 'image'\nfile = 'a.png'\n[material.shiny]\nkind = 'phong'\ndiffuse = 0.75\n\
                specular = [0.5, 0, 0]\n[mesh.tri]\npositions = [[0,0,0],[1,0,0],[0,1,0]]\ntriangles = [[0,1,2]]\n";
    let warnings: Vec<_> = read(text).unwrap().1.iter().map(ToString::to_string).collect();
    let expected = [
        "scene.toml:1:10: nothing uses the texture `t`",
        "scene.toml:4:11: `diffuse` + `specular` reaches 1.25 in phong material `shiny`; it is scaled down to 1",
        "scene.toml:4:11: nothing uses the material `shiny`",
        "scene.toml:8:7: nothing uses the mesh `tri`",
    ];
    assert_eq!(warnings, expected);
}

#[test]
fn many_warnings_are_cut_short() {
    let text: String = (0..100_000).map(|i| format!("material.m{i}.kind = 'diffuse'\n")).collect();
    let (scene, warnings) = read(&text).unwrap();
    assert_eq!(scene.materials.len(), 100_000);
    assert_eq!(warnings.len(), 101);
    assert_eq!(warnings[100].to_string(), "scene.toml:101:10: 99900 more warnings from here on");
}
