//! A scene in the making: the files one after the other, directive by directive.

use super::lexer::{Lexer, TokenKind};
use super::object::{Object, Objects};
use super::outset::Outset;
use super::parameter::{Parameter, parameters};
use super::parameters::Parameters;
use super::place::Spot;
use super::state::{Block, Maps, Saved, State, Target};
use super::unsupported::{Missing, Unsupported};
use super::{deprecated, dress::Wardrobe, texture::Textures};
use crate::import::text::shown;
use crate::import::{Assets, Warning};
use crate::scene::{Handle, Image, Mesh, Scene};
use crate::{Error, Result};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Longest chain of files that include one another.
const MOST_DEPTH: usize = 32;
/// Most files that are included, counting each time.
const MOST_FILES: usize = 10_000;
/// Most bytes of text in all.
const MOST_BYTES: usize = 1 << 30;

/// A scene in the making.
pub(super) struct Reader<'a> {
    pub assets: &'a mut dyn Assets,
    pub scene: Scene,
    pub state: State,
    /// States that `AttributeEnd` and `ObjectEnd` bring back.
    pub saved: Vec<Saved>,
    /// Named coordinate systems.
    pub systems: BTreeMap<String, Maps>,
    /// `TransformTimes`.
    pub interval: Option<([f64; 2], Spot)>,
    /// What is before `WorldBegin`; none once that has been read.
    pub outset: Option<Outset>,
    pub textures: Textures,
    pub wardrobe: Wardrobe,
    pub objects: Objects,
    /// Pictures that are loaded already, with the bits of their gamma, and whether they have holes.
    pub images: HashMap<(PathBuf, Option<u32>), (Handle<Image>, bool)>,
    /// Meshes that are loaded already, and whether they are turned inside out.
    pub meshes: HashMap<(PathBuf, bool), Handle<Mesh>>,
    pub missing: Missing,
    /// Triangles that cost little text.
    pub made: usize,
    /// When the shutter opens and closes.
    pub shutter: [f64; 2],
    /// Option "displacementedgescale".
    pub edge_scale: f32,
    /// Whether image textures and patterns are filtered.
    pub filtered: bool,
    /// Files that are being read, and how much has been.
    chain: Vec<PathBuf>,
    files: usize,
    bytes: usize,
}

impl<'a> Reader<'a> {
    pub fn new(assets: &'a mut dyn Assets) -> Self {
        Self {
            assets,
            scene: Scene::default(),
            state: State::default(),
            saved: Vec::new(),
            systems: BTreeMap::from([("world".to_owned(), State::default().maps)]),
            interval: None,
            outset: Some(Outset::default()),
            textures: Textures::default(),
            wardrobe: Wardrobe::default(),
            objects: Objects::default(),
            images: HashMap::new(),
            meshes: HashMap::new(),
            missing: Missing::default(),
            made: 0,
            shutter: [0.0, 1.0],
            edge_scale: 1.0,
            filtered: true,
            chain: Vec::new(),
            files: 0,
            bytes: 0,
        }
    }

    /// Reads the first file and gives the scene.
    pub fn read(mut self, path: &Path) -> Result<(Scene, Vec<Warning>)> {
        self.file(path, None)?;
        if let Some(open) = self.saved.last() {
            let name = open.block.name();
            return Err(open
                .spot
                .error(format!("{name}Begin has no {name}End"))
                .help(format!("add {name}End")));
        }
        if self.outset.is_some() {
            return Err(Error::scene("the scene has no WorldBegin")
                .help("write it after the camera and the film, before what is in the scene")
                .in_file(path));
        }
        self.check_textures()?;
        self.dress_all()?;
        Ok((self.scene, self.missing.warnings()))
    }

    /// Reads a file, which may have been named by a directive.
    fn file(&mut self, path: &Path, named_at: Option<&Spot>) -> Result<()> {
        let locate = |error: Error| match named_at {
            Some(spot) => spot.locate(error),
            None => error.in_file(path),
        };
        let refuse = |message: String| Err(locate(Error::scene(message).help("check what is included")));
        if self.chain.iter().any(|open| open == path) {
            return refuse(format!("the file {} includes itself", shown(&path.display().to_string())));
        }
        if self.chain.len() >= MOST_DEPTH {
            return refuse(format!("files include one another more than {MOST_DEPTH} deep"));
        }
        if self.files >= MOST_FILES {
            return refuse(format!("more than {MOST_FILES} files are included"));
        }
        if path.extension().is_some_and(|extension| extension == "gz") {
            return Err(locate(
                Error::scene("compressed scenes are not read").help("run gunzip on it first"),
            ));
        }
        if !self.assets.exists(path) {
            return refuse(format!("there is no file {}", shown(&path.display().to_string())));
        }
        let text = self.assets.text(path).map_err(locate)?;
        self.files += 1;
        self.bytes += text.len();
        if self.bytes > MOST_BYTES {
            return refuse("the files of the scene have more than 1 GiB of text".into());
        }
        self.chain.push(path.to_path_buf());
        let mut lexer = Lexer::new(Rc::from(path), &text);
        while let Some(token) = lexer.next()? {
            let spot = lexer.spot(&token);
            if token.kind != TokenKind::Word {
                let message = format!("{} is where a directive should be", token.shown());
                return Err(spot.error(message).help("write a directive such as Shape before it"));
            }
            self.directive(&mut lexer, token.text, &spot)?;
        }
        self.chain.pop();
        Ok(())
    }

    /// `Include` and `Import`. What an imported file changes in the state stays there.
    pub fn include(&mut self, lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<()> {
        let name = self.name(lexer, word, spot)?;
        let path = spot.resolve(&name);
        let import = word == "Import";
        if import && self.outset.is_some() {
            return Err(spot.error("Import is before WorldBegin").help("write Include"));
        }
        let state = import.then(|| self.state.clone());
        let blocks = self.saved.len();
        self.file(&path, Some(spot))?;
        if let Some(state) = state {
            if let Some(open) = self.saved.get(blocks) {
                let name = open.block.name();
                return Err(open
                    .spot
                    .error(format!("{name}Begin has no {name}End in its file"))
                    .help("add it"));
            }
            self.state = state;
        }
        Ok(())
    }

    /// A string after a directive.
    pub fn name(&mut self, lexer: &mut Lexer<'_>, word: &str, spot: &Spot) -> Result<String> {
        let token = lexer.next()?;
        match token.filter(|token| token.kind == TokenKind::Quoted) {
            Some(token) => Ok(token.text.to_owned()),
            None => {
                let at = token.map_or_else(|| spot.clone(), |token| lexer.spot(&token));
                Err(at.error(format!("{word} wants a name in quotes")).help(format!("write {word} \"NAME\"")))
            }
        }
    }

    /// The parameters of a directive, with those that it inherits.
    pub fn parameters(
        &self,
        lexer: &mut Lexer<'_>,
        what: String,
        spot: &Spot,
        target: Option<Target>,
    ) -> Result<Parameters> {
        let none = Vec::new();
        let inherited = target.map_or(&none, |target| &self.state.attributes[target as usize]);
        Ok(Parameters::new(what, spot.clone(), parameters(lexer)?, inherited))
    }

    /// A directive that names a kind: the kind and the parameters.
    pub fn of_kind(
        &mut self,
        lexer: &mut Lexer<'_>,
        word: &str,
        spot: &Spot,
        target: Option<Target>,
    ) -> Result<(String, Parameters)> {
        let kind = self.name(lexer, word, spot)?;
        let what = format!("{word} \"{}\"", shown(&kind));
        Ok((kind, self.parameters(lexer, what, spot, target)?))
    }

    /// The error for a kind that is not known.
    pub fn unknown(&self, word: &str, kind: &str, from: &Parameters, known: &[&str]) -> Error {
        let error = from.error(format!("there is no {}", from.what));
        match deprecated::kind_instead(word, kind) {
            Some(help) => error.help(help),
            None => error.help(crate::import::text::suggest(kind, known.iter().copied(), "kinds")),
        }
    }

    /// Notes that something is there which dapple cannot show.
    pub fn unsupported(&mut self, what: Unsupported, spot: &Spot) {
        self.missing.note(what, spot);
    }

    /// `Attribute "target" parameters`.
    pub fn attribute(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        const TARGETS: [(&str, Target); 5] = [
            ("shape", Target::Shape),
            ("light", Target::Light),
            ("material", Target::Material),
            ("medium", Target::Medium),
            ("texture", Target::Texture),
        ];
        let name = self.name(lexer, "Attribute", spot)?;
        let Some((_, target)) = TARGETS.iter().find(|(known, _)| *known == name) else {
            return Err(spot
                .error(format!("Attribute cannot be given to \"{}\"", shown(&name)))
                .help("write \"shape\", \"light\", \"material\", \"medium\" or \"texture\""));
        };
        let own = parameters(lexer)?;
        let list = Rc::make_mut(&mut self.state.attributes[*target as usize]);
        list.retain(|old: &Rc<Parameter>| own.iter().all(|new| new.name != old.name));
        list.extend(own.into_iter().map(|one| Rc::new(Parameter { inherited: true, ..one })));
        if list.len() > super::parameter::MOST_PARAMETERS {
            return Err(spot
                .error("more than 256 parameters are inherited")
                .help("give them to fewer things"));
        }
        Ok(())
    }

    /// Keeps the state for the end of a block.
    pub fn begin(&mut self, block: Block, spot: &Spot) {
        self.saved.push(Saved { block, state: self.state.clone(), spot: spot.clone() });
    }

    /// Brings back the state from the beginning of a block.
    pub fn end(&mut self, block: Block, spot: &Spot) -> Result<()> {
        let name = block.name();
        match self.saved.pop() {
            Some(saved) if saved.block == block => {
                match block {
                    Block::Transform => {
                        (self.state.maps, self.state.active) = (saved.state.maps, saved.state.active)
                    }
                    Block::Attribute | Block::Object => self.state = saved.state,
                }
                Ok(())
            }
            Some(saved) => {
                let (open, line) = (saved.block.name(), saved.spot.line);
                let message = format!("{name}End is inside {open}Begin of line {line}");
                Err(spot.error(message).help(format!("add {open}End before it")))
            }
            None => Err(spot.error(format!("{name}End has no {name}Begin")).help("leave it out")),
        }
    }

    /// The object that is being described.
    pub fn open_object(&mut self) -> Option<&mut Object> {
        self.objects.open.as_mut().map(|(_, object)| object)
    }
}
