//! Materials.

use super::check;

#[test]
fn materials() {
    check(&[
        (
            "[material.m]\nkind = 'diffuse'\ncolr = 1",
            "3:1: unknown key `colr` in diffuse material `m`; did you mean `color`?",
        ),
        (
            "[material.m]\nkind = 'diffuse'\nexponent = 1",
            "3:1: unknown key `exponent` in diffuse material `m`; it is a key of phong",
        ),
        (
            "[material.m]\nkind = 'diffuse'\nalpha = 1",
            "3:1: unknown key `alpha` in diffuse material `m`; it is a key of conductor, dielectric, coated_diffuse, coated_conductor, principled",
        ),
        ("[material.m]\nkind = 'diffuse'\ncolor = 1.5", "3:9: `color` is 1.5, must be from 0 to 1"),
        (
            "[material.m]\nkind = 'diffuse'\ncolor = [0, 0, -0.1]",
            "3:16: `color[2]` is -0.1, must be from 0 to 1",
        ),
        (
            "[material.m]\nkind = 'diffuse'\ncolor = 'red'",
            "3:9: `color` is \"red\", which is no colour; write [r, g, b], a number, or \"#rrggbb\"",
        ),
        (
            "[material.m]\nkind = 'diffuse'\ncolor = true",
            "3:9: `color` must be a colour or { texture = \"NAME\" }, found a boolean",
        ),
        (
            "[texture.wood]\nkind = 'image'\nfile = 'a.png'\n[material.m]\nkind = 'diffuse'\ncolor = { texture = 'wod' }",
            "6:21: no texture is named `wod`; did you mean `wood`?",
        ),
        (
            "[material.m]\nkind = 'diffuse'\ncolor = { texture = 'wood' }",
            "3:21: no texture is named `wood`; there are no textures",
        ),
        (
            "[material.m]\nkind = 'diffuse'\ncolor = { image = 'wood' }",
            "3:11: unknown key `image` in `color`; its keys are `texture`",
        ),
        ("[material.m]\nkind = 'diffuse'\ncolor = {}", "3:9: `texture` is missing in `color`"),
        ("[material.m]\nkind = 'unlit'", "1:1: `color` is missing in unlit material `m`"),
        ("[material.m]\nkind = 'phong'\nexponent = -1", "3:12: `exponent` is -1, must be from 0 to 1000000"),
        (
            "[material.m]\nkind = 'phong'\nexponent = [1, 2]",
            "3:12: `exponent` must be a number or { texture = \"NAME\" }, found a list of 2",
        ),
        (
            "[material.m]\nkind = 'conductor'\nroughness = 0.1\nalpha = 0.1",
            "4:9: conductor material `m` has both `roughness` and `alpha`; keep one of them",
        ),
        (
            "[material.m]\nkind = 'conductor'\nroughness = { texture = 'a' }",
            "3:25: no texture is named `a`; there are no textures",
        ),
        (
            "[material.m]\nkind = 'conductor'\nalpha = [1, 1, 1]",
            "3:9: `alpha` must be one value or two, found a list of 3",
        ),
        ("[material.m]\nkind = 'conductor'\neta = 1", "1:1: `k` is missing in conductor material `m`"),
        (
            "[material.m]\nkind = 'conductor'\neta = 1\nk = 1\nfresnel = 'none'",
            "5:11: `fresnel` has no meaning beside `eta` and `k`; keep one or the other",
        ),
        ("[material.m]\nkind = 'dielectric'\nior = 0", "3:7: `ior` is 0, must be above 0 and at most 100"),
        (
            "[material.m]\nkind = 'dielectric'\nior = 1\nroughness = 0.5",
            "4:13: a rough surface needs an `ior` other than 1; change `ior` or remove `roughness`",
        ),
        (
            "[material.m]\nkind = 'dielectric'\nthin = true\nalpha = 0.5",
            "4:9: a thin sheet must be smooth; remove `alpha`",
        ),
        (
            "[material.m]\nkind = 'dielectric'\nthin = true\nabsorption = 1",
            "4:14: `absorption` has no meaning for a thin sheet; remove it",
        ),
        (
            "[material.m]\nkind = 'diffuse'\ntwo_sided = true",
            "3:13: `two_sided` needs `emission`; add `emission`",
        ),
        ("[material.m]\nkind = 'principled'\nior = 0.9", "3:7: `ior` is 0.9, must be from 1 to 100"),
        ("[material.m]\nkind = 'dielectric'\nabbe = 0.5", "3:8: `abbe` is 0.5, must be from 1 to 10000"),
        (
            "[material.m]\nkind = 'dielectric'\nthin = true\nabbe = 30",
            "4:8: `abbe` has no meaning for a thin sheet; remove it",
        ),
        (
            "[material.m]\nkind = 'principled'\nabbe = 30",
            "3:8: `abbe` has no meaning without `transmission`; add `transmission`",
        ),
        (
            "[material.m]\nkind = 'principled'\nabsorption = 1",
            "3:14: `absorption` has no meaning without `transmission`; add `transmission`",
        ),
        (
            "[material.m]\nkind = 'principled'\ncolor = 1",
            "3:1: unknown key `color` in principled material `m`; it is a key of diffuse, diffuse_transmission, unlit, coated_diffuse",
        ),
        ("[material.m]\nkind = 'mix'\na = 'm'", "1:1: `b` is missing in mix material `m`"),
        (
            "[material.m]\nkind = 'mix'\na = 'm'\nb = 'm'",
            "1:11: material `m` is a mix of itself, or of more than 8 mixes one in the other",
        ),
        ("[material.m]\nkind = 'mix'\na = 'x'\nb = 'm'", "3:5: no material is named `x`; materials are `m`"),
        (
            "[material.m]\nkind = 'mix'\na = 'm'\nb = 'm'\nemission_scale = 1",
            "5:18: `emission_scale` needs `emission`; add `emission`",
        ),
        (
            "[material.m]\nkind = 'mix'\na = 'p'\nb = 'q'\n[material.p]\nkind = 'diffuse'\nemission = 1\ntwo_sided = true\n[material.q]\nkind = 'diffuse'\nemission = 1",
            "1:11: one part of material `m` shines from both sides; give both the same `two_sided`",
        ),
        ("[material.m]\nkind = 'diffuse'\nemission = -1", "3:12: `emission` is -1, must be at least 0"),
        (
            "[material.m]\nkind = 'diffuse'\nemission = 1e38\nemission_scale = 1e38",
            "3:12: `emission` times `emission_scale` is too large",
        ),
    ]);
}
