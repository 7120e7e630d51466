//! `[film]` and `[render]`.

use super::keys::Keys;
use crate::scene::{Film, FilterKind, Meter, Render, Sampler, ToneCurve};
use toml_edit::Value;

pub(super) fn film(film: &Film) -> Keys {
    let mut keys = Keys::new();
    let default = Film::default();
    let whole = |values: &[u32]| values.iter().map(|&value| i64::from(value)).collect::<Value>();
    if [film.width, film.height] != [default.width, default.height] {
        keys.set("size", whole(&[film.width, film.height]));
    }
    if let Some(crop) = film.crop {
        keys.set("crop", whole(&[crop.x0, crop.y0, crop.x1, crop.y1]));
    }
    if film.filter != default.filter {
        filter(&mut keys, film);
    }
    match film.exposure.meter {
        Meter::Auto => keys.set("exposure", "auto"),
        _ => keys.number("exposure", film.exposure.stops, 0.0),
    }
    let curve = |curve| match curve {
        ToneCurve::Srgb => "srgb",
        ToneCurve::Linear => "linear",
        ToneCurve::Aces => "aces",
        ToneCurve::Agx => "agx",
    };
    keys.word("tone_curve", curve(film.tone_curve), curve(default.tone_curve));
    keys.count("png_bits", film.png_bits, default.png_bits);
    keys.flag("transparent", film.transparent, default.transparent);
    keys
}

fn filter(keys: &mut Keys, film: &Film) {
    keys.set(
        "filter",
        match film.filter.kind {
            FilterKind::Box => "box",
            FilterKind::Tent => "tent",
            FilterKind::Gaussian => "gaussian",
            FilterKind::BlackmanHarris => "blackman_harris",
            FilterKind::Mitchell { .. } => "mitchell",
            FilterKind::Sinc { .. } => "sinc",
        },
    );
    keys.number("filter_radius", film.filter.radius, f32::NAN);
    match film.filter.kind {
        FilterKind::Mitchell { b, c } => {
            keys.number("filter_b", b, 1.0 / 3.0);
            keys.number("filter_c", c, 1.0 / 3.0);
        }
        FilterKind::Sinc { tau } => keys.number("filter_tau", tau, 3.0),
        _ => {}
    }
}

pub(super) fn render(render: &Render) -> Keys {
    let mut keys = Keys::new();
    let default = Render::default();
    keys.count("spp", render.spp, default.spp);
    if render.seed != default.seed {
        keys.set("seed", i64::from(render.seed));
    }
    let sampler = |sampler| match sampler {
        Sampler::Sobol => "sobol",
        Sampler::Stratified => "stratified",
        Sampler::Random => "random",
        Sampler::Regular => "regular",
        Sampler::Center => "center",
    };
    keys.word("sampler", sampler(render.sampler), sampler(default.sampler));
    if render.strata != default.strata {
        keys.set("strata", render.strata.iter().map(|&n| i64::from(n)).collect::<Value>());
    }
    keys.count("max_depth", render.max_depth, default.max_depth);
    if let Some(bounces) = render.diffuse_bounces {
        keys.set("diffuse_bounces", i64::from(bounces));
    }
    keys.flag("russian_roulette", render.russian_roulette, default.russian_roulette);
    if let Some(clamp) = render.firefly_clamp {
        keys.number("firefly_clamp", clamp, f32::NAN);
    }
    keys.flag("geometric_veto", render.geometric_veto, default.geometric_veto);
    keys
}
