//! The readers against the collection of good and malformed files in `../shared/assets`.

#![allow(clippy::unwrap_used, clippy::panic)] // Helpers of tests are tests too.
use dapple::import::{read_image, read_mesh, read_scene};
use dapple::scene::{Image, Texels};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The collection; none, with a notice, where it is missing outside CI.
fn shared() -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared");
    if path.join("assets").is_dir() {
        return Some(path);
    }
    assert_ne!(std::env::var("CI").as_deref(), Ok("true"), "{} is missing", path.display());
    eprintln!("notice: {} is missing, nothing was checked", path.display());
    None
}

/// Cells of the rows of a markdown file whose first cell is a file name in back quotes.
fn rows(index: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(index).unwrap();
    let lines = text.lines().filter(|line| line.starts_with("| `"));
    lines.map(|line| line.split('|').skip(1).map(|cell| cell.trim().replace('`', "")).collect()).collect()
}

/// Most memory that this process has held, in MiB, where Linux tells.
fn peak_memory_mib() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|value| value.split_whitespace().next()?.parse::<usize>().ok()).unwrap_or(0) / 1024
}

#[test]
fn malformed_files_are_refused_in_time_and_memory() {
    let Some(shared) = shared() else { return };
    let folder = shared.join("assets/malformed");
    let mut checked = 0;
    for row in rows(&folder.join("INDEX.md")) {
        let path = folder.join(&row[0]);
        let start = Instant::now();
        let result = match row[0].split('/').next().unwrap() {
            "obj" | "ply" => read_mesh(&path).map(drop),
            "png" | "jpeg" | "exr" | "hdr" => read_image(&path).map(drop),
            "gltf" => read_scene(&path, &[]).map(drop),
            _ => continue,
        };
        assert!(start.elapsed() < Duration::from_secs(2), "{} took {:?}", row[0], start.elapsed());
        match (row[2].trim_matches('*'), &result) {
            ("must-fail", Ok(())) => panic!("{} was read, but: {}", row[0], row[1]),
            ("must-fail" | "may-pass", _) => {}
            (other, _) => panic!("{}: unknown expectation {other}", row[0]),
        }
        if let Err(error) = result {
            assert!(error.to_string().starts_with(path.to_str().unwrap()), "{error}");
            assert!(error.help.is_some(), "no next step: {error}");
            println!("{error}");
        }
        checked += 1;
    }
    assert!(checked >= 111, "only {checked} files");
    // The largest good file of the other tests needs less than this, and a picture of 16384 × 16384 more.
    assert!(peak_memory_mib() < 512, "{} MiB", peak_memory_mib());
}

/// Means of the channels, from 0 to 1 for whole numbers.
fn means(image: &Image) -> [f64; 4] {
    let mean = |values: &mut dyn Iterator<Item = [f64; 4]>| {
        let (mut sum, mut count) = ([0.0; 4], 0.0);
        for value in values {
            (0..4).for_each(|i| sum[i] += value[i]);
            count += 1.0;
        }
        assert_eq!(count, f64::from(image.width) * f64::from(image.height));
        sum.map(|s| s / count)
    };
    match &image.texels {
        Texels::Rgba8(t) => mean(&mut t.iter().map(|t| t.map(|x| f64::from(x) / 255.0))),
        Texels::Rgba16(t) => mean(&mut t.iter().map(|t| t.map(|x| f64::from(x) / 65535.0))),
        Texels::RgbaF32(t) => mean(&mut t.iter().map(|t| t.map(f64::from))),
    }
}

#[test]
fn images_have_the_sizes_and_means_of_their_index() {
    let Some(shared) = shared() else { return };
    let folder = shared.join("assets/images");
    let rows = rows(&folder.join("INDEX.md"));
    assert!(rows.len() >= 14, "only {} files", rows.len());
    for row in rows {
        let image = read_image(&folder.join(&row[0])).unwrap();
        // `32x32 Rgba16 mean 0.5 …` of image-rs, or where that refuses, `800x800 … mean Y 0.64` of OpenEXR.
        let expected = if row[3] == "refuses" { &row[4] } else { &row[3] };
        let (what, numbers) = expected.split_once(" mean ").unwrap();
        let size = what.split(' ').next().unwrap();
        assert_eq!(format!("{}x{}", image.width, image.height), size, "{}", row[0]);
        let depth = match &image.texels {
            Texels::Rgba8(_) => "8",
            Texels::Rgba16(_) => "16",
            Texels::RgbaF32(_) => "32F",
        };
        assert!(what.ends_with(depth) || row[3] == "refuses", "{}: {what}", row[0]);
        let numbers: Vec<f64> = numbers.split_whitespace().filter_map(|n| n.parse().ok()).collect();
        let wanted = match numbers[..] {
            [grey] => [grey, grey, grey, 1.0],
            [r, g, b] => [r, g, b, 1.0],
            [r, g, b, a] => [r, g, b, a],
            _ => panic!("{}: {numbers:?}", row[0]),
        };
        // The index has six digits.
        for (found, wanted) in means(&image).into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1.1e-6, "{}: {:?}, wanted {wanted}", row[0], means(&image));
        }
    }
}

#[test]
fn meshes_have_their_vertices_and_triangles() {
    let Some(shared) = shared() else { return };
    // Vertices and triangles; whether there are normals and texture coordinates.
    for (name, vertices, triangles, normals, uvs) in MESHES {
        let mesh = read_mesh(&shared.join(name)).unwrap();
        let found =
            (mesh.positions.len(), mesh.triangles.len(), !mesh.normals.is_empty(), !mesh.uvs.is_empty());
        assert_eq!(found, (*vertices, *triangles, *normals, *uvs), "{name}");
        assert!(mesh.normals.iter().all(|n| n.is_normalized()), "{name}");
        assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < *vertices), "{name}");
        let ends = mesh.parts.iter().map(|part| part.triangles.end);
        let starts = mesh.parts.iter().map(|part| part.triangles.start);
        assert!(std::iter::once(0).chain(ends).eq(starts.chain([mesh.triangles.len() as u32])), "{name}");
    }
}

const MESHES: &[(&str, usize, usize, bool, bool)] = &[
    ("assets/meshes/stanford-bunny/bun_zipper.ply", 35947, 69451, false, false),
    ("assets/meshes/egyptcat/egyptcat.ply", 10049, 16000, false, true),
    ("assets/meshes/suzanne/suzanne.ply", 1966, 968, true, true),
    ("assets/meshes/spot/spot_triangulated.obj", 3225, 5856, false, true),
    ("assets/meshes/teapot/teapot.obj", 12993, 25200, true, true),
    ("assets/pbrt/teapot-full/models/Mesh001.ply", 34768, 69310, true, true),
    ("assets/pbrt/teapot-full/models/Mesh002.ply", 232, 230, false, true),
    ("reference/pbrt/crystal_ascii.ply", 14, 24, false, false),
    ("reference/pbrt/torus_binary.ply", 861, 1600, true, true),
];
