//! Textures.

use super::check;

#[test]
fn textures() {
    check(&[
        (
            "[texture.t]\nfile = 'a.png'",
            "1:1: `kind` is missing in texture `t`; kinds are \"image\", \"stack\", \"glsl\", \"constant\", \"vertex_color\", \"checker\", \"noise\", \"fbm\", \"turbulence\", \"ridged\", \"windy\", \"value_noise\", \"marble\", \"wood\", \"granite\", \"brick\", \"dots\", \"gradient\", \"worley\", \"ramp\", \"curve\", \"mix\", \"direction_mix\", \"add\", \"multiply\", \"scale\", \"invert\", \"warp\", \"mapped\"",
        ),
        (
            "[texture.t]\nkind = 'imag'",
            "2:8: `kind` is \"imag\", must be one of \"image\", \"stack\", \"glsl\", \"constant\", \"vertex_color\", \"checker\", \"noise\", \"fbm\", \"turbulence\", \"ridged\", \"windy\", \"value_noise\", \"marble\", \"wood\", \"granite\", \"brick\", \"dots\", \"gradient\", \"worley\", \"ramp\", \"curve\", \"mix\", \"direction_mix\", \"add\", \"multiply\", \"scale\", \"invert\", \"warp\", \"mapped\"; did you mean \"image\"?",
        ),
        (
            "[texture.t]\nkind = 'invert'\nvalue = { texture = 'u' }\n[texture.u]\nkind = 'invert'\nvalue = { texture = 't' }",
            "1:10: texture `t` is made of itself, or of more than 64 textures one in the other",
        ),
        (
            "[texture.t]\nkind = 'ramp'\nvalue = 0\nstops = [[1, 0], [0, 1]]",
            "4:19: `stops[1][0]` is less than the place before it",
        ),
        (
            "[texture.t]\nkind = 'ramp'\nvalue = 0\nstops = []",
            "4:9: `stops` must be from 1 to 64 stops, found an empty list",
        ),
        (
            "[texture.t]\nkind = 'ramp'\nvalue = 0\nstops = [[1]]",
            "4:10: `stops[0]` must be a place and a colour, found a list of 1",
        ),
        ("[texture.t]\nkind = 'add'\na = 1", "1:1: `b` is missing in add texture `t`"),
        ("[texture.t]\nkind = 'fbm'\noctaves = 33", "3:11: `octaves` is 33, must be from 1 to 32"),
        (
            "[texture.t]\nkind = 'noise'\noctaves = 3",
            "3:1: unknown key `octaves` in noise texture `t`; it is a key of fbm, turbulence, ridged, windy, value_noise, marble, wood, granite, warp",
        ),
        ("[texture.t]\nkind = 'image'", "1:1: `file` is missing in image texture `t`"),
        ("[texture.t]\nkind = 'image'\nfile = 'missing.png'", "3:8: there is no file missing.png"),
        ("[texture.t]\nkind = 'image'\nfile = ''", "3:8: `file` is \"\", must be the name of a file"),
        ("[texture.t]\nkind = 'image'\nfile = 'broken.exr'", "broken.exr:7: the picture ends too early"),
        (
            "[texture.t]\nkind = 'image'\nfile = 'a.png'\nwrap = ['clamp']",
            "4:8: `wrap` must be one word or two, found a list of 1",
        ),
        (
            "[texture.t]\nkind = 'image'\nfile = 'a.png'\nwrap = ['clamp', 'repat']",
            "4:18: `wrap[1]` is \"repat\", must be one of \"repeat\", \"clamp\", \"mirror\", \"black\"; did you mean \"repeat\"?",
        ),
        (
            "[texture.t]\nkind = 'image'\nfile = 'a.png'\nuv_scale = [1, inf]",
            "4:16: `uv_scale[1]` is inf, must be finite",
        ),
        (
            "[texture.t]\nkind = 'image'\nfile = 'a.png'\ngamma = 2",
            "4:1: unknown key `gamma` in image texture `t`; its keys are `kind`, `file`, `filter`, `wrap`, `uv_scale`, `uv_rotate`, `uv_offset`, `color_space`, `channel`, `scale`, `invert`, `mapping`, `uv_set`, `mapping_space`, `mapping_transform`, `mapping_matrix`, `pole`, `meridian`, `pole_u`, `seam_blend`, `sharpness`",
        ),
    ]);
}

#[test]
fn patterns() {
    check(&[
        ("[texture.t]\nkind = 'checker'\ndimensions = 4", "3:14: `dimensions` is 4, must be from 2 to 3"),
        ("[texture.t]\nkind = 'noise'\ndimensions = 5", "3:14: `dimensions` is 5, must be from 1 to 4"),
        (
            "[texture.t]\nkind = 'noise'\nw_rate = 1",
            "3:10: `w_rate` is for noise in 4 dimensions; add `dimensions = 4`",
        ),
        (
            "[texture.t]\nkind = 'fbm'\nvariant = 'pbrt'\ndimensions = 2",
            "4:14: `dimensions` is 2, must be 3 for the variant \"pbrt\"",
        ),
        ("[texture.t]\nkind = 'value_noise'\nlength = 0", "3:10: `length` is 0, must be from 1 to 1048576"),
        ("[texture.t]\nkind = 'value_noise'\nfrequency = 0", "3:13: `frequency` is 0, must be above 0"),
        ("[texture.t]\nkind = 'value_noise'\namplitude = -1", "3:13: `amplitude` is -1, must be at least 0"),
        ("[texture.t]\nkind = 'fbm'\nfilter_width = -1", "3:16: `filter_width` is -1, must be at least 0"),
        ("[texture.t]\nkind = 'brick'\nvariation = 2", "3:13: `variation` is 2, must be from 0 to 1"),
        ("[texture.t]\nkind = 'brick'\nsize = [1, 0]", "3:12: `size[1]` is 0, must be above 0"),
        (
            "[texture.t]\nkind = 'dots'\nradius = 0.75",
            "3:10: `radius` is 0.75, must be above 0 and at most 0.5",
        ),
        (
            "[texture.t]\nkind = 'worley'\nfeature = 'edge'\nmetric = 'chebyshev'",
            "4:10: an `edge` is the distance to a plane, which only the metric \"euclidean\" has",
        ),
        (
            "[texture.t]\nkind = 'worley'\nfilter_width = 1",
            "3:1: unknown key `filter_width` in worley texture `t`; it is a key of checker, noise, fbm, turbulence, ridged, windy, value_noise, marble, wood, granite, brick, dots, warp",
        ),
        (
            "[texture.t]\nkind = 'curve'\nvalue = 1\npoints = [[1, 0], [0, 0]]",
            "4:20: `points[1][0]` is less than the place before it",
        ),
        (
            "[texture.t]\nkind = 'curve'\nvalue = 1\npoints = [[1]]",
            "4:11: `points[0]` must be two numbers, found a list of 1",
        ),
        ("[texture.t]\nkind = 'scale'\nvalue = 1", "1:1: `factor` is missing in scale texture `t`"),
        (
            "[texture.t]\nkind = 'warp'\nvalue = 1\nby = 1\noctaves = 2",
            "5:11: `octaves` is of the noise that `by` replaces",
        ),
    ]);
}

#[test]
fn mappings_and_stacks() {
    check(&[
        (
            "[texture.t]\nkind = 'mapped'\nvalue = 1\nmapping = 'planar'\nmapping_matrix = [1, 0, 0]",
            "5:18: `mapping_matrix` must be a list of 12 or 16 numbers, row by row, found a list of 3",
        ),
        (
            "[texture.t]\nkind = 'mapped'\nvalue = 1\nmapping = 'spherical'\nmapping_matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\npole = [0, 0, 1]",
            "6:8: `pole` has no meaning beside `mapping_matrix`; keep one or the other",
        ),
        (
            "[texture.t]\nkind = 'mapped'\nvalue = 1\nmapping = 'uv'\nmapping_matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]",
            "5:18: `mapping_matrix` has no meaning for the mapping \"uv\"; remove it, or choose another `mapping`",
        ),
        (
            "[texture.t]\nkind = 'checker'\nmatrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]",
            "3:10: the last row of `matrix` is [0, 0, 0, 2], must be [0, 0, 0, 1]",
        ),
        (
            "[texture.t]\nkind = 'checker'\nmatrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, nan, 0]",
            "3:41: `matrix[10]` is nan, must be finite",
        ),
        (
            "[texture.t]\nkind = 'checker'\nmatrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\ntransform = []",
            "4:13: checker texture `t` has both `transform` and `matrix`; keep one of them",
        ),
        ("[texture.t]\nkind = 'mapped'\nvalue = 1", "1:1: `mapping` is missing in mapped texture `t`"),
        (
            "[texture.t]\nkind = 'mapped'\nvalue = 1\nmapping = 'cube'\npole = [0, 0, 1]",
            "5:8: `pole` has no meaning for the mapping \"cube\"; remove it, or choose another `mapping`",
        ),
        (
            "[texture.t]\nkind = 'mapped'\nvalue = 1\nmapping = 'planar'\nuv_set = 1",
            "5:10: `uv_set` has no meaning for the mapping \"planar\"; remove it, or choose another `mapping`",
        ),
        ("[texture.t]\nkind = 'mapped'\nvalue = 1\nuv_set = 2", "4:10: `uv_set` is 2, must be from 0 to 1"),
        (
            "[texture.t]\nkind = 'mapped'\nvalue = 1\nseam_blend = 1.5",
            "4:14: `seam_blend` is 1.5, must be from 0 to 1",
        ),
        (
            "[texture.t]\nkind = 'stack'",
            "1:1: stack texture `t` has neither `files` nor `file`; add one of them",
        ),
        ("[texture.t]\nkind = 'stack'\nfiles = 'a%d.png'", "1:1: `count` is missing in stack texture `t`"),
        (
            "[texture.t]\nkind = 'stack'\nfiles = 'a%d.png'\ncount = 5000",
            "4:9: `count` is 5000, must be from 1 to 4096",
        ),
        (
            "[texture.t]\nkind = 'stack'\nfiles = 'a.png'\ncount = 2",
            "3:9: `files` is \"a.png\", which has no place for a number; write one %d, or %03d for three digits, in its place",
        ),
        (
            "[texture.t]\nkind = 'stack'\nfiles = 'missing%d.png'\ncount = 2",
            "3:9: there is no file missing0.png",
        ),
        (
            "[texture.t]\nkind = 'stack'\nfiles = ['a.png']\ncount = 2",
            "4:9: `count` has no meaning beside a list of files",
        ),
        (
            "[texture.t]\nkind = 'stack'\nfiles = ['a.png', 'wide.png']",
            "3:9: slice wide.png is 2 x 1, but a.png is 1 x 1; make all slices of one size",
        ),
        (
            "[texture.t]\nkind = 'stack'\nfiles = []",
            "3:9: `files` must be from 1 to 4096 files, found an empty list",
        ),
        (
            "[texture.t]\nkind = 'stack'\nfiles = ['a.png']\nwrap = ['clamp', 'clamp']",
            "4:8: `wrap` must be one word or three, found a list of 2",
        ),
    ]);
}

#[test]
fn textures_of_ones_own() {
    let glsl = |text: &str| format!("[texture.t]\nkind = 'glsl'\nsource = '''\n{text}'''");
    let color = "vec4 color(TextureContext context) { return vec4(1.0); }\n";
    let cases = [
        (
            "[texture.t]\nkind = 'glsl'".to_owned(),
            "1:1: glsl texture `t` has neither `file` nor `source`; add one of them",
        ),
        (
            glsl("float colour() { return 1.0; }"),
            "3:10: the GLSL of glsl texture `t` has no function `vec4 color(TextureContext context)`; add it: it gives the value of the texture",
        ),
        (glsl(&format!("{color}#version 450")), "5: a texture must not have a line #version"),
        (
            glsl(&format!("\n{color}void f() {{ film[0] = 1u; }}")),
            "6: `film` has no place in a texture, which only reads",
        ),
        (glsl(&format!("{color}float f() {{")), "5: `{` is not closed"),
        (
            glsl(color) + "\nparameters = { color = 1 }",
            "6:16: `color` cannot be the name of a parameter; use small letters, digits and single `_`, and begin with a letter",
        ),
        (glsl(color) + "\nparameters = { a = true }", "6:20: `a` must be a colour, found a boolean"),
        (glsl(color) + "\nmax = 0", "6:7: `max` is 0, must be above 0"),
        (
            "[texture.t]\nkind = 'glsl'\nfile = 'missing.glsl'".to_owned(),
            "3:8: there is no file missing.glsl",
        ),
    ];
    check(&cases.iter().map(|(text, message)| (text.as_str(), *message)).collect::<Vec<_>>());
}
