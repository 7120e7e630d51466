//! Parts of quadrics, tubes, patches and subdivision.

use super::{check, check_with_material};

#[test]
fn quadrics_and_patches() {
    let shape = |text: &str| format!("[[shape]]\nmaterial = 'red'\n{text}");
    let patch = |text: &str| shape(&format!("kind = 'patch'\np00 = [0, 0, 0]\np10 = [1, 0, 0]\n{text}"));
    let cases = [
        (shape("kind = 'sphere'\nradius = 1\nz_min = -2"), "7:9: `z_min` is -2, must be from -1 to 1"),
        (
            shape("kind = 'sphere'\nradius = 1\nz_min = 0.5\nz_max = 0.25"),
            "8:9: `z_min`, 0.5, is not below `z_max`, 0.25",
        ),
        (shape("kind = 'sphere'\nradius = 1\nz_min = 1"), "7:9: `z_min`, 1, is not below `z_max`, 1"),
        (
            shape("kind = 'sphere'\nradius = 1\nphi_max = 400"),
            "7:11: `phi_max` is 400, must be above 0 and at most 360",
        ),
        (
            shape("kind = 'disk'\nradius = 1\ninner_radius = 1"),
            "7:16: `inner_radius` is 1, must be below the radius, 1",
        ),
        (
            shape("kind = 'disk'\nradius = 1\ninner_radius = -1"),
            "7:16: `inner_radius` is -1, must be at least 0",
        ),
        (shape("kind = 'cylinder'\nradius = 1\nz_min = 0"), "3:1: `z_max` is missing in cylinder shape 1"),
        (
            shape("kind = 'cylinder'\nradius = 1\naxis = [1, 0, 0]\nmeridian = [2, 0, 0]"),
            "8:12: `meridian` is parallel to `axis`; turn one of them",
        ),
        (
            patch("p01 = [2, 0, 0]\np11 = [3, 0, 0]"),
            "3:1: patch shape 1 has no area: its corners are on one line, or `p10` is `p01`",
        ),
        (
            patch("p01 = [0, 1, 0]\np11 = [1, 1, 0]\nnormals = [[0, 0, 1]]"),
            "10:11: `normals` must be a list of 4 values, those of p00, p10, p01 and p11, found a list of 1",
        ),
        (patch("p01 = [0, 1, 0]"), "3:1: `p11` is missing in patch shape 1"),
        (
            format!(
                "[texture.t]\nkind = 'constant'\ncolor = 0\n{}",
                shape("kind = 'sphere'\nradius = 1\nz_min = 0\ndisplacement = { texture = 't' }")
            ),
            "11:16: a part of a sphere cannot be displaced; displace all of it, or a mesh",
        ),
    ];
    let cases: Vec<_> = cases.iter().map(|(text, message)| (text.as_str(), *message)).collect();
    check_with_material(&cases);
}

#[test]
fn subdivision() {
    let mesh = |rest: &str| {
        format!("[mesh.a]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2]]\n{rest}")
    };
    let cases = [
        (mesh("levels = 2"), "4:10: `levels` has no meaning without `subdivision`; add `subdivision = \"loop\"`"),
        (mesh("subdivision = 'catmull'"), "4:15: `subdivision` is \"catmull\", must be \"loop\""),
        (mesh("subdivision = 'loop'\nlevels = 11"), "5:10: `levels` is 11, must be from 0 to 10"),
        (
            "[mesh.a]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2], [0, 1, 2]]\nsubdivision = 'loop'".into(),
            "1:1: mesh `a` cannot be subdivided: the triangles around the vertex at [0, 0, 0] are no simple fan; \
             an edge must have one or two triangles, which go round the same way",
        ),
        (
            "[mesh.a]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]\ntriangles = [[0, 1, 2], [1, 3, 2], [0, 1, 2], [1, 3, 2]]\nsubdivision = 'loop'\nlevels = 10".into(),
            "1:1: mesh `a` cannot be subdivided: 10 levels make 4^10 triangles of each of 4, more than 4000000 in all; \
             subdivide less often",
        ),
        (
            format!(
                "[mesh.a]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = {:?}\nsubdivision = 'loop'\nlevels = 10",
                [[0, 1, 2]; 17]
            ),
            "1:1: with mesh `a` the subdivided meshes have more than 16777216 triangles; subdivide less often",
        ),
    ];
    let cases: Vec<_> = cases.iter().map(|(text, message)| (text.as_str(), *message)).collect();
    check(&cases);
}
