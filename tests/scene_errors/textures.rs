//! Textures.

use super::check;

#[test]
fn textures() {
    check(&[
        (
            "[texture.t]\nfile = 'a.png'",
            "1:1: `kind` is missing in texture `t`; kinds are \"image\", \"constant\", \"checker\", \"noise\", \"fbm\", \"turbulence\", \"ridged\", \"windy\", \"value_noise\", \"marble\", \"wood\", \"granite\", \"brick\", \"dots\", \"gradient\", \"worley\", \"ramp\", \"curve\", \"mix\", \"add\", \"multiply\", \"scale\", \"invert\", \"warp\"",
        ),
        (
            "[texture.t]\nkind = 'imag'",
            "2:8: `kind` is \"imag\", must be one of \"image\", \"constant\", \"checker\", \"noise\", \"fbm\", \"turbulence\", \"ridged\", \"windy\", \"value_noise\", \"marble\", \"wood\", \"granite\", \"brick\", \"dots\", \"gradient\", \"worley\", \"ramp\", \"curve\", \"mix\", \"add\", \"multiply\", \"scale\", \"invert\", \"warp\"; did you mean \"image\"?",
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
            "[texture.t]\nkind = 'image'\nfile = 'a.png'\nuv_scale = [1, 0]",
            "4:16: `uv_scale[1]` is 0, must be different from 0",
        ),
        (
            "[texture.t]\nkind = 'image'\nfile = 'a.png'\ngamma = 2",
            "4:1: unknown key `gamma` in image texture `t`; its keys are `kind`, `file`, `filter`, `wrap`, `uv_scale`, `uv_rotate`, `uv_offset`, `color_space`, `channel`, `scale`, `invert`",
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
