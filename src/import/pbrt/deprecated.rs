//! Spellings of pbrt-v3 and before, and what pbrt-v4 has in their place.

/// Directives.
pub(super) const DIRECTIVES: &[(&str, &str)] = &[
    ("WorldEnd", "leave it out: the world ends with the file"),
    ("SurfaceIntegrator", "write `Integrator`"),
    ("VolumeIntegrator", "write `Integrator`"),
    ("Volume", "write `MakeNamedMedium`"),
    ("Renderer", "leave it out"),
];

/// Types of parameters.
pub(super) const TYPES: &[(&str, &str)] = &[
    ("point", "write `point3` or `point2`"),
    ("vector", "write `vector3` or `vector2`"),
    ("normal3", "write `normal`"),
    ("color", "write `rgb`"),
    ("xyz", "convert the colour and write `rgb`"),
    ("int", "write `integer`"),
];

/// Names of parameters.
pub(super) const PARAMETERS: &[(&str, &str)] = &[
    ("Kd", "write `reflectance`"),
    ("Kr", "write `reflectance`"),
    ("Ks", "write `roughness` and `eta` of a coateddiffuse"),
    ("Kt", "write `transmittance` of a diffusetransmission"),
    ("bumpmap", "write `displacement`"),
    ("index", "write `eta`"),
    ("opacity", "write `alpha` of the shape"),
    ("mapname", "write `filename`"),
    ("nsamples", "leave it out"),
    ("samples", "leave it out"),
    ("trilinear", "write \"string filter\" \"trilinear\""),
    ("st", "write \"point2 uv\""),
    ("gamma", "write \"string encoding\" \"linear\" or \"sRGB\""),
    ("maxdist", "leave it out"),
    ("nlevels", "write `levels`"),
];

/// Kinds of things: what is after the directive.
pub(super) const KINDS: &[(&str, &str, &str)] = &[
    ("Material", "matte", "write \"diffuse\""),
    ("Material", "plastic", "write \"coateddiffuse\""),
    ("Material", "substrate", "write \"coateddiffuse\""),
    ("Material", "uber", "write \"coateddiffuse\", and `alpha` of the shape for its opacity"),
    ("Material", "metal", "write \"conductor\""),
    ("Material", "mirror", "write \"conductor\" with a `reflectance`"),
    ("Material", "glass", "write \"dielectric\""),
    ("Material", "translucent", "write \"diffusetransmission\""),
    ("Material", "disney", "write \"coateddiffuse\" or \"conductor\""),
    ("Material", "fourier", "write \"measured\""),
    ("Material", "kdsubsurface", "write \"subsurface\""),
    ("Material", "none", "write \"interface\""),
    ("Material", "", "write \"interface\""),
    ("Camera", "environment", "write \"spherical\" with \"string mapping\" \"equirectangular\""),
    ("Film", "image", "write \"rgb\""),
    ("AreaLightSource", "area", "write \"diffuse\""),
    ("LightSource", "exinfinite", "write \"infinite\""),
    ("Sampler", "lowdiscrepancy", "write \"zsobol\""),
    ("Sampler", "02sequence", "write \"zsobol\""),
    ("Sampler", "maxmindist", "write \"pmj02bn\""),
    ("Sampler", "random", "write \"independent\""),
    ("Integrator", "directlighting", "write \"path\" with \"integer maxdepth\" 1"),
    ("Integrator", "whitted", "write \"path\""),
    ("Shape", "cone", "write a \"trianglemesh\""),
    ("Shape", "paraboloid", "write a \"trianglemesh\""),
    ("Shape", "hyperboloid", "write a \"trianglemesh\""),
    ("Shape", "heightfield", "write a \"trianglemesh\""),
    ("Shape", "nurbs", "write a \"trianglemesh\""),
    ("Texture", "uv", "it is gone"),
    ("Texture", "color", "write `spectrum`"),
];

/// What to write in place of a word.
pub(super) fn instead(table: &[(&'static str, &'static str)], word: &str) -> Option<&'static str> {
    table.iter().find(|(old, _)| *old == word).map(|(_, new)| *new)
}

/// What to write in place of a kind.
pub(super) fn kind_instead(directive: &str, kind: &str) -> Option<&'static str> {
    KINDS.iter().find(|(of, old, _)| *of == directive && *old == kind).map(|(_, _, new)| *new)
}
