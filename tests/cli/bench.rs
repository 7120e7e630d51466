//! `dapple bench` on a tiny scene: every figure is there, and those that can be known are right.

use super::*;

const LINES: [&str; 24] = [
    "triangles",
    "samples a pixel",
    "mean radiance",
    "Msamples/s",
    "Mray/s camera",
    "Mray/s bounce",
    "Mray/s shadow",
    "stage camera, s",
    "stage intersect, s",
    "stage shade, s",
    "stage shadow, s",
    "stage intersect (long rays), s",
    "stage shadow (long rays), s",
    "stage advance, s",
    "stage film, s",
    "BVH build, Mtriangles/s",
    "BVH SAH cost",
    "kernels, cold caches, s",
    "kernels, warm caches, s",
    "start to end of first slice, s",
    "device memory, MiB",
    "peak memory of the process, MiB",
    "",
    "dapple",
];

#[test]
fn the_table_has_a_line_for_every_figure() {
    let ran = Room::new().run("bench scene.toml --spp 1 --rounds 1").code(0);
    let lines: Vec<&str> = ran.out.lines().collect();
    // A title, an empty line, and the names of the scenes
    assert_eq!(lines.len(), LINES.len() + 1, "{}", ran.out);
    for name in LINES {
        assert!(lines.iter().any(|line| line.starts_with(name)), "no line `{name}` in {}", ran.out);
    }
    // Two triangles of the floor: the sphere is none.
    assert!(lines.iter().any(|line| line.split_whitespace().eq(["triangles", "2"])), "{}", ran.out);
}

#[test]
fn json_has_the_figures_as_numbers() {
    let room = Room::new();
    let ran = room.run("bench scene.toml --spp 1 --rounds 1 --json").code(0);
    assert_eq!(ran.out.lines().count(), 1);
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    let row = &report["rows"][0];
    assert_eq!((&row["scene"], &row["spp"]), (&Value::from("scene.toml"), &Value::from(1)));
    for name in [
        "mean_radiance",
        "msamples_per_second",
        "camera_mrays_per_second",
        "bounce_mrays_per_second",
        "shadow_mrays_per_second",
        "compile_cold_seconds",
        "compile_warm_seconds",
        "first_slice_seconds",
        "device_bytes",
    ] {
        assert!(row[name].as_f64().unwrap() > 0.0, "{name}: {row}");
    }
    let (cold, warm) = (&row["compile_cold_seconds"], &row["compile_warm_seconds"]);
    assert!(cold.as_f64() > warm.as_f64(), "caches that save no time: {cold}, {warm}");
    let stages: Vec<&str> =
        row["stage_seconds"].as_array().unwrap().iter().map(|s| s[0].as_str().unwrap()).collect();
    let long = ["intersect (long rays)", "shadow (long rays)"];
    assert_eq!(stages, ["camera", "intersect", "shade", "shadow", long[0], long[1], "advance", "film"]);
    // Only the scene is in the folder: caches were elsewhere.
    assert_eq!(room.names(), ["scene.toml"]);
}

#[test]
fn errors_are_told_as_in_a_render() {
    let room = Room::new();
    room.write("broken.toml", "film.size = [0, 0]");
    room.run("bench broken.toml --spp 1").code(2).err_has("broken.toml:1:");
    std::fs::create_dir_all(room.path("mine/stages")).unwrap();
    room.write("mine/stages/film.comp", "void main() { nonsense }");
    room.run("bench scene.toml --spp 1 --shaders mine").code(1).err_has("stages/film.comp:1: ");
    let output = room.program("bench scene.toml --spp 1").env("TMPDIR", "nowhere").output().unwrap();
    Ran::from(output).code(1).err_has("cannot make a folder for caches").err_has("TMPDIR");
}
