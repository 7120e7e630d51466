//! Every kind of the language with its defaults.

use crate::kept::keeps;

#[test]
fn kinds_with_nothing_but_what_they_need() {
    let textures = [
        ("image", "file = \"i.png\""),
        ("stack", "files = [\"i.png\", \"i.png\"]"),
        ("glsl", "source = \"vec4 color(TextureContext c) { return vec4(1.0); }\""),
        ("constant", "color = 0.3"),
        ("vertex_color", ""),
        ("checker", ""),
        ("noise", ""),
        ("fbm", ""),
        ("turbulence", ""),
        ("ridged", ""),
        ("windy", ""),
        ("value_noise", ""),
        ("marble", ""),
        ("wood", ""),
        ("granite", ""),
        ("brick", ""),
        ("dots", ""),
        ("gradient", ""),
        ("worley", ""),
        ("ramp", "value = { texture = \"constant\" }\nstops = [[0, 0], [1, 1]]"),
        ("curve", "value = { texture = \"constant\" }\npoints = [[0, 0], [1, 1]]"),
        ("mix", "a = { texture = \"constant\" }\nb = 1"),
        ("direction_mix", "a = { texture = \"constant\" }\nb = 1\ndirection = [0, 1, 0]"),
        ("add", "a = { texture = \"constant\" }\nb = 1"),
        ("multiply", "a = { texture = \"constant\" }\nb = 0.4"),
        ("scale", "value = { texture = \"constant\" }\nfactor = 2"),
        ("invert", "value = { texture = \"constant\" }"),
        ("warp", "value = { texture = \"checker\" }"),
        ("mapped", "value = { texture = \"image\" }\nmapping = \"spherical\""),
    ];
    let materials = [
        ("unlit", "color = 1"),
        ("conductor", ""),
        ("dielectric", ""),
        ("coated_diffuse", ""),
        ("coated_conductor", ""),
        ("principled", ""),
        ("mix", "a = \"diffuse\"\nb = \"phong\""),
    ];
    let materials: Vec<_> = dapple::scene::BSDFS.iter().map(|row| (row.name, "")).chain(materials).collect();
    let round = "center = [0, 0, 0]\nradius = 1";
    let tube = "center = [0, 0, 0]\nradius = 1\naxis = [0, 1, 0]\nz_min = 0\nz_max = 1";
    let patch = "p00 = [0, 0, 0]\np10 = [1, 0, 0]\np01 = [0, 1, 0]\np11 = [1, 1, 1]";
    let quad = "origin = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]";
    let disk = "center = [0, 0, 0]\nnormal = [0, 1, 0]\nradius = 1";
    let forms = [("sphere", round), ("disk", disk), ("quad", quad), ("cylinder", tube), ("patch", patch)];
    let lights = [
        ("point", "position = [0, 3, 0]\nintensity = 1"),
        ("spot", "position = [0, 3, 0]\nintensity = 1\ndirection = [0, -1, 0]"),
        ("projection", "position = [0, 3, 0]\nintensity = { texture = \"image\" }\ndirection = [0, -1, 0.1]"),
        ("distant", "direction = [0, -1, 0]\nirradiance = 1"),
    ];
    let mut text = String::from("[film]\nsize = [16, 12]\n[environment]\ncolor = 1\n");
    let mut table = |table: &str, kind: &str, keys: &str| {
        text += &format!("{table}\nkind = \"{kind}\"\n{keys}\n");
    };
    textures.iter().for_each(|(kind, keys)| table(&format!("[texture.{kind}]"), kind, keys));
    materials.iter().for_each(|(kind, keys)| table(&format!("[material.{kind}]"), kind, keys));
    for (kind, keys) in forms {
        table("[[shape]]", kind, &format!("{keys}\nmaterial = \"diffuse\""));
        table("[[light]]", kind, &format!("{keys}\nradiance = 1"));
    }
    lights.iter().for_each(|(kind, keys)| table("[[light]]", kind, keys));
    keeps(&[("a.toml", &text)]);
    for camera in ["perspective", "orthographic", "equirectangular", "fisheye"] {
        keeps(&[("a.toml", &format!("[camera]\nkind = \"{camera}\"\n[environment]\ncolor = 1\n"))]);
    }
    for filter in ["box", "tent", "gaussian", "blackman_harris", "mitchell", "sinc"] {
        keeps(&[("a.toml", &format!("[film]\nfilter = \"{filter}\"\n[environment]\ncolor = 1\n"))]);
    }
}
