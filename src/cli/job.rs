//! The checked job: the scene is read and changed, the target is known to be writable.

use super::args::{ReadArgs, RenderArgs, View};
use super::parse::{Pixel, Size};
use dapple::film;
use dapple::gpu::{DeviceChoice, validation_from_environment};
use dapple::import::{Warning, read_scene_showing};
use dapple::scene::{Exposure, Film, MAX_SAMPLES, Rect, Scene, ToneCurve};
use dapple::shader::{CacheOptions, Compiler, Sources};
use dapple::{Error, Result};
use std::path::{Path, PathBuf};

/// All that a render needs.
pub struct Job {
    /// Used up by the renderer.
    pub scene: Scene,
    /// Size and look of the picture.
    pub film: Film,
    /// Samples a pixel.
    pub spp: u32,
    pub seed: u32,
    pub warnings: Vec<Warning>,
    /// Where the picture goes; none = only the values of a pixel are wanted.
    pub target: Option<PathBuf>,
    /// The one pixel whose values are printed.
    pub pixel: Option<Pixel>,
    /// What is shown in place of the picture.
    pub view: Option<View>,
    pub first_sample: u32,
    pub device: DeviceChoice,
    pub compiler: Compiler,
}

impl Job {
    /// Looks at the world: the target first, because that is quick, then the scene and all that it names.
    pub fn new(args: &RenderArgs) -> Result<Self> {
        let target = target(args)?;
        let sources = match &args.shaders {
            Some(folder) => Sources::folder(folder)?,
            None => Sources::embedded(),
        };
        let (mut scene, warnings) = read(&args.scene, &args.read)?;
        set_window(&mut scene.film, args.size, args.crop, args.pixel)?;
        if args.view.is_some() {
            show_as_it_is(&mut scene.film);
        }
        scene.render.spp = args.spp.unwrap_or(scene.render.spp);
        scene.render.seed = args.seed.unwrap_or(scene.render.seed);
        check_samples(args.first_sample, scene.render.spp)?;
        Ok(Self {
            film: scene.film.clone(),
            spp: scene.render.spp,
            seed: scene.render.seed,
            scene,
            warnings,
            target,
            pixel: args.pixel,
            view: args.view,
            first_sample: args.first_sample,
            device: DeviceChoice {
                wanted: args.device.clone(),
                require_gpu: args.require_gpu,
                validation: validation_from_environment(),
            },
            compiler: Compiler::new(sources, CacheOptions::from_environment()),
        })
    }

    /// The target, as text.
    pub fn file(&self) -> Option<String> {
        self.target.as_ref().map(|file| file.to_string_lossy().into_owned())
    }
}

/// A scene as the arguments say, and the warnings about it.
pub fn read(scene: &Path, args: &ReadArgs) -> Result<(Scene, Vec<Warning>)> {
    let (scene, warnings) = read_scene_showing(scene, &args.set, &args.model.choice())?;
    strictly(args.strict, &warnings)?;
    Ok((scene, warnings))
}

/// With `--strict` a warning is an error.
pub fn strictly(strict: bool, warnings: &[Warning]) -> Result<()> {
    match warnings.first().filter(|_| strict) {
        Some(Warning { place, message }) => Err(Error::scene(message)
            .help("leave out --strict to go on")
            .at(&place.file, place.line, place.column)),
        None => Ok(()),
    }
}

/// The file that the picture goes to, checked.
fn target(args: &RenderArgs) -> Result<Option<PathBuf>> {
    let target = match &args.output {
        Some(file) => file.clone(),
        None if args.pixel.is_some() => return Ok(None),
        None => default_target(&args.scene, args.view)?,
    };
    film::check_target(&target)?;
    Ok(Some(target))
}

/// Name of the scene, and of the view, with `.png`, in the current folder.
fn default_target(scene: &Path, view: Option<View>) -> Result<PathBuf> {
    let stem = scene.file_stem().ok_or_else(|| {
        Error::scene("this names no scene file").in_file(scene).help("give the path of a scene file")
    })?;
    let mut name = stem.to_owned();
    if let Some(view) = view {
        name.push(format!(".{}", view.name()));
    }
    name.push(".png");
    Ok(PathBuf::from(name))
}

/// The colours of a view are no light: no exposure and no look of a film changes them.
fn show_as_it_is(film: &mut Film) {
    (film.exposure, film.tone_curve, film.transparent) = (Exposure::default(), ToneCurve::Srgb, false);
}

/// Changes size and window, and sees to it that the window is inside the picture.
pub fn set_window(
    film: &mut Film,
    size: Option<Size>,
    crop: Option<Rect>,
    pixel: Option<Pixel>,
) -> Result<()> {
    if let Some(Size { width, height }) = size {
        (film.width, film.height) = (width, height);
    }
    let outside = |x1: u32, y1: u32| x1 > film.width || y1 > film.height;
    let refuse = |what: String| {
        Error::scene(format!("{what} is not inside the picture of {} x {} pixels", film.width, film.height))
    };
    let shown = |r: Rect| format!("{},{},{},{}", r.x0, r.y0, r.x1, r.y1);
    if let Some(Pixel { x, y }) = pixel {
        if x >= film.width || y >= film.height {
            return Err(refuse(format!("--pixel {x},{y}")).help("the top left pixel is 0,0"));
        }
        film.crop = Some(Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 });
    } else if let Some(rect) = crop {
        if outside(rect.x1, rect.y1) {
            return Err(refuse(format!("--crop {}", shown(rect)))
                .help("x1 and y1 are the first column and row that are left out"));
        }
        film.crop = Some(rect);
    } else if let Some(rect) = film.crop
        && outside(rect.x1, rect.y1)
    {
        return Err(refuse(format!("the crop {} of the scene", shown(rect))).help("give another with --crop"));
    }
    Ok(())
}

fn check_samples(first_sample: u32, spp: u32) -> Result<()> {
    if spp > MAX_SAMPLES {
        return Err(Error::scene(format!("{spp} samples a pixel, the film holds at most {MAX_SAMPLES}"))
            .help("give fewer with --spp"));
    }
    if first_sample.checked_add(spp).is_none() {
        return Err(Error::scene(format!("sample {first_sample} + {spp} has no 32-bit number"))
            .help("give a smaller --first-sample"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CROP: Rect = Rect { x0: 1, y0: 2, x1: 3, y1: 4 };

    fn film(crop: Option<Rect>) -> Film {
        Film { width: 8, height: 8, crop, ..Film::default() }
    }

    #[test]
    fn the_window_is_checked_against_the_new_size() {
        let mut f = film(None);
        set_window(&mut f, Some(Size { width: 3, height: 4 }), Some(CROP), None).unwrap();
        assert_eq!((f.width, f.height, f.crop), (3, 4, Some(CROP)));
        let small = Some(Size { width: 2, height: 4 });
        set_window(&mut film(None), small, Some(CROP), None).unwrap_err();
        set_window(&mut film(Some(CROP)), small, None, None).unwrap_err();
        set_window(&mut film(None), None, None, Some(Pixel { x: 8, y: 0 })).unwrap_err();
        // A pixel replaces the crop of the scene.
        let mut f = film(Some(CROP));
        set_window(&mut f, small, None, Some(Pixel { x: 0, y: 0 })).unwrap();
        assert_eq!(f.crop, Some(Rect { x0: 0, y0: 0, x1: 1, y1: 1 }));
    }

    #[test]
    fn the_picture_is_named_after_the_scene() {
        let of = |view| default_target(Path::new("a/b.c.toml"), view).unwrap();
        assert_eq!(of(None), Path::new("b.c.png"));
        assert_eq!(of(Some(View::BvhCost)), Path::new("b.c.bvh-cost.png"));
        default_target(Path::new(".."), None).unwrap_err();
    }

    #[test]
    fn a_warning_is_an_error_only_where_that_is_asked_for() {
        let place = dapple::Place { file: "a.pbrt".into(), line: 3, column: 1 };
        let warnings = [Warning { place, message: "not supported: x".into() }];
        strictly(false, &warnings).unwrap();
        strictly(true, &[]).unwrap();
        let error = strictly(true, &warnings).unwrap_err().to_string();
        assert_eq!(error, "a.pbrt:3:1: not supported: x; leave out --strict to go on");
    }

    #[test]
    fn sample_numbers_fit() {
        check_samples(5, MAX_SAMPLES).unwrap();
        check_samples(0, MAX_SAMPLES + 1).unwrap_err();
        check_samples(u32::MAX, 1).unwrap_err();
    }
}
