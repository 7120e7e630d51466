//! What materials do to the surface itself.

use super::check;

#[test]
fn relief() {
    check(&[
        (
            "[material.m]\nkind = 'diffuse'\nkeep_visible = false",
            "3:16: `keep_visible` needs `bump` or `normal_map`; add one of them",
        ),
        ("[material.m]\nkind = 'diffuse'\nbump = { height = 2 }", "3:8: `texture` is missing in `bump`"),
        (
            "[material.m]\nkind = 'diffuse'\nbump = { texture = 'stone' }",
            "3:20: no texture is named `stone`; there are no textures",
        ),
        (
            "[material.m]\nkind = 'diffuse'\nnormal_map = { texture = 't', green = 'left' }\n[texture.t]\nkind = 'constant'\ncolor = 1",
            "3:39: `green` is \"left\", must be one of \"up\", \"down\"",
        ),
    ]);
}

#[test]
fn displacement() {
    let sphere = |rest: &str| {
        format!(
            "[material.m]\nkind = 'diffuse'\n[[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'm'\n{rest}"
        )
    };
    let disk = "[[shape]]\nkind = 'disk'\nradius = 1\nmaterial = 'm'\ndisplacement = {}";
    let texture = "\n[texture.t]\nkind = 'constant'\ncolor = 1";
    check(&[
        (&sphere("displacement = {}"), "7:16: `texture` is missing in `displacement`"),
        (
            &sphere(&format!("displacement = {{ texture = 't', edge_length = 0 }}{texture}")),
            "7:47: `edge_length` is 0, must be above 0",
        ),
        (
            &sphere(&format!(
                "displacement = {{ texture = 't', edge_length = 1, edge_pixels = 1 }}{texture}"
            )),
            "7:64: `displacement` has both `edge_length` and `edge_pixels`; keep one of them",
        ),
        (disk, "5:1: unknown key `displacement` in disk shape 1; it is a key of sphere, quad"),
    ]);
}

#[test]
fn opacity() {
    check(&[
        (
            "[material.m]\nkind = 'diffuse'\nfilter_color = 0.5",
            "3:16: `filter_color` needs `opacity`; add `opacity`",
        ),
        (
            "[material.m]\nkind = 'diffuse'\nsides = 'back'",
            "3:9: `sides` is \"back\", must be one of \"both\", \"front\"",
        ),
        (
            "[material.m]\nkind = 'diffuse'\nemission = 1\ntwo_sided = true\nsides = 'front'",
            "4:13: `two_sided` light needs a surface that is there from both sides; remove `two_sided`, or `sides`",
        ),
        ("[material.m]\nkind = 'diffuse'\nopacity = 2", "3:11: `opacity` is 2, must be from 0 to 1"),
    ]);
}
