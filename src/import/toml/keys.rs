//! Every key of the scene language, once. `scenes/README.md` explains each of them.

mod materials;
mod shapes;
mod textures;

use crate::scene::PUNCTUAL_LIGHTS;
use std::sync::LazyLock;

pub(super) use materials::MATERIAL;
pub(super) use shapes::SHAPE;
pub(super) use textures::{MAPPING, TEXTURE, TEXTURE_VALUE};

/// Kinds, and the keys that each adds.
type Rows = &'static [(&'static str, &'static [&'static str])];

/// Keys of an object that has a `kind`.
pub(super) struct Kinds {
    /// Keys of every kind.
    pub common: &'static [&'static str],
    /// The kinds.
    pub kinds: Rows,
}

impl Kinds {
    /// Kinds that are put together once, for as long as the program runs.
    fn listed(
        common: &'static [&'static str],
        kinds: impl Iterator<Item = (&'static str, Vec<&'static str>)>,
    ) -> Self {
        let kinds: Vec<_> = kinds.map(|(kind, keys)| (kind, &*keys.leak())).collect();
        Self { common, kinds: kinds.leak() }
    }
}

/// Keys and tables at the top of a file.
pub(super) const TOP: &[&str] = &[
    "include",
    "film",
    "render",
    "camera",
    "texture",
    "material",
    "mesh",
    "shape",
    "instance",
    "light",
    "environment",
];

/// Tables that exist once.
pub(super) const SETTINGS: &[&str] = &["film", "render", "camera", "environment"];
/// Tables of named objects.
pub(super) const NAMED: &[&str] = &["texture", "material", "mesh"];
/// Lists of tables.
pub(super) const LISTS: &[&str] = &["shape", "instance", "light"];

pub(super) const FILM: &[&str] = &[
    "size",
    "crop",
    "filter",
    "filter_radius",
    "filter_b",
    "filter_c",
    "filter_tau",
    "exposure",
    "tone_curve",
    "png_bits",
    "transparent",
];

pub(super) const RENDER: &[&str] = &[
    "spp",
    "seed",
    "sampler",
    "strata",
    "max_depth",
    "diffuse_bounces",
    "russian_roulette",
    "firefly_clamp",
    "geometric_veto",
];

const PERSPECTIVE: &[&str] = &[
    "fov",
    "fov_axis",
    "lens_radius",
    "f_number",
    "sensor_height",
    "focus_distance",
    "focus_point",
    "focus_normal",
    "blades",
    "blade_rotation",
    "anamorphic",
    "aperture_image",
    "cat_eye",
    "shutter",
    "iso",
];
const LENS: &[&str] = &[
    "file",
    "spacing",
    "unit",
    "sensor_diagonal",
    "focus_distance",
    "focus_point",
    "f_number",
    "aperture",
    "blades",
    "blade_rotation",
    "anamorphic",
    "aperture_image",
    "dispersion",
    "measure",
    "shutter",
    "iso",
];

pub(super) const CAMERA: Kinds = Kinds {
    common: &["kind", "position", "target", "up", "position_close", "target_close", "up_close", "mirrored"],
    kinds: &[
        ("perspective", PERSPECTIVE),
        ("orthographic", &["view_size", "fov_axis"]),
        ("equirectangular", &[]),
        ("fisheye", &["mapping", "fov", "fov_axis"]),
        ("lens", LENS),
    ],
};

/// Keys of `bump`.
pub(super) const BUMP: &[&str] = &["texture", "height", "derivative", "curvature_term"];
/// Keys of `normal_map`.
pub(super) const NORMAL_MAP: &[&str] = &["texture", "green", "strength", "tangents"];

/// Keys of `displacement`.
pub(super) const DISPLACEMENT: &[&str] =
    &["texture", "height", "offset", "direction", "edge_length", "edge_pixels", "max_triangles"];

pub(super) const MESH: &[&str] = &[
    "displacement",
    "file",
    "levels",
    "materials",
    "parts",
    "positions",
    "round",
    "triangles",
    "polygons",
    "normals",
    "uvs",
    "uvs1",
    "colors",
    "smooth",
    "subdivision",
];

pub(super) const INSTANCE: &[&str] =
    &["mesh", "material", "transform", "transform_close", "file", "time", "variant"];

/// Of each of the `parts` of a mesh.
pub(super) const PART: &[&str] = &["name", "triangles", "material"];

/// Steps of a `transform`.
pub(super) const STEP: &[&str] = &["translate", "rotate", "angle", "scale", "matrix"];

/// Keys of a light of the table that has a place.
const PLACED: &[&str] =
    &["position", "target", "direction", "up", "transform", "intensity", "scale", "power"];
/// Keys of one that is infinitely far away.
const FAR: &[&str] = &["direction", "from", "up", "transform", "irradiance", "scale"];

pub(super) static LIGHT: LazyLock<Kinds> = LazyLock::new(|| {
    let table = PUNCTUAL_LIGHTS.iter().map(|kind| {
        let own = kind.numbers.iter().map(|number| number.key);
        let shared = if kind.shines.is_some() { PLACED } else { FAR };
        (kind.name, shared.iter().copied().chain(own).collect())
    });
    let frustum = [PLACED, &["fov", "fov_axis", "aspect"]].concat();
    let point: &[&str] = &["position", "intensity", "scale", "power", "mapping", "rotate", "transform"];
    let others = [
        ("point", point.to_vec()),
        ("projection", frustum),
        ("sphere", shapes::SPHERE_LIGHT.to_vec()),
        ("disk", shapes::DISK_LIGHT.to_vec()),
        ("quad", shapes::QUAD_LIGHT.to_vec()),
        ("cylinder", shapes::CYLINDER_LIGHT.to_vec()),
        ("patch", shapes::PATCH_LIGHT.to_vec()),
    ];
    Kinds::listed(&["kind"], table.chain(others))
});

pub(super) const ENVIRONMENT: &[&str] = &["color", "texture", "mapping", "scale", "rotate", "transform"];

/// Keys of which an object has one at most. A file that includes another, and `--set`, replace one by the other.
pub(super) const RIVALS: &[(&str, &[&[&str]])] = &[
    (
        "camera",
        &[
            &["lens_radius", "f_number"],
            &["f_number", "aperture"],
            &["focus_distance", "focus_point"],
            &["blades", "aperture_image"],
        ],
    ),
    (
        "texture",
        &[
            &["file", "files", "source"],
            &["transform", "matrix"],
            &["mapping_transform", "mapping_matrix"],
            &["pole", "mapping_matrix"],
            &["meridian", "mapping_matrix"],
        ],
    ),
    ("environment", &[&["color", "texture"], &["rotate", "transform"]]),
    (
        "material",
        &[
            &["roughness", "alpha"],
            &["interface_roughness", "interface_alpha"],
            &["fresnel", "eta"],
            &["fresnel", "k"],
            &["reflectance", "eta"],
        ],
    ),
    ("shape", &[&["origin", "center"]]),
    (
        "light",
        &[
            &["target", "direction"],
            &["direction", "from"],
            &["origin", "center"],
            &["scale", "power"],
            &["rotate", "transform"],
            &["target", "transform"],
            &["direction", "transform"],
            &["from", "transform"],
            &["up", "transform"],
        ],
    ),
];

/// The rivals of a key of a table.
pub(super) fn rivals(table: &str, key: &str) -> Vec<&'static str> {
    RIVALS
        .iter()
        .filter(|(name, _)| *name == table)
        .flat_map(|(_, groups)| groups.iter())
        .filter(|group| group.contains(&key))
        .flat_map(|group| group.iter().copied().filter(|other| *other != key))
        .collect()
}
