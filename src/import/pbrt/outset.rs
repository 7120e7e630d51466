//! What is before `WorldBegin`: options, film, filter, sampler, integrator and camera. They are read at `WorldBegin`, as they
//! depend on one another and may come in any order.

use super::lexer::{Lexer, TokenKind};
use super::parameter::number;
use super::parameters::Parameters;
use super::place::Spot;
use super::reader::Reader;
use super::state::{Maps, State};
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::text::{Limits, shown, suggest};
use crate::scene::{MAX_SAMPLES, Render, Sampler};

/// A directive and its parameters.
#[derive(Debug)]
pub(super) struct Setting {
    pub kind: String,
    pub from: Parameters,
}

/// The directives before `WorldBegin`, of which the last counts.
#[derive(Debug, Default)]
pub(super) struct Outset {
    pub film: Option<Setting>,
    pub filter: Option<Setting>,
    pub camera: Option<Setting>,
    /// From the world to the camera.
    pub camera_maps: Maps,
    sampler: Option<Setting>,
    integrator: Option<Setting>,
}

impl Reader<'_> {
    /// A directive that sets something.
    pub(super) fn set_out(&mut self, lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<()> {
        let (kind, from) = self.of_kind(lexer, word, spot, None)?;
        let maps = self.state.maps;
        let Some(outset) = &mut self.outset else { return Ok(()) };
        let place = match word {
            "Film" => &mut outset.film,
            "PixelFilter" => &mut outset.filter,
            "Sampler" => &mut outset.sampler,
            "Integrator" => &mut outset.integrator,
            "Camera" => {
                outset.camera_maps = maps;
                self.systems.insert("camera".into(), maps.map(|map| map.inverse()));
                &mut outset.camera
            }
            // How rays find surfaces is no matter of the scene
            _ => return Ok(()),
        };
        *place = Some(Setting { kind, from });
        Ok(())
    }

    /// `Option "name" value`.
    pub(super) fn option(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        const KNOWN: [&str; 14] = [
            "disablepixeljitter",
            "disabletexturefiltering",
            "disablewavelengthjitter",
            "displacementedgescale",
            "displayserver",
            "forcediffuse",
            "imagefile",
            "mseimage",
            "msereferenceimage",
            "pixelstats",
            "rendercoordsys",
            "seed",
            "stats",
            "wavefront",
        ];
        let name = self.name(lexer, "Option", spot)?;
        let value = lexer.next()?.filter(|token| matches!(token.kind, TokenKind::Word | TokenKind::Quoted));
        let Some(value) = value else {
            return Err(spot.error(format!("Option \"{}\" has no value", shown(&name))).help("add it"));
        };
        // Options may also be written as parameters are, and with - and _
        let plain = name.split_ascii_whitespace().last().unwrap_or("").to_ascii_lowercase();
        let plain: String = plain.chars().filter(|char| !matches!(char, '-' | '_')).collect();
        let wrong = |rule: &str| {
            let message = format!("Option \"{}\" is {}, must be {rule}", shown(&name), value.shown());
            Err(lexer.spot(&value).error(message).help("change it"))
        };
        match plain.as_str() {
            "disabletexturefiltering" | "disablepixeljitter" => {
                let on = match value.text {
                    "true" => true,
                    "false" => false,
                    _ => return wrong("true or false"),
                };
                if plain == "disabletexturefiltering" {
                    self.filtered = !on;
                } else if on {
                    self.unsupported(Unsupported::PixelJitter, spot);
                }
            }
            "seed" => match value.text.parse::<i32>() {
                // Seeds below 0 are the upper half
                Ok(seed) => self.scene.render.seed = seed as u32,
                Err(_) => return wrong("a whole number"),
            },
            "forcediffuse" if value.text == "true" => self.unsupported(Unsupported::ForceDiffuse, spot),
            "displacementedgescale" => match number(value.text).filter(|scale| *scale > 0.0) {
                Some(scale) => self.edge_scale = scale as f32,
                None => return wrong("a number above 0"),
            },
            known if KNOWN.contains(&known) => {}
            _ => {
                let message = format!("there is no option \"{}\"", shown(&name));
                return Err(spot.error(message).help(suggest(&plain, KNOWN.into_iter(), "options")));
            }
        }
        Ok(())
    }

    /// `WorldBegin`: reads all that was set, and begins the world.
    pub(super) fn world_begin(&mut self, spot: &Spot) -> Result<()> {
        let Some(outset) = self.outset.take() else {
            return Err(spot.error("WorldBegin is there twice").help("keep one of them"));
        };
        if let Some(open) = self.saved.last() {
            let name = open.block.name();
            return Err(spot
                .error(format!("WorldBegin is inside {name}Begin"))
                .help(format!("add {name}End")));
        }
        self.film(outset.film.as_ref())?;
        self.filter(outset.filter.as_ref())?;
        self.sampler(outset.sampler.as_ref())?;
        self.integrator(outset.integrator.as_ref())?;
        self.camera(outset.camera.as_ref(), &outset.camera_maps, outset.film.as_ref())?;
        // What was set for all of the scene stays, but not where the camera is
        let State { color_space, attributes, .. } = std::mem::take(&mut self.state);
        self.state = State { color_space, attributes, ..State::default() };
        Ok(())
    }

    fn sampler(&mut self, setting: Option<&Setting>) -> Result<()> {
        /// Samples of pbrt when the scene does not say.
        const SAMPLES: u32 = 16;
        let render = &mut self.scene.render;
        render.spp = SAMPLES;
        let Some(Setting { kind, from }) = setting else { return Ok(()) };
        match kind.as_str() {
            "stratified" => {
                let strata = [
                    from.integer_or("xsamples", 4, 1, Render::MOST_STRATA)?,
                    from.integer_or("ysamples", 4, 1, Render::MOST_STRATA)?,
                ];
                let jitter = from.bool_or("jitter", true)?;
                render.sampler = if jitter { Sampler::Stratified } else { Sampler::Regular };
                render.strata = strata;
                render.spp = strata[0].saturating_mul(strata[1]);
                if render.spp > MAX_SAMPLES {
                    let message = format!(
                        "{} has {} samples, the film holds at most {MAX_SAMPLES}",
                        from.what, render.spp
                    );
                    return Err(from.error(message).help("write smaller xsamples and ysamples"));
                }
            }
            "independent" | "halton" | "sobol" | "paddedsobol" | "zsobol" | "pmj02bn" => {
                render.sampler = if kind == "independent" { Sampler::Random } else { Sampler::Sobol };
                render.spp = from.integer_or("pixelsamples", SAMPLES, 1, MAX_SAMPLES)?;
                from.ignore(&["randomization"]);
            }
            _ => {
                let known =
                    ["independent", "stratified", "halton", "sobol", "paddedsobol", "zsobol", "pmj02bn"];
                return Err(self.unknown("Sampler", kind, from, &known));
            }
        }
        if let Some((parameter, list)) = from.integers("seed") {
            let &[seed] = list else { return Err(from.count(parameter, 1)) };
            render.seed = seed as u32;
        }
        from.finish()
    }

    fn integrator(&mut self, setting: Option<&Setting>) -> Result<()> {
        /// Events of pbrt when the scene does not say.
        const DEPTH: u32 = 5;
        self.scene.render.max_depth = DEPTH;
        let Some(Setting { kind, from }) = setting else { return Ok(()) };
        match kind.as_str() {
            "path" | "volpath" | "simplepath" | "simplevolpath" | "lightpath" | "bdpt" | "mlt" | "sppm"
            | "randomwalk" => {
                self.scene.render.max_depth = from.integer_or("maxdepth", DEPTH, 0, Render::MOST_DEPTH)?;
            }
            "ambientocclusion" | "function" => {
                self.unsupported(Unsupported::Integrator, &from.spot);
                from.ignore(&[
                    "cossample",
                    "maxdistance",
                    "function",
                    "filename",
                    "skipbad",
                    "gridmin",
                    "gridmax",
                ]);
            }
            _ => {
                let known = [
                    "path",
                    "volpath",
                    "simplepath",
                    "simplevolpath",
                    "lightpath",
                    "bdpt",
                    "mlt",
                    "sppm",
                    "randomwalk",
                    "ambientocclusion",
                    "function",
                ];
                return Err(self.unknown("Integrator", kind, from, &known));
            }
        }
        if from.bool_or("regularize", false)? {
            self.unsupported(Unsupported::Regularize, &from.spot);
        }
        // How samples are drawn changes the noise of a picture and not what it converges to
        from.ignore(&[
            "lightsampler",
            "samplebsdf",
            "samplelights",
            "visualizestrategies",
            "visualizeweights",
            "bootstrapsamples",
            "chains",
            "mutationsperpixel",
            "largestepprobability",
            "sigma",
            "photonsperiteration",
            "radius",
            "seed",
        ]);
        from.finish()
    }

    /// A number of a setting.
    pub(super) fn setting_float(setting: Option<&Setting>, name: &'static str, default: f32) -> Result<f32> {
        match setting {
            Some(setting) => setting.from.float_or(name, default, Limits::Above(0.0)),
            None => Ok(default),
        }
    }
}
