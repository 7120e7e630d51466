//! Which switches a kernel is compiled with, for a scene.

use super::{Features, Prepared, View, menus};
use crate::layout::{
    Backend, INPUT_EMISSION, LIGHT_CYLINDER, LIGHT_DISK, LIGHT_DISK_PART, LIGHT_PATCH, LIGHT_POINT,
    LIGHT_PROJECTION, LIGHT_QUAD, LIGHT_SPHERE, LIGHT_SPHERE_PART, LIGHT_TRIANGLE, MATERIAL_DIELECTRIC,
    STACK_ENTRIES,
};
use crate::scene::{
    BSDFS, FilterKind, FisheyeMapping, Focus, Opening, PUNCTUAL_LIGHTS, Projection, Sampler, Scene,
};
use std::collections::BTreeMap;

/// The kernels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// First rays.
    Camera,
    /// Nearest surfaces.
    Intersect,
    /// Scattering events.
    Shade,
    /// Shadow rays.
    Shadow,
    /// Nearest surfaces, for rays that are too long for one dispatch.
    IntersectLong,
    /// Shadow rays that are too long for one dispatch.
    ShadowLong,
    /// Queues.
    Advance,
    /// Sums.
    Film,
    /// Texture values for the host.
    Evaluate,
}

impl Stage {
    /// All stages; those of a wave come first, in the order of the enum.
    pub const ALL: [Self; 9] = [
        Self::Camera,
        Self::Intersect,
        Self::Shade,
        Self::Shadow,
        Self::IntersectLong,
        Self::ShadowLong,
        Self::Advance,
        Self::Film,
        Self::Evaluate,
    ];

    /// The stages that paths go through.
    pub const WAVE: [Self; 8] = [
        Self::Camera,
        Self::Intersect,
        Self::Shade,
        Self::Shadow,
        Self::IntersectLong,
        Self::ShadowLong,
        Self::Advance,
        Self::Film,
    ];

    /// Whether rays are followed.
    fn traverses(self) -> bool {
        matches!(self, Self::Intersect | Self::Shadow | Self::IntersectLong | Self::ShadowLong)
    }

    /// Its name: that of its file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Intersect => "intersect",
            Self::Shade => "shade",
            Self::Shadow => "shadow",
            Self::IntersectLong => "intersect (long rays)",
            Self::ShadowLong => "shadow (long rays)",
            Self::Advance => "advance",
            Self::Film => "film",
            Self::Evaluate => "evaluate",
        }
    }

    /// File in the shader tree.
    pub fn file(self) -> &'static str {
        match self {
            Self::Camera => "stages/camera.comp",
            Self::Intersect | Self::IntersectLong => "stages/intersect.comp",
            Self::Shade => "stages/shade.comp",
            Self::Shadow | Self::ShadowLong => "stages/shadow.comp",
            Self::Advance => "stages/advance.comp",
            Self::Film => "stages/film.comp",
            Self::Evaluate => "stages/evaluate.comp",
        }
    }
}

pub(super) const SAMPLERS: [(&str, Sampler); 5] = [
    ("SAMPLER_CENTER", Sampler::Center),
    ("SAMPLER_REGULAR", Sampler::Regular),
    ("SAMPLER_RANDOM", Sampler::Random),
    ("SAMPLER_STRATIFIED", Sampler::Stratified),
    ("SAMPLER_SOBOL", Sampler::Sobol),
];

const FILTERS: [&str; 5] =
    ["FILTER_BOX", "FILTER_TENT", "FILTER_GAUSSIAN", "FILTER_BLACKMAN_HARRIS", "FILTER_TABLE"];

const CAMERAS: [&str; 5] =
    ["CAMERA_PERSPECTIVE", "CAMERA_ORTHOGRAPHIC", "CAMERA_EQUIRECTANGULAR", "CAMERA_FISHEYE", "CAMERA_LENS"];

const OPENINGS: [&str; 3] = ["OPENING_ROUND", "OPENING_POLYGON", "OPENING_PICTURE"];

/// The switches of the camera.
fn camera(scene: &Scene, set: &mut impl FnMut(&str, String)) {
    for (i, name) in CAMERAS.iter().enumerate() {
        set(name, i.to_string());
    }
    for (i, name) in OPENINGS.iter().enumerate() {
        set(name, i.to_string());
    }
    let camera = match scene.camera.projection {
        Projection::Perspective(_) => 0,
        Projection::Orthographic { .. } => 1,
        Projection::Equirectangular => 2,
        Projection::Fisheye { .. } => 3,
        Projection::Lens(_) => 4,
    };
    set("CAMERA", camera.to_string());
    let opening = match scene.camera.opening() {
        Some(Opening { image: Some(_), .. }) => 2,
        Some(Opening { blades, .. }) if blades > 0 => 1,
        _ => 0,
    };
    set("OPENING", opening.to_string());
    let mut flag = |name: &str, on: bool| {
        if on {
            set(name, "1".to_owned());
        }
    };
    let thin = scene.camera.thin_lens();
    flag("HAS_LENS", thin.is_some());
    flag("FOCUS_PLANE", thin.is_some_and(|lens| matches!(lens.focus, Focus::Plane { .. })));
    flag("CAT_EYE", thin.is_some_and(|lens| lens.cat_eye > 0.0));
    let equisolid = FisheyeMapping::Equisolid;
    flag(
        "FISHEYE_EQUISOLID",
        matches!(scene.camera.projection, Projection::Fisheye { mapping, .. } if mapping == equisolid),
    );
    let system = scene.camera.lens_system();
    flag("LENS_DISPERSION", system.is_some_and(|lens| lens.dispersion));
    flag("LENS_SHAPE", system.is_some_and(|lens| opening > 0 || lens.opening.anamorphic != 1.0));
}

/// Whether what a stage does depends on the time of a path.
fn has_time(features: &Features, stage: Stage) -> bool {
    match stage {
        Stage::Camera => features.camera_moves,
        Stage::Shade => features.moves || features.camera_moves || features.timed_textures,
        _ if stage.traverses() => features.moves || features.opacity && features.timed_textures,
        _ => false,
    }
}

/// The switches of a stage, or of the kernel of a view that stands for it: only those that its files ask for, so that a scene edit
/// compiles only what it touches.
pub fn defines(
    scene: &Scene,
    prepared: &Prepared,
    stage: Stage,
    view: Option<View>,
    backend: Backend,
) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    let mut set = |name: &str, value: String| _ = all.insert(name.to_owned(), value);
    if backend == Backend::Texel {
        set("TEXEL_FETCH", "1".to_owned());
    }
    // Every stage of the wave includes the random numbers.
    for (i, (name, sampler)) in SAMPLERS.iter().enumerate() {
        set(name, i.to_string());
        let draws = matches!(stage, Stage::Camera | Stage::Shade) || has_time(&prepared.features, stage);
        if *sampler == scene.render.sampler && draws {
            set("SAMPLER", i.to_string());
        }
    }
    let features = &prepared.features;
    if stage == Stage::Camera {
        for (i, name) in FILTERS.iter().enumerate() {
            set(name, i.to_string());
        }
        let filter = match scene.film.filter.kind {
            FilterKind::Box => 0,
            FilterKind::Tent => 1,
            FilterKind::Gaussian => 2,
            FilterKind::BlackmanHarris => 3,
            FilterKind::Mitchell { .. } | FilterKind::Sinc { .. } => 4,
        };
        set("FILTER", filter.to_string());
        camera(scene, &mut set);
    }
    let mut flag = |name: &str, on: bool| {
        if on {
            _ = all.insert(name.to_owned(), "1".to_owned());
        }
    };
    let signed = matches!(scene.film.filter.kind, FilterKind::Mitchell { .. } | FilterKind::Sinc { .. });
    flag("SIGNED_FILTER", stage == Stage::Film && signed);
    flag("HAS_TIME", has_time(features, stage));
    flag("HAS_MOTION", features.moves && (stage.traverses() || stage == Stage::Shade));
    let scatters = stage == Stage::Shade && view.is_none_or(|view| view.stage() != stage);
    let relieves = scatters || stage == Stage::Shade && view == Some(View::Normals);
    flag("MOVING_CAMERA", features.camera_moves && (stage == Stage::Camera || scatters));
    let counts = matches!(stage, Stage::Intersect | Stage::IntersectLong);
    flag("COUNT_TESTS", counts && view == Some(View::BvhCost));
    flag("PARKING", matches!(stage, Stage::IntersectLong | Stage::ShadowLong));
    if stage.traverses() || stage == Stage::Shade {
        flag("HAS_INSTANCES", features.instances);
        flag("HAS_SPHERES", features.spheres);
        flag("HAS_DISKS", features.disks);
        flag("HAS_PARTS", features.parts);
        flag("HAS_PATCHES", features.patches);
        flag("HAS_OPACITY", features.opacity);
        flag("HAS_FRONT_ONLY", features.front_only);
        flag("HAS_FILTER", features.filter);
    }
    if stage.traverses() || matches!(stage, Stage::Shade | Stage::Evaluate) {
        flag("HAS_VERTEX_COLOR", features.vertex_color);
        flag("HAS_UV1", features.uv1);
    }
    if relieves {
        flag("HAS_MIX", features.mix_depth > 0);
        flag("HAS_FOOTPRINT", features.footprint);
        flag("HAS_BUMP", features.bump);
        flag("HAS_NORMAL_MAP", features.normal_map);
    }
    if scatters {
        let material = |kind: u32| features.material_kinds & 1 << kind != 0;
        for row in menus::materials(BSDFS) {
            flag(&row.switch(), material(row.number));
        }
        flag("HAS_INTERFACE_TABLES", !prepared.interfaces.is_empty());
        flag("HAS_GLASS", material(MATERIAL_DIELECTRIC) || features.transmission);
        flag("HAS_TRANSMISSION", features.transmission);
        flag("HAS_CLEARCOAT", features.clearcoat);
        flag("HAS_SHEEN", features.sheen);
        flag("HAS_MEDIUM", features.medium);
        flag("HAS_DISPERSION", features.dispersion);
        flag("HAS_METAL_INDEX", features.metal_index);
        flag("ANISOTROPIC", features.anisotropic);
        flag("TEXTURED_EMISSION", features.textured_inputs & 1 << (2 * INPUT_EMISSION) != 0);
        flag("HAS_LIGHTS", !prepared.lights.is_empty());
        let light = |kind: u32| features.light_kinds & 1 << kind != 0;
        flag("HAS_LIGHT_POINT", light(LIGHT_POINT));
        for row in menus::lights(PUNCTUAL_LIGHTS) {
            flag(&row.switch(), light(row.number));
        }
        flag("HAS_LIGHT_PROJECTION", light(LIGHT_PROJECTION));
        flag("TEXTURED_LIGHTS", features.textured_lights);
        flag("EQUAL_AREA_LIGHTS", features.equal_area_lights);
        flag("HAS_LIGHT_SPHERE", light(LIGHT_SPHERE));
        flag("HAS_LIGHT_QUAD", light(LIGHT_QUAD));
        flag("HAS_LIGHT_DISK", light(LIGHT_DISK));
        flag("HAS_LIGHT_TRIANGLE", light(LIGHT_TRIANGLE));
        flag("HAS_LIGHT_PART", [LIGHT_SPHERE_PART, LIGHT_DISK_PART, LIGHT_CYLINDER].into_iter().any(light));
        flag("HAS_LIGHT_PATCH", light(LIGHT_PATCH));
        flag("HAS_ENVIRONMENT", features.environment);
        flag("ENVIRONMENT_IMAGE", features.environment_image);
        flag("ENVIRONMENT_EQUAL_AREA", features.environment_equal_area);
        flag("ROULETTE", scene.render.russian_roulette);
        flag("GEOMETRIC_VETO", scene.render.geometric_veto);
        // Without an environment there is nothing to leave out: one variant less.
        flag("TRANSPARENT_FILM", scene.film.transparent && features.environment);
    }
    if relieves {
        all.insert("TEXTURED_INPUTS".to_owned(), format!("{}u", features.textured_inputs));
        if features.mix_depth > 0 {
            all.insert("MIX_DEPTH".to_owned(), format!("{}u", features.mix_depth));
        }
    }
    if stage.traverses() {
        all.insert("TRAVERSAL_STACK".to_owned(), stack_size(prepared.stack_entries).to_string());
    }
    all
}

/// Stack of the kernels for a scene: a multiple of 16, so that scenes share variants.
pub fn stack_size(entries: u32) -> u32 {
    entries.next_multiple_of(16).clamp(16, STACK_ENTRIES)
}
