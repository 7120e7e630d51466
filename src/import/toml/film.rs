//! `[film]` and `[render]`.

use super::document::Node;
use super::keys::{FILM, RENDER};
use super::reader::Reader;
use super::text::{Limits, shown};
use super::view::{Item, View};
use crate::Result;
use crate::scene::{
    Exposure, Filter, FilterKind, MAX_SAMPLES, MAX_SIDE, Meter, Rect, Render, Sampler, ToneCurve,
};

const TONE_CURVES: [(&str, ToneCurve); 4] = [
    ("srgb", ToneCurve::Srgb),
    ("linear", ToneCurve::Linear),
    ("aces", ToneCurve::Aces),
    ("agx", ToneCurve::Agx),
];

/// Stops, or `"auto"`.
fn exposure(item: Item<'_>) -> Result<Exposure> {
    if item.is_number() {
        let stops = item.f32(Limits::From(-Exposure::MOST_STOPS, Exposure::MOST_STOPS))?;
        return Ok(Exposure { stops, ..Exposure::default() });
    }
    match item.string() {
        Ok("auto") => Ok(Exposure { meter: Meter::Auto, stops: 0.0 }),
        Ok(other) => Err(item.refuse(format!("\"{}\"", shown(other)), "a number of stops or \"auto\"")),
        Err(_) => Err(item.mismatch("a number of stops or \"auto\"")),
    }
}

impl Reader<'_> {
    pub fn film(&mut self, node: &Node) -> Result<()> {
        let view = View::new(self.sources, node, "[film]".into(), FILM)?;
        let mut film = self.scene.film.clone();
        if let Some(size) = view.get("size") {
            [film.width, film.height] = size.whole_numbers(1, MAX_SIDE)?;
        }
        if let Some(item) = view.get("crop") {
            let [x0, y0, x1, y1] = item.whole_numbers(0, MAX_SIDE)?;
            let shown = format!("[{x0}, {y0}, {x1}, {y1}]");
            if x0 >= x1 || y0 >= y1 {
                return Err(item.refuse(shown, "[x0, y0, x1, y1] with x0 below x1 and y0 below y1"));
            }
            if x1 > film.width || y1 > film.height {
                return Err(item.refuse(shown, format!("inside the {} × {} pixels", film.width, film.height)));
            }
            film.crop = Some(Rect { x0, y0, x1, y1 });
        }
        film.filter = filter(&view, film.filter)?;
        film.exposure = view.get("exposure").map_or(Ok(film.exposure), exposure)?;
        film.tone_curve = view.choice_or("tone_curve", film.tone_curve, &TONE_CURVES)?;
        if let Some(item) = view.get("png_bits") {
            film.png_bits = item.u32(0, u32::MAX)?;
            if film.png_bits != 8 && film.png_bits != 16 {
                return Err(item.refuse(film.png_bits, "8 or 16"));
            }
        }
        film.transparent = view.bool_or("transparent", film.transparent)?;
        self.scene.film = film;
        Ok(())
    }

    pub fn render(&mut self, node: &Node) -> Result<()> {
        let view = View::new(self.sources, node, "[render]".into(), RENDER)?;
        let default = self.scene.render.clone();
        let samplers = [
            ("sobol", Sampler::Sobol),
            ("stratified", Sampler::Stratified),
            ("random", Sampler::Random),
            ("regular", Sampler::Regular),
            ("center", Sampler::Center),
        ];
        self.scene.render = Render {
            spp: view.u32_or("spp", default.spp, 1, MAX_SAMPLES)?,
            seed: view.u32_or("seed", default.seed, 0, u32::MAX)?,
            sampler: view.choice_or("sampler", default.sampler, &samplers)?,
            strata: match view.get("strata") {
                Some(item) => item.whole_numbers(1, Render::MOST_STRATA)?,
                None => default.strata,
            },
            max_depth: view.u32_or("max_depth", default.max_depth, 0, Render::MOST_DEPTH)?,
            diffuse_bounces: match view.get("diffuse_bounces") {
                Some(item) => Some(item.u32(0, Render::MOST_DEPTH)?),
                None => default.diffuse_bounces,
            },
            russian_roulette: view.bool_or("russian_roulette", default.russian_roulette)?,
            firefly_clamp: match view.get("firefly_clamp") {
                Some(item) => Some(item.f32(Limits::Above(0.0))?),
                None => default.firefly_clamp,
            },
            geometric_veto: view.bool_or("geometric_veto", default.geometric_veto)?,
        };
        Ok(())
    }
}

/// The pixel filter.
fn filter(view: &View<'_>, default: Filter) -> Result<Filter> {
    let kinds = [
        ("box", FilterKind::Box),
        ("tent", FilterKind::Tent),
        ("gaussian", FilterKind::Gaussian),
        ("blackman_harris", FilterKind::BlackmanHarris),
        ("mitchell", FilterKind::Mitchell { b: 1.0 / 3.0, c: 1.0 / 3.0 }),
        ("sinc", FilterKind::Sinc { tau: 3.0 }),
    ];
    let mut kind = view.choice_or("filter", default.kind, &kinds)?;
    let mitchell = matches!(kind, FilterKind::Mitchell { .. });
    let sinc = matches!(kind, FilterKind::Sinc { .. });
    for (key, word, fits) in
        [("filter_b", "mitchell", mitchell), ("filter_c", "mitchell", mitchell), ("filter_tau", "sinc", sinc)]
    {
        if let Some(item) = view.get(key).filter(|_| !fits) {
            let error = item.error(format!("{} needs `filter = \"{word}\"`", item.name()));
            return Err(error.help("choose that filter, or leave the key out"));
        }
    }
    let radius = match &mut kind {
        FilterKind::Box => 0.5,
        FilterKind::Tent => 1.0,
        FilterKind::Gaussian | FilterKind::BlackmanHarris => 1.5,
        FilterKind::Mitchell { b, c } => {
            *b = view.f32_or("filter_b", *b, Limits::From(0.0, 1.0))?;
            *c = view.f32_or("filter_c", *c, Limits::From(0.0, 1.0))?;
            2.0
        }
        FilterKind::Sinc { tau } => {
            *tau = view.f32_or("filter_tau", *tau, Limits::Above(0.0))?;
            4.0
        }
    };
    // That of the scene, unless another kind is chosen
    let radius = if view.get("filter").is_some() { radius } else { default.radius };
    let radius = view.f32_or("filter_radius", radius, Limits::AboveUpTo(0.0, Filter::MOST_RADIUS))?;
    Ok(Filter { kind, radius })
}
