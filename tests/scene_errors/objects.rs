//! Shapes, meshes and lights.

use super::{check, check_with_material};

#[test]
fn shapes_and_transforms() {
    let sphere = |rest: &str| format!("[[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'red'\n{rest}");
    let quad = |rest: &str| format!("[[shape]]\nkind = 'quad'\nmaterial = 'red'\n{rest}");
    let cases = [
        (
            "[[shape]]\nradius = 1".into(),
            "3:1: `kind` is missing in shape 1; kinds are \"sphere\", \"disk\", \"quad\", \"cylinder\", \"patch\"",
        ),
        (
            "[[shape]]\nkind = 'cube'".into(),
            "4:8: `kind` is \"cube\", must be one of \"sphere\", \"disk\", \"quad\", \"cylinder\", \"patch\"",
        ),
        ("[[shape]]\nkind = 'sphere'".into(), "3:1: `radius` is missing in sphere shape 1"),
        ("[[shape]]\nkind = 'sphere'\nradius = -1".into(), "5:10: `radius` is -1, must be above 0"),
        ("[[shape]]\nkind = 'sphere'\nradius = 1".into(), "3:1: `material` is missing in sphere shape 1"),
        (
            "[[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'rd'".into(),
            "6:12: no material is named `rd`; did you mean `red`?",
        ),
        (
            "[[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'stone'".into(),
            "6:12: no material is named `stone`; materials are `red`",
        ),
        (
            "[[shape]]\nkind = 'sphere'\nnormal = [0, 1, 0]".into(),
            "5:1: unknown key `normal` in sphere shape 1; it is a key of disk",
        ),
        (sphere("pole = [0, 0, 0]"), "7:8: `pole` is the zero vector and gives no direction"),
        (
            sphere("pole = [1, 1, 0]\nmeridian = [2, 2, 0]"),
            "8:12: `meridian` is parallel to `pole`; turn one of them",
        ),
        (
            quad("edge_u = [1, 0, 0]\nedge_v = [0, 1, 0]"),
            "3:1: quad shape 1 has neither `origin` nor `center`; add one of them",
        ),
        (
            quad("edge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\norigin = [0, 0, 0]\ncenter = [0, 0, 0]"),
            "9:10: quad shape 1 has both `origin` and `center`; keep one of them",
        ),
        (
            quad("edge_u = [1, 0, 0]\nedge_v = [2, 0, 0]\norigin = [0, 0, 0]"),
            "7:10: `edge_v` is parallel to `edge_u`, so that the quad has no area",
        ),
        (
            quad("edge_u = [0, 0, 0]\nedge_v = [2, 0, 0]\norigin = [0, 0, 0]"),
            "6:10: `edge_u` is the zero vector",
        ),
        (sphere("transform_close = [{ scale = 0 }]"), "7:30: `scale` is 0, must be different from 0"),
        (
            format!(
                "[texture.t]\nkind = 'constant'\ncolor = 0\n{}",
                sphere("displacement = { texture = 't' }\ntransform_close = []")
            ),
            "10:16: a shape that moves cannot be displaced; displace a mesh, and move its instance",
        ),
        (
            sphere("transform = [{ scale = 2 }]\ntransform_close = [{ scale = [1, -1, 1] }]"),
            "8:19: of `transform` and `transform_close` only one mirrors; a thing that moves cannot be turned inside out",
        ),
        (
            sphere("transform = { scale = 2 }"),
            "7:13: `transform` must be a list of steps, such as [{ translate = [0, 1, 0] }], found a table",
        ),
        (sphere("transform = [2]"), "7:14: step `transform[0]` must be a table, found a whole number"),
        (
            sphere("transform = [{}]"),
            "7:14: step `transform[0]` must have exactly one of `translate`, `rotate`, `scale`, `matrix`; write one step after the other: [{ scale = 2 }, { translate = [0, 1, 0] }]",
        ),
        (
            sphere("transform = [{ scale = 2, translate = [0, 0, 1] }]"),
            "7:14: step `transform[0]` must have exactly one of `translate`, `rotate`, `scale`, `matrix`; write one step after the other: [{ scale = 2 }, { translate = [0, 1, 0] }]",
        ),
        (
            sphere("transform = [{ scal = 2 }]"),
            "7:16: unknown key `scal` in step `transform[0]`; did you mean `scale`?",
        ),
        (sphere("transform = [{ scale = [1, 0, 1] }]"), "7:28: `scale[1]` is 0, must be different from 0"),
        (sphere("transform = [{ rotate = [0, 1, 0] }]"), "7:14: `angle` is missing in step `transform[0]`"),
        (
            sphere("transform = [{ rotate = 90 }]"),
            "7:25: `rotate` must be a list of 3 numbers, found a whole number",
        ),
        (
            sphere("transform = [{ rotate = [0, 0, 0], angle = 1 }]"),
            "7:25: `rotate` is the zero vector and gives no direction",
        ),
        (sphere("transform = [{ scale = 1, angle = 1 }]"), "7:35: `angle` has no meaning for `scale`"),
        (
            sphere("transform = [{ matrix = [1, 2, 3] }]"),
            "7:25: `matrix` must be a list of 12 or 16 numbers, row by row, found a list of 3",
        ),
        (
            sphere("transform = [{ matrix = [1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0] }]"),
            "7:13: `transform` cannot be inverted; give every axis a size",
        ),
        (
            sphere("transform = [{ matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1] }]"),
            "7:25: the last row of `matrix` is [0, 0, 1, 1], must be [0, 0, 0, 1]",
        ),
        (
            sphere("transform = [{ scale = 1e-30 }, { scale = 1e-30 }]"),
            "7:13: `transform` cannot be inverted; give every axis a size",
        ),
        (
            sphere("transform = [{ scale = 1e30 }, { scale = 1e30 }]"),
            "7:13: `transform` cannot be inverted; give every axis a size",
        ),
    ];
    check_with_material(&cases.iter().map(|(text, message)| (text.as_str(), *message)).collect::<Vec<_>>());
}

#[test]
fn meshes_and_instances() {
    let points = "positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";
    let mesh = |rest: &str| format!("[mesh.m]\n{points}{rest}");
    let cases = [
        (
            mesh("triangles = [[0, 1, 2]]\nround = true"),
            "6:9: `round` is for meshes on the sphere of radius 1 about the origin, and vertex 0 is not on it; move the vertices, and scale the instance",
        ),
        (
            mesh("triangles = [[0, 1, 2]]\nround = 1"),
            "6:9: `round` must be true or false, found a whole number",
        ),
        (
            "[mesh.m]\nsmooth = true".into(),
            "3:1: mesh `m` has neither `file` nor `positions`; add one of them",
        ),
        ("[mesh.m]\nfile = 'missing.obj'".into(), "4:8: there is no file missing.obj"),
        ("[mesh.m]\nfile = 'a.obj'\nuvs = []".into(), "5:7: `uvs` has no meaning beside `file`"),
        (
            "[mesh.m]\nfile = 'a.obj'\nmaterials = { Stel = 'red' }".into(),
            "5:22: no part of the mesh is named `Stel`; did you mean `Steel`?",
        ),
        (
            "[mesh.m]\nfile = 'a.obj'\nmaterials = { Steel = 'rod' }".into(),
            "5:23: no material is named `rod`; did you mean `red`?",
        ),
        (
            "[mesh.m]\nfile = 'a.obj'\nmaterials = ['red']".into(),
            "5:13: `materials` must be a table { \"name in the file\" = \"material\" }, found a list of 1",
        ),
        (mesh(""), "3:1: mesh `m` has neither `triangles` nor `polygons`; add one of them"),
        (mesh("triangles = []"), "3:1: mesh `m` has no triangles"),
        (
            mesh("triangles = [[0, 1, 3]]"),
            "5:21: `triangles[0][2]` is 3, must be the index of one of the 3 positions, from 0",
        ),
        (
            mesh("triangles = [[0, 1, -1]]"),
            "5:21: `triangles[0][2]` is -1, must be the index of one of the 3 positions, from 0",
        ),
        (
            mesh("triangles = [[0, 1]]"),
            "5:14: `triangles[0]` must be a list of 3 whole numbers, found a list of 2",
        ),
        (
            mesh("triangles = [0, 1, 2]"),
            "5:14: `triangles[0]` must be a list of 3 whole numbers, found a whole number",
        ),
        (
            mesh("triangles = [[0, 1, 2.5]]"),
            "5:21: `triangles[0][2]` must be a whole number, found a decimal number",
        ),
        (
            mesh("polygons = [[0, 1]]"),
            "5:13: `polygons[0]` must be a list of 3 or more whole numbers, found a list of 2",
        ),
        (
            mesh("polygons = [[0, 1, 2, 7]]"),
            "5:23: `polygons[0][3]` is 7, must be the index of one of the 3 positions, from 0",
        ),
        (
            mesh("triangles = [[0, 1, 2]]\nnormals = [[0, 0, 1]]"),
            "6:11: `normals` must have one entry for each of the 3 positions, found 1",
        ),
        (
            mesh("triangles = [[0, 1, 2]]\nnormals = [[0, 0, 1], [0, 0, 0], [0, 0, 1]]"),
            "6:23: `normals[1]` is the zero vector and gives no direction",
        ),
        (
            mesh("triangles = [[0, 1, 2]]\nuvs = [[0, 1], [0, 1, 2], [0, 1]]"),
            "6:16: `uvs[1]` must be a list of 2 numbers, found a list of 3",
        ),
        (
            mesh("triangles = [[0, 1, 2]]\nmaterials = {}"),
            "6:13: `materials` needs a `file`; give the material to the instance",
        ),
        (
            "[mesh.m]\npositions = [[0, 0, nan]]\ntriangles = [[0, 0, 0]]".into(),
            "4:21: `positions[0][2]` is nan, must be finite",
        ),
        (
            "[mesh.m]\nfile = 'a.obj'\n[[instance]]\nmesh = 'n'".into(),
            "6:8: no mesh is named `n`; meshes are `m`",
        ),
        (
            "[mesh.m]\nfile = 'a.obj'\nmaterials = { Steel = 'red' }\n[[instance]]\nmesh = 'm'".into(),
            "6:1: `material` is missing in instance 1, and part `Glass` of the mesh has none",
        ),
        ("[[instance]]\nmaterial = 'red'".into(), "3:1: `mesh` is missing in instance 1"),
        ("[[instance]]\nmesh = 'm'".into(), "4:8: no mesh is named `m`; there are no meshes"),
        (
            "[[instance]]\nname = 'm'".into(),
            "4:1: unknown key `name` in instance 1; its keys are `mesh`, `material`, `transform`, `transform_close`, `file`, `time`, `variant`",
        ),
    ];
    check_with_material(&cases.iter().map(|(text, message)| (text.as_str(), *message)).collect::<Vec<_>>());
}

#[test]
fn lights_and_environment() {
    check(&[
        (
            "[[light]]\nkind = 'sun'",
            "2:8: `kind` is \"sun\", must be one of \"spot\", \"distant\", \"point\", \"projection\", \"sphere\", \"disk\", \"quad\", \"cylinder\", \"patch\"",
        ),
        ("[[light]]\nkind = 'point'\nposition = [0, 0, 0]", "1:1: `intensity` is missing in point light 1"),
        (
            "[[light]]\nkind = 'point'\nposition = [0, 0, 0]\nintensity = -1",
            "4:13: `intensity` is -1, must be at least 0",
        ),
        (
            "[[light]]\nkind = 'point'\nposition = [0, 0, 0]\nradiance = 1",
            "4:1: unknown key `radiance` in point light 1; it is a key of sphere, disk, quad, cylinder, patch",
        ),
        (
            "[[light]]\nkind = 'spot'\nposition = [0, 0, 0]\nintensity = 1",
            "1:1: spot light 1 has neither `target` nor `direction`; add one of them",
        ),
        (
            "[[light]]\nkind = 'spot'\nposition = [0, 0, 0]\nintensity = 1\ntarget = [0, 0, 0]",
            "5:10: spot light 1 aims at its own position",
        ),
        (
            "[[light]]\nkind = 'point'\nposition = [0, 0, 0]\nintensity = 1\nscale = 2\npower = 3",
            "6:9: point light 1 has both `scale` and `power`; keep one of them",
        ),
        (
            "[[light]]\nkind = 'point'\nposition = [0, 0, 0]\nintensity = 1\ntransform = [{ scale = 2 }]",
            "5:13: the `transform` of point light 1 is more than a rotation; use `rotate` steps only",
        ),
        (
            "[[light]]\nkind = 'spot'\nposition = [0, 0, 0]\nintensity = 1\ntransform = [{ translate = [0, 0, 1] }]",
            "5:13: the `transform` of spot light 1 is more than a rotation; use `rotate` steps only",
        ),
        (
            "[[light]]\nkind = 'spot'\nposition = [0, 0, 0]\nintensity = 1\ntransform = []\ntarget = [0, 0, 1]",
            "6:10: `target` has no meaning beside `transform`, which turns a light from −z with y up; keep one or the other",
        ),
        (
            "[[light]]\nkind = 'projection'\nposition = [0, 0, 0]\nintensity = 1\ntransform = [{ scale = [1, 1, -1] }]",
            "5:13: the `transform` of projection light 1 is more than a rotation; use `rotate` steps only",
        ),
        (
            "[[light]]\nkind = 'projection'\nposition = [0, 0, 0]\nintensity = 1\ntransform = []\nup = [0, 1, 0]",
            "6:6: `up` has no meaning beside `transform`, which turns a light from −z with y up; keep one or the other",
        ),
        (
            "[[light]]\nkind = 'distant'\nirradiance = 1\ntransform = [{ matrix = [1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] }]",
            "4:13: the `transform` of distant light 1 is more than a rotation; use `rotate` steps only",
        ),
        (
            "[[light]]\nkind = 'distant'\nirradiance = 1\ntransform = []\nfrom = [0, 1, 0]",
            "5:8: `from` has no meaning beside `transform`, which turns a light from −z with y up; keep one or the other",
        ),
        (
            "[[light]]\nkind = 'projection'\nposition = [0, 0, 0]\nintensity = 1\ntarget = [1, 0, 0]\nup = [2, 0, 0]",
            "6:6: `up` is parallel to the direction of the light; turn one of them",
        ),
        (
            "[[light]]\nkind = 'spot'\nposition = [0, 0, 0]\nintensity = 1\ntarget = [1, 0, 0]\ncone_angle = 20\nfalloff_angle = 181",
            "7:17: `falloff_angle` is 181, must be from 0 to 180",
        ),
        (
            "[[light]]\nkind = 'distant'\nirradiance = 1\nfrom = [0, 0, 0]",
            "4:8: `from` is the zero vector and gives no direction",
        ),
        ("[[light]]\nkind = 'sphere'\nradius = 1", "1:1: `radiance` is missing in sphere light 1"),
        (
            "[[light]]\nkind = 'quad'\nradiance = 1\norigin = [0, 0, 0]\nedge_u = [1, 0, 0]",
            "1:1: `edge_v` is missing in quad light 1",
        ),
        (
            "[[light]]\nkind = 'distant'\nirradiance = { texture = 'a' }\nfrom = [0, 1, 0]",
            "3:26: no texture is named `a`; there are no textures",
        ),
        ("[environment]", "1:1: [environment] has neither `color` nor `texture`; add one of them"),
        (
            "[environment]\ncolor = 1\ntexture = 'a'",
            "3:11: [environment] has both `color` and `texture`; keep one of them",
        ),
        ("[environment]\ntexture = 'a'", "2:11: no texture is named `a`; there are no textures"),
        (
            "[environment]\ncolor = 1\nrotate = [0, 1, 0]",
            "3:10: `rotate` must be a number, found a list of 3",
        ),
        (
            "[environment]\ncolor = 1\ntransform = [{ scale = 2 }]",
            "3:13: the `transform` of [environment] is more than a rotation; use `rotate` steps only",
        ),
        (
            "[environment]\ncolor = 1\ntransform = [{ translate = [0, 1, 0] }]",
            "3:13: the `transform` of [environment] is more than a rotation; use `rotate` steps only",
        ),
        (
            "[environment]\ncolor = 1\ntransform = [{ matrix = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] }]",
            "3:13: the `transform` of [environment] is more than a rotation; use `rotate` steps only",
        ),
    ]);
}
