//! A document into a scene: what is read once, and the nodes that place it.

use super::animation;
use super::camera;
use super::deform::{joint_maps, narrow};
use super::document::{Document, index_into};
use super::instancing;
use super::json::Json;
use super::light;
use super::mesh::{Pose, Source};
use super::node::Nodes;
use super::{Model, ModelChoice, variant};
use crate::Result;
use crate::import::file::shown;
use crate::scene::{Handle, Image, Instance, Material, Mesh, Scene};
use glam::{Affine3A, DAffine3};
use std::collections::{BTreeMap, BTreeSet};

/// A model on its way into a scene.
pub(super) struct Reader<'a> {
    pub document: Document<'a>,
    pub scene: &'a mut Scene,
    /// All materials of the document.
    pub materials: Vec<Json<'a>>,
    /// Those that are in the scene already, with colours of vertices and without; the default is that without a number.
    pub known_materials: BTreeMap<(Option<usize>, bool), Handle<Material>>,
    /// Pictures that are in the scene already.
    pub images: BTreeMap<usize, Handle<Image>>,
    /// The variant that is shown.
    pub variant: Option<usize>,
    warnings: BTreeSet<String>,
}

/// Smallest volume of a map against that of a box with the same edges: below it the map is flat in 32 bits.
const MIN_VOLUME: f64 = 1e-7;

impl<'a> Reader<'a> {
    /// Begins to read into a scene.
    pub fn new(mut document: Document<'a>, scene: &'a mut Scene, choice: &ModelChoice) -> Result<Self> {
        let variant = choice.variant.as_deref().map(|name| variant::find(&document, name)).transpose()?;
        let warnings = std::mem::take(&mut document.left_out).into_iter().collect();
        Ok(Self {
            materials: document.root.list("materials")?,
            document,
            scene,
            known_materials: BTreeMap::new(),
            images: BTreeMap::new(),
            variant,
            warnings,
        })
    }

    /// Notes something that is seen in another way than the file means it, once.
    pub fn warn(&mut self, at: &Json<'_>, message: &str) {
        self.note(&format!("{}: {message}", at.pointer()));
    }

    /// The same about the model as a whole.
    pub fn note(&mut self, message: &str) {
        self.warnings.insert(message.to_owned());
    }

    /// A number of a key from 0 to `most`; what is outside is moved to the nearer end, with a warning.
    pub fn limited(&mut self, object: &Json<'_>, key: &str, default: f32, most: f32) -> Result<f32> {
        let value = object.number_or(key, default)?;
        if !(0.0..=most).contains(&value) {
            self.warn(object, &format!("`{key}` is {value}, and is taken as {}", value.clamp(0.0, most)));
        }
        Ok(value.clamp(0.0, most))
    }

    /// Numbers of a key from 0 to 1, in the same way.
    pub fn clamped<const N: usize>(
        &mut self,
        object: &Json<'_>,
        key: &str,
        default: [f32; N],
    ) -> Result<[f32; N]> {
        let values = object.numbers_or(key, default)?;
        if values.iter().any(|value| !(0.0..=1.0).contains(value)) {
            self.warn(object, &format!("`{key}` is {values:?}, and is taken from 0 to 1"));
        }
        Ok(values.map(|value| value.clamp(0.0, 1.0)))
    }

    /// Reads all that the shown scene of the document places.
    pub fn read(mut self, choice: &ModelChoice) -> Result<Model> {
        let mut nodes = Nodes::read(&self.document)?;
        if let Some(time) = choice.time {
            animation::pose(&self.document, &mut nodes, time)?;
        }
        let sources = Source::all(&self.document)?;
        let world = nodes.world();
        let shown_nodes = nodes.shown(&self.document)?;
        let lights = light::all(&self.document)?;
        let cameras = self.document.root.list("cameras")?;
        let skins = self.document.root.list("skins")?;
        for node in &nodes.nodes {
            reference(&node.json, "mesh", "meshes", sources.len())?;
        }

        let mut model = Model::default();
        let mut rest: BTreeMap<usize, Vec<Handle<Mesh>>> = BTreeMap::new();
        for node in shown_nodes {
            let (node, world_from_node) = (&nodes.nodes[node], &world[node]);
            if let Some(index) = reference(&node.json, "camera", "cameras", cameras.len())? {
                model.cameras.push(camera::read(&cameras[index], index, world_from_node)?);
            }
            model.lights.extend(light::of_node(&lights, &node.json, world_from_node)?);
            let Some(mesh) = reference(&node.json, "mesh", "meshes", sources.len())? else { continue };
            let source = &sources[mesh];
            let skin = reference(&node.json, "skin", "skins", skins.len())?;
            let joints = skin.map(|skin| joint_maps(&self.document, &skins[skin], &world)).transpose()?;
            let pose = Pose {
                weights: node.weights.as_deref().unwrap_or(&source.weights),
                joints: joints.as_deref(),
            };
            let meshes = match rest.get(&mesh).filter(|_| pose.is_rest()) {
                Some(meshes) => meshes.clone(),
                None => {
                    let meshes = self.mesh(source, &pose)?;
                    if pose.is_rest() {
                        rest.insert(mesh, meshes.clone());
                    }
                    meshes
                }
            };
            // The vertices of a skin are in the world already
            let maps = match joints {
                Some(_) => vec![DAffine3::IDENTITY],
                None => instancing::maps(&self.document, &node.json, world_from_node)?,
            };
            self.place(&mut model, node, &meshes, &maps)?;
        }
        if model.instances.is_empty() {
            self.look_at_all(&sources)?;
        }
        model.warnings = self.warnings.into_iter().collect();
        model.files = self.document.files;
        Ok(model)
    }

    /// Reads what nothing shows: of a file that shows nothing, what is wrong with its parts says more than that.
    fn look_at_all(&mut self, sources: &[Source<'a>]) -> Result<()> {
        for source in sources {
            self.mesh(source, &Pose { weights: &source.weights, joints: None })?;
        }
        (0..self.materials.len()).try_for_each(|material| self.material(Some(material), false).map(drop))?;
        self.document.root.list("images")?.iter().enumerate().try_for_each(|(i, _)| self.image(i).map(drop))
    }

    fn place(
        &mut self,
        model: &mut Model,
        node: &super::node::Node<'_>,
        meshes: &[Handle<Mesh>],
        maps: &[DAffine3],
    ) -> Result<()> {
        self.document.budget.take(maps.len().saturating_mul(meshes.len()), size_of::<Instance>())?;
        let name = shown(node.name.as_bytes());
        for map in maps {
            let map = narrow(map);
            if !has_volume(&map) {
                self.warn(&node.json, "the node has no volume, and what it holds is left out");
                continue;
            }
            model.instances.extend(meshes.iter().filter_map(|&mesh| {
                let material = self.scene.meshes[mesh].parts.first()?.material?;
                Some(Instance { name: name.clone(), mesh, material, world_from_object: map, at_close: None })
            }));
        }
        Ok(())
    }
}

/// The number that a node gives for one of its parts.
fn reference(node: &Json<'_>, key: &str, list: &str, count: usize) -> Result<Option<usize>> {
    node.get(key)?.map(|reference| index_into(&reference, list, count)).transpose()
}

/// Whether a map can be inverted in 32 bits.
fn has_volume(map: &Affine3A) -> bool {
    let wide = map.as_daffine3();
    let edges = wide.x_axis.length() * wide.y_axis.length() * wide.z_axis.length();
    map.is_finite() && map.inverse().is_finite() && wide.matrix3.determinant().abs() > MIN_VOLUME * edges
}
