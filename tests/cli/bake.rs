//! `dapple bake`: textures as images and as stacks of slices, read back and compared exactly.

use crate::{Planes, Room};
use std::path::Path;

/// A gradient along v, one along x, and a checker with 2 × 4 × 1 cells in the unit cube. Nothing uses them.
const SCENE: &str = r#"
[texture.up]
kind = "gradient"
low = [0, 1, 0.5]
high = [1, 0, 0.5]
space = "uv"
transform = [{ matrix = [0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0] }]

[texture.wide]
kind = "gradient"
low = -1
high = 3

[texture.cells]
kind = "checker"
even = [1, 0.5, 0.25]
odd = 0
transform = [{ scale = [0.5, 0.25, 1] }]
"#;

fn room() -> Room {
    let room = Room::new();
    room.write("scene.toml", SCENE);
    room
}

/// The numbers of a PNG with 16 bits.
fn png(path: &Path) -> Vec<u16> {
    let image = image::open(path).unwrap();
    assert_eq!(image.color(), image::ColorType::Rgb16);
    image.into_rgb16().into_raw()
}

#[test]
fn a_gradient_has_its_values_in_the_middles_of_texels() {
    let room = room();
    room.run("bake scene.toml up -o up.png --size 3x8").code(0).err_has("up.png: 3 x 8 texels");
    let texels = png(&room.path("up.png"));
    for row in 0..8 {
        // Row 0 is the top, v = 15/16
        let v = 1.0 - (f64::from(row) + 0.5) / 8.0;
        let expected = [v, 1.0 - v, 0.5].map(|value| (value * 65535.0).round() as u16);
        for column in 0..3 {
            let at = 3 * (3 * row as usize + column);
            assert_eq!(texels[at..at + 3], expected, "row {row}, column {column}");
        }
    }
    room.run("bake scene.toml wide -o wide.exr --size 8x2 --json").code(0);
    let exr = Planes::read(&room.path("wide.exr"));
    assert_eq!((exr.width, exr.height), (8, 2));
    for i in 0..16 {
        let u = ((i % 8) as f32 + 0.5) / 8.0;
        assert_eq!(exr.three(["R", "G", "B"], i), [4.0 * u - 1.0; 3], "texel {i}");
    }
}

#[test]
fn a_range_is_what_a_png_holds() {
    let room = room();
    let ran = room.run("bake scene.toml wide -o a.png --size 4x1").code(0);
    ran.err_has(
        "warning: 3 of 4 texels are outside of what a PNG holds and are clamped; say what 0 and 1 are",
    );
    assert_eq!(
        png(&room.path("a.png")),
        [0, 0, 0, 32768, 32768, 32768, 65535, 65535, 65535, 65535, 65535, 65535]
    );
    let ran = room.run("bake scene.toml wide -o a.png --size 4x1 --range -1 3 --json").code(0);
    assert_eq!(png(&room.path("a.png")), [8192, 24576, 40959, 57343].map(|v| [v; 3]).concat());
    let event = ran.event("baked");
    assert_eq!(
        (&event["files"], &event["size"]),
        (&serde_json::json!(["a.png"]), &serde_json::json!([4, 1]))
    );
    assert_eq!((event["clamped"].as_u64(), event["not_finite"].as_u64()), (Some(0), Some(0)));
    assert_eq!((event["least"][0].as_f64(), event["greatest"][2].as_f64()), (Some(-0.5), Some(2.5)));
}

#[test]
fn a_stack_is_a_checker_of_cubes() {
    let room = room();
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        room.run(&format!("bake scene.toml cells -o {name}.png --size 8x6 --slices 4 --axis {name} --quiet"))
            .code(0);
        for slice in 0..4 {
            let texels = png(&room.path(&format!("{name}_{slice:03}.png")));
            for (i, texel) in texels.chunks(3).enumerate() {
                let (column, row) = (i % 8, i / 8);
                // Across the slices, along columns, upwards along rows: the axes in turn
                let mut place = [0.0; 3];
                place[axis] = (f64::from(slice) + 0.5) / 4.0;
                place[(axis + 1) % 3] = (column as f64 + 0.5) / 8.0;
                place[(axis + 2) % 3] = 1.0 - (row as f64 + 0.5) / 6.0;
                let cells = (2.0 * place[0]).floor() + (4.0 * place[1]).floor();
                let expected = if cells % 2.0 == 0.0 { [65535, 32768, 16384] } else { [0; 3] };
                assert_eq!(texel, expected, "axis {name}, slice {slice}, column {column}, row {row}");
            }
        }
    }
    assert_eq!(room.names().len(), 13);
}

#[test]
fn a_baked_stack_is_read_back_along_every_axis() {
    let room = room();
    let again = |kind: &str| {
        let source = if kind == "stack" {
            "files = \"x_%03d.png\"\ncount = 4\naxis = \"x\"\nfilter = \"nearest\""
        } else {
            "file = \"image.png\"\nfilter = \"nearest\""
        };
        format!("[texture.again]\nkind = \"{kind}\"\n{source}\ncolor_space = \"linear\"\n")
    };
    // Columns along y and rows along z; then columns along x and rows along y
    room.run("bake scene.toml cells -o x.png --size 8x2 --slices 4 --axis x -q").code(0);
    room.write("again.toml", &again("stack"));
    for (name, slices) in [("x", "--size 8x2 --slices 4 --axis x"), ("z", "--size 4x8 --slices 2 --axis z")] {
        room.run(&format!("bake scene.toml cells -o first_{name}.png {slices} -q")).code(0);
        room.run(&format!("bake again.toml again -o again_{name}.png {slices} -q")).code(0);
        for slice in 0..2 {
            let [first, second] =
                ["first", "again"].map(|which| png(&room.path(&format!("{which}_{name}_{slice:03}.png"))));
            assert_eq!(first, second, "axis {name}, slice {slice}");
        }
    }
    room.run("bake scene.toml up -o image.png --size 3x8 -q").code(0);
    room.write("again.toml", &again("image"));
    room.run("bake again.toml again -o second.png --size 3x8 -q").code(0);
    assert_eq!(png(&room.path("image.png")), png(&room.path("second.png")));
}

#[test]
fn what_cannot_be_baked_is_said() {
    let room = room();
    room.run("bake scene.toml marble -o a.png")
        .code(2)
        .err_has("error: the scene has no texture `marble`")
        .err_has("help: its textures are `up`, `wide`, `cells`");
    room.run("bake scene.toml up -o a.jpg").code(2).err_has("no picture format has the extension `jpg`");
    room.run("bake scene.toml up -o a.png --axis x").code(2).err_has("--slices");
    room.run("bake scene.toml up -o a.png --range 1 1")
        .code(2)
        .err_has("what becomes 0 and 1 cannot be the same number");
    room.run("bake scene.toml up -o a.png --range 1 nan").code(2).err_has("write a finite number");
    room.run("bake scene.toml up").code(2).err_has("--output <FILE>");
    room.run("bake scene.toml up -o no/a.png").code(1).err_has("make the folder first");
    assert_eq!(room.names(), ["scene.toml"]);
}
