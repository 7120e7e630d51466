//! `[[instance]]` with a `file`: models as a whole, and what they bring to a scene that lacks camera or lights.

use super::Warning;
use super::document::{Data, Entry, Node, Sources, Spot, Table};
use super::include::identity;
use super::reader::Reader;
use super::shape::placed;
use super::text::Limits;
use super::view::{Item, View};
use crate::import::{Model, ModelCamera, ModelChoice, affine, framing, studio};
use crate::scene::{Camera, Instance, Light, MAX_SIDE, Meter, unit};
use crate::{Error, Place, Result};
use glam::Affine3A;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What models add to a scene.
#[derive(Default)]
pub(super) struct Models {
    /// What the user chose in models.
    choice: ModelChoice,
    /// Models that are read already, by the identity of the file and by what of it is shown.
    known: BTreeMap<(PathBuf, String), Model>,
    /// Cameras and lights of all models, in the world.
    cameras: Vec<ModelCamera>,
    lights: Vec<Light>,
    /// Instances of all models.
    instances: Vec<Instance>,
    pub warnings: Vec<Warning>,
}

impl Models {
    /// None yet, of which this will be shown.
    pub fn showing(choice: &ModelChoice) -> Self {
        Self { choice: choice.clone(), ..Self::default() }
    }
}

/// The document that a model is by itself: one instance of it.
pub(super) fn document(sources: &mut Sources, path: &Path) -> Result<Table> {
    let name = path.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
        Error::scene("the name of the model is no text in UTF-8").help("rename it").in_file(path)
    })?;
    let spot = Spot { source: sources.add_implied(path), offset: 0 };
    let node = |data| Node { spot, data };
    let table = |key: &str, data| Table { entries: vec![Entry { key: key.into(), spot, node: node(data) }] };
    let instance = Data::Table(table("file", Data::String(name.to_owned())));
    Ok(table("instance", Data::List(vec![node(instance)])))
}

impl Reader<'_> {
    /// An instance of a whole model.
    pub(super) fn model_instance(&mut self, view: &View<'_>, file: Item<'_>) -> Result<()> {
        for key in ["mesh", "material"] {
            if let Some(item) = view.get(key) {
                let help = "to give a model other materials, name its file in a [mesh.NAME]";
                return Err(item.error(format!("`{key}` has no meaning beside `file`")).help(help));
            }
        }
        let path = file.path()?;
        self.need_file(file.node.spot, &path)?;
        let mut choice = self.models.choice.clone();
        if let Some(time) = view.get("time").filter(|_| choice.time.is_none()) {
            choice.time = Some(time.f32(Limits::Finite)?);
        }
        if let Some(variant) = view.get("variant").filter(|_| choice.variant.is_none()) {
            choice.variant = Some(variant.string()?.to_owned());
        }
        let (map, at_close) = placed(view)?;
        let model = self.model(file, &path, &choice)?;
        let own = model.instances.iter().map(|instance| {
            let narrow = |map: &Affine3A| {
                let whole = map.as_daffine3() * instance.world_from_object.as_daffine3();
                affine::narrow(&whole).ok_or_else(|| {
                    let message = format!(
                        "`transform` makes `{}` of the model flat, or moves it out of all bounds",
                        instance.name
                    );
                    file.error(message).help("scale all axes alike, and less")
                })
            };
            let (world_from_object, at_close) = (narrow(&map)?, at_close.as_ref().map(narrow).transpose()?);
            Ok(Instance { world_from_object, at_close, ..instance.clone() })
        });
        let own: Vec<Instance> = own.collect::<Result<_>>()?;
        self.models.cameras.extend(model.cameras.iter().map(|camera| moved_camera(camera, &map)));
        self.models.lights.extend(model.lights.iter().map(|light| light.clone().moved(&map)));
        self.models.instances.extend(own.iter().cloned());
        self.scene.instances.extend(own);
        Ok(())
    }

    /// A model, read once.
    fn model(&mut self, file: Item<'_>, path: &Path, choice: &ModelChoice) -> Result<Model> {
        let key = (identity(path), format!("{:?} {:?}", choice.time, choice.variant));
        if let Some(known) = self.models.known.get(&key) {
            return Ok(known.clone());
        }
        let model = self.assets.model(path, choice, &mut self.scene);
        let model = model.map_err(|error| self.sources.locate(file.node.spot, error))?;
        let place = Place { file: path.to_path_buf(), line: 0, column: 0 };
        let warning = |message: &String| Warning { place: place.clone(), message: message.clone() };
        self.models.warnings.extend(model.warnings.iter().map(warning));
        self.models.known.insert(key, model.clone());
        Ok(model)
    }

    /// What a scene takes from its models: the camera, when it has none of its own or one is chosen; the lights, or else a studio,
    /// when nothing that the scene file says shines.
    pub(super) fn complete_from_models(&mut self, document: &Table, shines: bool) -> Result<()> {
        if self.models.instances.is_empty() {
            if self.models.choice == ModelChoice::default() {
                return Ok(());
            }
            let message = "--time, --camera and --variant choose in glTF models, and the scene has none";
            return Err(Error::scene(message).help("leave them out, or add an [[instance]] with `file`"));
        }
        let chosen = self.models.choice.camera.clone();
        if chosen.is_some() || document.get("camera").is_none() {
            let cameras = Model { cameras: std::mem::take(&mut self.models.cameras), ..Model::default() };
            if let Meter::Shot(_) = self.scene.film.exposure.meter {
                // Its shutter and f-number were those of the camera that is replaced
                self.scene.film.exposure.meter = Meter::Fixed;
            }
            match cameras.camera(chosen.as_deref())? {
                Some(camera) => {
                    self.scene.camera = camera.camera.clone();
                    self.fit_film(document, camera.aspect);
                }
                None => self.scene.camera = framing::camera(&self.scene, &self.models.instances),
            }
        }
        if !shines {
            self.scene.lights.append(&mut self.models.lights);
            if self.scene.lights.is_empty() {
                let studio = studio::add(&mut self.scene);
                self.scene.environment = Some(studio);
            }
        }
        Ok(())
    }

    /// Gives the picture the shape that the camera asks for, where the scene file says nothing of its size.
    fn fit_film(&mut self, document: &Table, aspect: Option<f32>) {
        let says = |key| match document.get("film").map(|entry| &entry.node.data) {
            Some(Data::Table(film)) => film.get(key).is_some(),
            _ => false,
        };
        if let Some(aspect) = aspect.filter(|_| !says("size") && !says("crop")) {
            let film = &mut self.scene.film;
            film.width = (film.height as f32 * aspect).round().clamp(1.0, MAX_SIDE as f32) as u32;
        }
    }
}

fn moved_camera(camera: &ModelCamera, map: &Affine3A) -> ModelCamera {
    let Camera { position, target, up, mirrored, .. } = camera.camera;
    let moved = Camera {
        position: map.transform_point3(position),
        target: map.transform_point3(target),
        up: unit(map.transform_vector3(up)).unwrap_or(up),
        mirrored: mirrored != (map.matrix3.determinant() < 0.0),
        ..camera.camera.clone()
    };
    ModelCamera { camera: moved, ..camera.clone() }
}
