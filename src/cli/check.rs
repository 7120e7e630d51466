//! `dapple check`: what is in a scene, without a device.

use super::args::CheckArgs;
use super::console::Console;
use super::devices::bytes_text;
use super::job::read;
use dapple::Result;
use dapple::import::{ModelContents, Warning, is_gltf, model_contents};
use dapple::layout::Backend;
use dapple::prepare::{self, Prepared, Stage};
use dapple::render;
use dapple::scene::{Scene, Texture};
use dapple::shader::{CacheOptions, Compiler, Sources};
use serde::Serialize;
use std::fmt::Write;

/// The counts of a scene.
#[derive(Debug, Serialize)]
struct Contents {
    /// Columns and rows of the whole picture.
    size: [u32; 2],
    /// The pixels that are rendered: x0, y0, x1, y1.
    window: [u32; 4],
    spp: u32,
    seed: u32,
    meshes: usize,
    /// On the device: a mesh counts once however often it is placed, a quad is two.
    triangles: usize,
    instances: usize,
    shapes: usize,
    textures: usize,
    images: usize,
    materials: usize,
    /// Rows of the table of lights: those of the scene, shining shapes and triangles.
    lights: usize,
    environment: bool,
    bvh_nodes: usize,
    stack_entries: u32,
    /// Records of the scene on the device; film and waves of paths come on top, as large as the device likes them.
    scene_bytes: u64,
    warnings: Vec<String>,
    /// What a glTF model has beside that, when the scene is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    model: Option<OfModel>,
}

/// What can be chosen in a glTF model, and what else is in it.
#[derive(Debug, Serialize)]
struct OfModel {
    generator: Option<String>,
    nodes: usize,
    skins: usize,
    punctual_lights: usize,
    cameras: Vec<String>,
    variants: Vec<String>,
    animations: Vec<Animation>,
    extensions: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Animation {
    name: String,
    seconds: f32,
}

impl From<ModelContents> for OfModel {
    fn from(model: ModelContents) -> Self {
        let animations = model.animations.into_iter().map(|(name, seconds)| Animation { name, seconds });
        Self {
            generator: model.generator,
            nodes: model.nodes,
            skins: model.skins,
            punctual_lights: model.lights,
            cameras: model.cameras,
            variants: model.variants,
            animations: animations.collect(),
            extensions: model.extensions,
        }
    }
}

impl OfModel {
    fn rows(&self) -> Vec<(&'static str, String)> {
        // Names come from a file: they must not control the terminal
        let list = |names: &[String]| match names.join(", ").escape_debug().to_string() {
            none if none.is_empty() => "none".to_owned(),
            names => names,
        };
        let animation = |one: &Animation| format!("{} ({:.2} s)", one.name, one.seconds);
        let animations: Vec<String> = self.animations.iter().map(animation).collect();
        vec![
            ("generator", list(self.generator.as_slice())),
            ("nodes", self.nodes.to_string()),
            ("skins", self.skins.to_string()),
            ("model lights", self.punctual_lights.to_string()),
            ("cameras", list(&self.cameras)),
            ("variants", list(&self.variants)),
            ("animations", list(&animations)),
            ("extensions", list(&self.extensions)),
        ]
    }
}

/// Reads, prepares, prints.
pub fn run(args: &CheckArgs, console: &mut Console) -> Result<()> {
    let (scene, warnings) = read(&args.scene, &args.read)?;
    if !args.json {
        warnings.iter().for_each(|warning| console.note(&format!("warning: {warning}")));
    }
    let prepared = prepare::prepare(&scene)?;
    compile_own_textures(&scene, &prepared)?;
    let mut contents = Contents::of(&scene, &prepared, &warnings);
    if is_gltf(&args.scene) {
        contents.model = Some(model_contents(&args.scene)?.into());
    }
    if args.json {
        console.event(&contents);
    } else {
        console.result(&contents.words());
    }
    Ok(())
}

/// Compiles the textures that are GLSL of the user's own, whose errors would else be found by the first render.
fn compile_own_textures(scene: &Scene, prepared: &Prepared) -> Result<()> {
    if !scene.textures.iter().any(|(_, _, texture)| matches!(texture, Texture::Glsl(_))) {
        return Ok(());
    }
    let mut sources = Sources::embedded();
    render::add_generated(&mut sources, &prepared.texture_glsl)?;
    let key = render::key(scene, prepared, Stage::Evaluate, None, Backend::Storage);
    Compiler::new(sources, CacheOptions::from_environment()).kernel(&key)?;
    Ok(())
}

impl Contents {
    fn of(scene: &Scene, prepared: &Prepared, warnings: &[Warning]) -> Self {
        let window = scene.film.window();
        Self {
            size: [scene.film.width, scene.film.height],
            window: [window.x0, window.y0, window.x1, window.y1],
            spp: scene.render.spp,
            seed: scene.render.seed,
            meshes: scene.meshes.len(),
            triangles: prepared.triangle_count,
            instances: scene.instances.len(),
            shapes: scene.shapes.len(),
            textures: scene.textures.len(),
            images: scene.images.len(),
            materials: scene.materials.len(),
            lights: prepared.lights.len(),
            environment: scene.environment.is_some(),
            bvh_nodes: prepared.node_count,
            stack_entries: prepared.stack_entries,
            scene_bytes: prepared.bytes(),
            warnings: warnings.iter().map(Warning::to_string).collect(),
            model: None,
        }
    }

    fn words(&self) -> String {
        let [x0, y0, x1, y1] = self.window;
        let rows = [
            ("film", format!("{} x {} pixels, window {x0},{y0},{x1},{y1}", self.size[0], self.size[1])),
            ("samples", format!("{} a pixel, seed {}", self.spp, self.seed)),
            ("meshes", self.meshes.to_string()),
            ("triangles", self.triangles.to_string()),
            ("instances", self.instances.to_string()),
            ("shapes", self.shapes.to_string()),
            ("textures", self.textures.to_string()),
            ("images", self.images.to_string()),
            ("materials", self.materials.to_string()),
            ("lights", self.lights.to_string()),
            ("environment", if self.environment { "yes" } else { "no" }.to_owned()),
            ("BVH nodes", self.bvh_nodes.to_string()),
            ("stack entries", self.stack_entries.to_string()),
            ("scene records", bytes_text(self.scene_bytes)),
            ("warnings", self.warnings.len().to_string()),
        ];
        let model = self.model.as_ref().map_or(Vec::new(), OfModel::rows);
        let mut out = String::new();
        for (name, value) in rows.into_iter().chain(model) {
            _ = writeln!(out, "{name:<14} {value}");
        }
        out.trim_end().to_owned()
    }
}
