use super::*;
use crate::import::{Model, ModelChoice, read_model};
use crate::scene::{
    Channel, Material, Principled, Roughness, Scene, Surface, Texture, UvTransform, Value, Wrap,
};
use proptest::prelude::*;

const SQUARE: &str = "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

fn png(path: &Path, pixels: &[[u8; 4]]) {
    let bytes: Vec<u8> = pixels.iter().flatten().copied().collect();
    image::save_buffer(path, &bytes, pixels.len() as u32, 1, image::ColorType::Rgba8).unwrap();
}

/// A square with material `m` of a file with these statements, beside three pictures.
fn read_all(statements: &str) -> Result<(Scene, Model)> {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    png(&at("grey.png"), &[[9, 9, 9, 255], [200, 200, 200, 255]]);
    png(&at("blue.png"), &[[128, 128, 255, 255], [0, 0, 255, 255]]);
    png(&at("cut out.png"), &[[9, 9, 9, 255], [200, 200, 200, 0]]);
    std::fs::write(at("a.mtl"), format!("newmtl m\n{statements}\n")).unwrap();
    std::fs::write(at("a.obj"), format!("{SQUARE}usemtl m\nf 1/1 2/2 3/3 4/4\n")).unwrap();
    let mut scene = Scene::default();
    let model = read_model(&at("a.obj"), &ModelChoice::default(), &mut scene)?;
    Ok((scene, model))
}

fn material(statements: &str) -> (Scene, Material) {
    let (scene, model) = read_all(statements).unwrap();
    assert_eq!(model.warnings, [""; 0]);
    let part = &scene.meshes[model.instances[0].mesh].parts[0];
    let material = scene.materials[part.material.unwrap()].clone();
    (scene, material)
}

fn principled(statements: &str) -> Principled {
    match material(statements).1.surface {
        Surface::Principled(principled) => *principled,
        other => panic!("{other:?}"),
    }
}

fn color(x: f32, y: f32, z: f32) -> Value<Vec3> {
    Value::Constant(Vec3::new(x, y, z))
}

fn fails(statements: &str) -> String {
    let error = read_all(statements).unwrap_err();
    let place = error.place.unwrap();
    format!(
        "{}:{}:{}: {}",
        place.file.file_name().unwrap().display(),
        place.line,
        place.column,
        error.message
    )
}

#[test]
fn numbers_become_those_of_the_principled_material() {
    let found = principled("Kd 0.1 0.2 0.3 # grey\nKs 0.5\nNs 98\nNi 1.33\nKa 1 1 1\nillum 2");
    assert_eq!(found.base_color, color(0.1, 0.2, 0.3));
    assert_eq!((found.specular_color, found.ior), (color(0.5, 0.5, 0.5), Value::Constant(1.33)));
    // √(2 / 100)
    assert_eq!(found.roughness, Roughness::alpha(0.02_f32.sqrt()));
    let found = principled("Pr 0.25\nPm 1\nNs 1000");
    let rough = Value::Constant(0.25);
    assert_eq!(found.roughness, Roughness { u: rough, v: rough, squared: true });
    assert_eq!((found.metallic, found.specular_color), (Value::Constant(1.0), color(1.0, 1.0, 1.0)));
    // No highlight without one, and none of the models that have none
    let matt = principled("");
    assert_eq!((matt.base_color, matt.specular_color), (color(0.8, 0.8, 0.8), color(0.0, 0.0, 0.0)));
    assert_eq!(matt.roughness, Roughness::alpha(1.0));
    assert_eq!(principled("Ks 1 1 1\nillum 1").specular_color, color(0.0, 0.0, 0.0));
}

#[test]
fn dissolve_is_opacity_and_models_of_glass_let_light_through() {
    let opacity = |statements: &str| material(statements).1.detail.opacity.value;
    assert_eq!(opacity("d 0.25"), Value::Constant(0.25));
    assert_eq!(opacity("Tr 0.25"), Value::Constant(0.75));
    for (model, thin) in [(4, true), (6, false), (7, false), (9, true)] {
        let (_, glass) = material(&format!("illum {model}\nd 0.1\nTf 0.5 1 1\nKd 0 0 0"));
        let Surface::Principled(found) = glass.surface else { panic!("{:?}", glass.surface) };
        assert!(glass.detail.opacity.is_whole() && found.roughness.is_smooth());
        assert_eq!((found.transmission, found.thin), (Value::Constant(1.0), thin));
        assert_eq!((found.base_color, found.specular_color), (color(0.5, 1.0, 1.0), color(1.0, 1.0, 1.0)));
    }
}

#[test]
fn pictures_have_their_options_and_factors() {
    let (scene, found) =
        material("Kd 0.5 1 1\nmap_Kd -s 2 3 1 -o 0.25 -clamp on .\\grey.png\nmap_d cut out.png");
    let Surface::Principled(surface) = found.surface else { panic!("{:?}", found.surface) };
    let Texture::Multiply { a, b } = &scene.textures[surface.base_color.texture().unwrap()] else { panic!() };
    assert_eq!(*b, color(0.5, 1.0, 1.0));
    let Texture::Image(picture) = &scene.textures[a.texture().unwrap()] else { panic!() };
    let uv = UvTransform { scale: Vec2::new(2.0, 3.0), rotate: 0.0, offset: Vec2::new(0.25, 0.0) };
    assert_eq!((picture.uv, picture.wrap), (uv, [Wrap::Clamp; 2]));
    let Texture::Image(cut) = &scene.textures[found.detail.opacity.value.texture().unwrap()] else {
        panic!()
    };
    assert_eq!((cut.channel, scene.images.len()), (Channel::A, 2));
    // A statement alone is a factor of 1
    let (_, shining) = material("map_Ke grey.png");
    assert!(matches!(shining.emission.unwrap().radiance, Value::Texture(_)));
    assert!(material("Ke 0 0 0\nmap_Ke grey.png").1.emission.is_none());
    assert_eq!(material("Ke 1 2 3").1.emission.unwrap().radiance, color(1.0, 2.0, 3.0));
}

#[test]
fn bumps_that_are_not_grey_are_normal_maps() {
    let (_, bumpy) = material("map_Bump -bm 0.5 grey.png");
    // A hundredth of the side of 2
    assert_eq!(bumpy.detail.bump.unwrap().height, 0.01);
    assert!(bumpy.detail.normal_map.is_none());
    for statement in ["map_Bump -bm 0.5 blue.png", "norm -bm 0.5 blue.png"] {
        let (_, mapped) = material(statement);
        assert_eq!(mapped.detail.normal_map.unwrap().strength, 0.5);
        assert!(mapped.detail.bump.is_none());
    }
}

#[test]
fn what_is_left_out_is_named_with_its_place() {
    let warnings =
        read_all("Kf 1\nmap_Kd -mm 0 2 -imfchan r grey.png\nKd spectral x.rfl 1").unwrap().1.warnings;
    assert_eq!(
        warnings,
        [
            "a.mtl:2:1: `Kf` is left out; did you mean `Kd`?",
            "a.mtl:3:8: the option `-mm` is left out",
            "a.mtl:3:16: the option `-imfchan` is left out",
            "a.mtl:4:4: `Kd spectral` is left out: colours are read as red, green and blue",
        ]
    );
}

#[test]
fn errors_have_file_line_and_column() {
    for (statements, expected) in [
        ("Kd 1 x 1", "a.mtl:2:6: `Kd` must have a number, found `x`"),
        ("Ns", "a.mtl:2:3: `Ns` must have a number, found nothing"),
        ("\n Ni two", "a.mtl:3:5: `Ni` must have a number, found `two`"),
        ("Ns nan", "a.mtl:2:4: `nan` is not a finite number"),
        ("map_Kd", "a.mtl:2:7: `map_Kd` must have the name of a picture"),
        ("map_Kd -zoom 2 a.png", "a.mtl:2:8: `-zoom` is no option of a picture"),
        ("map_Kd none.png", "a.mtl:2:8: none.png: the file cannot be read"),
        ("map_Kd ../a.png", "a.mtl:2:8: \"../a.png\" is not in the folder of the model or below it"),
        ("map_Kd /etc/passwd", "a.mtl:2:8: \"/etc/passwd\" is not in the folder"),
    ] {
        assert!(fails(statements).starts_with(expected), "{statements}: {}", fails(statements));
    }
    let error = parse(Path::new("b.mtl"), b"# a\nKd 1 1 1").unwrap_err().to_string();
    assert_eq!(error, "b.mtl:2:1: `Kd` comes before the first newmtl; begin the file with newmtl and a name");
}

#[test]
fn missing_materials_are_grey_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    let read = |text: &str| {
        std::fs::write(&path, text).unwrap();
        let mut scene = Scene::default();
        let model = read_model(&path, &ModelChoice::default(), &mut scene)?;
        Ok::<_, Error>((scene.materials.len(), model.warnings))
    };
    let (count, warnings) = read(&format!("{SQUARE}usemtl m\nf 1 2 3\n")).unwrap();
    assert_eq!(count, 1);
    assert_eq!(warnings[0], "line 1: there is no material file a.mtl");
    assert_eq!(warnings[1], "no material is named `m`, and it is grey; there are no materials");
    // Groups that have the name of a material do not wear it
    std::fs::write(folder.path().join("two words.mtl"), "newmtl m\nKd 1 0 0").unwrap();
    let square = SQUARE.replace("a.mtl", "two words.mtl");
    assert_eq!(read(&format!("{square}g m\nf 1 2 3\n")).unwrap(), (1, Vec::new()));
    assert_eq!(read(&format!("{square}usemtl m\nf 1 2 3\n")).unwrap(), (2, Vec::new()));
    let outside = SQUARE.replace("a.mtl", "../a.mtl");
    let expected = "line 1: ../a.mtl is not in the folder of the model or below it, and is not read";
    assert_eq!(read(&format!("{outside}f 1 2 3\n")).unwrap(), (1, vec![expected.to_owned()]));
}

proptest! {
    #[test]
    fn damaged_files_give_materials_or_an_error(
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = b"newmtl a b\nKd 0.1 0.2 0.3\nKs spectral f 1\nNs 1e3\nillum 7\nTr 0.5\n\
            map_Kd -s 1 2 3 -o 0 1 -mm 0 1 -clamp on -bm 2 a b.png\nnewmtl \xe9\nKe 1\nnorm x\n".to_vec();
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let _ = parse(Path::new("a.mtl"), &bytes);
    }
}
