//! Textures in GLSL of the user's own.

use super::evaluate;
use crate::common::render::scene;
use dapple::layout::{Backend, TexturePoint};
use dapple::scene::{GlslTexture, Handle, Parameter, Scene, Texture};
use dapple::{Error, ErrorKind};
use glam::Vec3;

fn own(file: &str, line: u32, source: &str, parameters: &[(&str, Parameter)]) -> Texture {
    Texture::Glsl(GlslTexture {
        source: source.to_owned(),
        file: file.into(),
        line,
        parameters: parameters.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
        max: 4.0,
    })
}

fn point() -> TexturePoint {
    TexturePoint {
        position: [1.0, 2.0, 3.0],
        object_position: [0.25, 0.5, 0.75],
        uv: [0.125, 0.375],
        normal: [0.0, 1.0, 0.0],
        object_normal: [0.0, 0.0, 1.0],
        footprint: 0.5,
        object_footprint: 0.0625,
        uv_footprint: [0.01, 0.02],
        time: 0.875,
        uv1: [0.625, 0.75],
        uv1_footprint: [0.03, 0.04],
        vertex_color: [0.5, 0.25, 0.0625, 0.75],
        ..TexturePoint::default()
    }
}

fn value(scene: &Scene, handle: Handle<Texture>) -> dapple::Result<[f32; 4]> {
    let storage = evaluate(scene, handle, Backend::Storage, &[point()])?;
    assert!(storage == evaluate(scene, handle, Backend::Texel, &[point()])?);
    Ok(storage[0])
}

fn of(source: &str, parameters: &[(&str, Parameter)]) -> dapple::Result<[f32; 4]> {
    let mut scene = scene(8, 8, 1);
    let handle = scene.textures.add("own", own("folder/own.glsl", 1, source, parameters));
    value(&scene, handle)
}

#[test]
fn a_function_sees_the_point() {
    let cases = [
        ("context.position", [1.0, 2.0, 3.0]),
        ("context.object_position", [0.25, 0.5, 0.75]),
        ("vec3(context.uv, context.time)", [0.125, 0.375, 0.875]),
        ("context.normal", [0.0, 1.0, 0.0]),
        ("context.object_normal", [0.0, 0.0, 1.0]),
        ("vec3(context.footprint, context.object_footprint, context.uv_footprint.y)", [0.5, 0.0625, 0.02]),
        ("context.vertex_color.rga", [0.5, 0.25, 0.75]),
        ("vec3(context.uv1, context.uv1_footprint.y)", [0.625, 0.75, 0.04]),
        ("vec3(9.0, -9.0, 0.5)", [4.0, -4.0, 0.5]),
    ];
    for (expression, expected) in cases {
        let text = format!("vec4 color(TextureContext context) {{ return vec4({expression}, 0.5); }}");
        let found = of(&text, &[]).unwrap();
        assert_eq!(found[..3], expected, "{expression}");
        assert_eq!(found[3], 0.5);
    }
}

#[test]
fn the_library_is_at_hand() {
    // 0 on the lattice, and where no octave can be resolved
    let text = "vec4 color(TextureContext context) {
        vec3 p = context.position;
        float f = worley_f1(worley_euclidean(p));
        return vec4(perlin_noise(p), fbm_noise(p + 0.3, 9.0, 4u), turbulence_noise(p + 0.3, 9.0, 4u), f > 0.0 ? 1.0 : 0.0);
    }";
    let found = of(text, &[]).unwrap();
    assert!(
        found[0] == 0.0 && found[1] == 0.0 && (found[2] - 0.2).abs() < 1e-6 && found[3] == 1.0,
        "{found:?}"
    );
}

#[test]
fn parameters_are_numbers_and_colors_of_a_record() {
    let text = "vec4 color(TextureContext context) { return vec4(scale * tint, scale); }";
    let with = |scale: f32, tint: Vec3| {
        of(text, &[("scale", Parameter::Number(scale)), ("tint", Parameter::Color(tint))]).unwrap()
    };
    assert_eq!(with(2.0, Vec3::new(0.5, 0.25, 1.0)), [1.0, 0.5, 2.0, 2.0]);
    assert_eq!(with(0.5, Vec3::X), [0.5, 0.0, 0.0, 0.5]);
}

#[test]
fn texts_do_not_clash() {
    let text = |n: &str| {
        format!(
            "#define TWICE(x) (2.0 * helper(x))\nconst float size = {n};\nstruct Pair {{ float a; float size; }};\n\
             float helper(float x) {{ return x * size; }}\n\
             vec4 color(TextureContext context) {{ Pair p = Pair(size, 1.0); return vec4(TWICE(p.size) * weight); }}\n"
        )
    };
    let mut scene = scene(8, 8, 1);
    let add = |scene: &mut Scene, n: &str, weight: f32| {
        let parameters = [("weight", Parameter::Number(weight))];
        scene.textures.add("own", own("a.glsl", 1, &text(n), &parameters))
    };
    let handles = [add(&mut scene, "0.5", 1.0), add(&mut scene, "0.75", 1.0), add(&mut scene, "0.5", 2.0)];
    let found = handles.map(|handle| value(&scene, handle).unwrap()[0]);
    assert_eq!(found, [1.0, 1.5, 2.0]);
    // Two of one text are one function
    let prepared = dapple::prepare::prepare_textures(&scene, &handles).unwrap();
    assert_eq!(prepared.glsl.matches("_helper(float x)").count(), 2, "{}", prepared.glsl);
}

fn error(result: dapple::Result<[f32; 4]>) -> Error {
    match result {
        Err(error) => error,
        Ok(value) => panic!("{value:?}"),
    }
}

#[test]
fn errors_name_the_line_of_the_user() {
    let text =
        "vec4 color(TextureContext context)\n{\n    float a = 1.0;\n    return vec4(a, b, a, 1.0);\n}\n";
    let place = |result| {
        let error = error(result);
        assert_eq!(error.kind, ErrorKind::Scene);
        let place = error.place.clone().unwrap();
        (place.file.display().to_string(), place.line, error.message)
    };
    let (file, line, message) = place(of(text, &[]));
    assert_eq!((file.as_str(), line), ("folder/own.glsl", 4));
    assert!(message.contains("'b': undeclared identifier"), "{message}");
    // In a scene file, from its first line on; behind another text
    let mut scene = scene(8, 8, 1);
    let good = "vec4 color(TextureContext context) { return vec4(1.0); }";
    scene.textures.add("good", own("good.glsl", 1, good, &[("a", Parameter::Number(1.0))]));
    let handle = scene.textures.add("bad", own("my scene.toml", 40, text, &[]));
    let (file, line, _) = place(value(&scene, handle));
    assert_eq!((file.as_str(), line), ("my scene.toml", 43));
}
