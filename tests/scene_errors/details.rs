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
            "3:20: there is no texture `stone`; there are no textures",
        ),
        (
            "[material.m]\nkind = 'diffuse'\nnormal_map = { texture = 't', green = 'left' }\n[texture.t]\nkind = 'constant'\ncolor = 1",
            "3:39: `green` is \"left\", must be one of \"up\", \"down\"",
        ),
    ]);
}

#[test]
fn opacity() {
    check(&[
        (
            "[material.m]\nkind = 'diffuse'\nfilter_color = 0.5",
            "3:16: `filter_color` needs `opacity`; add `opacity`",
        ),
        ("[material.m]\nkind = 'diffuse'\nopacity = 2", "3:11: `opacity` is 2, must be from 0 to 1"),
    ]);
}
