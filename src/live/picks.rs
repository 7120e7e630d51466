//! What is under each pixel: which object, and which material.

use crate::Result;
use crate::render::{Next, Renderer, View};
use crate::scene::{Filter, FilterKind, Projection, Rect, Sampler, Scene};

/// What the pixels of a generation see in their middles.
pub struct Picks {
    /// The generation.
    pub generation: u64,
    window: Option<Rect>,
    objects: Names,
    materials: Names,
}

/// Names, and for each pixel which of them it has.
#[derive(Default)]
struct Names {
    names: Vec<String>,
    numbers: Vec<Option<u32>>,
}

impl Names {
    fn of(&self, pixel: usize) -> Option<&str> {
        let number = (*self.numbers.get(pixel)?)?;
        self.names.get(number as usize).map(String::as_str)
    }
}

impl Picks {
    /// Renders the views of objects and materials of a scene, that `open` brings onto the device.
    ///
    /// # Errors
    ///
    /// Those of `open`, and of a device that fails.
    pub(super) fn new(
        generation: u64,
        mut scene: Scene,
        mut open: impl FnMut(Scene, View) -> Result<Renderer>,
    ) -> Result<Self> {
        middles_only(&mut scene);
        let shapes = scene.shapes.iter().map(|shape| shape.name.clone());
        let objects = shapes.chain(scene.instances.iter().map(|instance| instance.name.clone())).collect();
        let materials = scene.materials.iter().map(|(_, name, _)| name.to_owned()).collect();
        let window = Some(scene.film.window());
        let mut look = |scene: Scene, view: View, names: Vec<String>| -> Result<Names> {
            let picture = open(scene, view)?.render(0, 1, &mut |_| Next::Continue)?.resolve();
            Ok(Names { names, numbers: picture.rgb.into_iter().map(View::number).collect() })
        };
        let objects = look(scene.clone(), View::Objects, objects)?;
        let materials = look(scene, View::Materials, materials)?;
        Ok(Self { generation, window, objects, materials })
    }

    /// Those of a generation of which nothing is known.
    pub(super) fn none(generation: u64) -> Self {
        Self { generation, window: None, objects: Names::default(), materials: Names::default() }
    }

    /// The names of the object and of the material in a pixel of the whole picture; none where there is nothing.
    pub fn at(&self, [x, y]: [u32; 2]) -> [Option<&str>; 2] {
        let pixel = self.window.and_then(|window| window.index(x, y));
        [&self.objects, &self.materials].map(|names| names.of(pixel?))
    }
}

/// One ray through the middle of each pixel, and of the lens.
fn middles_only(scene: &mut Scene) {
    scene.render.sampler = Sampler::Center;
    scene.film.filter = Filter { kind: FilterKind::Box, radius: 0.5 };
    scene.film.transparent = false;
    if let Projection::Perspective(view) = &mut scene.camera.projection {
        view.lens = None;
    }
}
