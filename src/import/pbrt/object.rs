//! Things in the world, and objects that are placed there many times.

use super::lexer::Lexer;
use super::place::Spot;
use super::reader::Reader;
use super::state::{Block, Maps, after};
use super::unsupported::Unsupported;
use crate::Result;
use crate::import::affine::narrow;
use crate::import::text::{shown, suggest};
use crate::scene::{Handle, Instance, Material, Mesh, Shape, ShapeKind};
use glam::{Affine3A, DAffine3};
use std::collections::BTreeMap;

/// Most things in the world, counting each place of an object.
const MOST_THINGS: usize = 1 << 20;

/// The geometry of a thing.
#[derive(Debug, Clone, Copy)]
pub(super) enum Geometry {
    Shape(ShapeKind),
    Mesh(Handle<Mesh>),
}

/// Something with a material and a place.
#[derive(Debug, Clone)]
pub(super) struct Thing {
    pub geometry: Geometry,
    pub material: Handle<Material>,
    pub maps: Maps,
    pub spot: Spot,
    pub kind: &'static str,
}

/// What is between `ObjectBegin` and `ObjectEnd`.
#[derive(Debug, Default)]
pub(super) struct Object {
    pub things: Vec<Thing>,
}

/// All objects by name, and the one that is being described.
#[derive(Debug, Default)]
pub(super) struct Objects {
    known: BTreeMap<String, Object>,
    pub open: Option<(String, Object)>,
}

impl Reader<'_> {
    pub(super) fn object_begin(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let name = self.name(lexer, "ObjectBegin", spot)?;
        if self.objects.open.is_some() {
            return Err(spot.error("ObjectBegin is inside an object").help("add ObjectEnd before it"));
        }
        if self.objects.known.contains_key(&name) {
            let message = format!("there is an object \"{}\" already", shown(&name));
            return Err(spot.error(message).help("choose another name"));
        }
        self.begin(Block::Object, spot);
        self.objects.open = Some((name, Object::default()));
        Ok(())
    }

    pub(super) fn object_end(&mut self, spot: &Spot) -> Result<()> {
        self.end(Block::Object, spot)?;
        if let Some((name, object)) = self.objects.open.take() {
            self.objects.known.insert(name, object);
        }
        Ok(())
    }

    pub(super) fn object_instance(&mut self, lexer: &mut Lexer<'_>, spot: &Spot) -> Result<()> {
        let name = self.name(lexer, "ObjectInstance", spot)?;
        if self.objects.open.is_some() {
            return Err(spot
                .error("ObjectInstance is inside an object")
                .help("describe the shapes there, and place the object after ObjectEnd"));
        }
        let Some(object) = self.objects.known.get(&name) else {
            let names = self.objects.known.keys().map(String::as_str);
            return Err(spot
                .error(format!("no object is named \"{}\"", shown(&name)))
                .help(suggest(&name, names, "objects")));
        };
        let things = object.things.clone();
        let maps = self.state.maps;
        for thing in things {
            self.place_thing(&Thing { maps: after(&maps, &thing.maps), spot: spot.clone(), ..thing })?;
        }
        Ok(())
    }

    /// Puts a thing into the object that is being described, or else into the world.
    pub(super) fn add_thing(&mut self, thing: Thing) -> Result<()> {
        match self.open_object() {
            Some(object) => {
                object.things.push(thing);
                Ok(())
            }
            None => self.place_thing(&thing),
        }
    }

    fn place_thing(&mut self, thing: &Thing) -> Result<()> {
        if self.scene.instances.len() + self.scene.shapes.len() >= MOST_THINGS {
            let message =
                format!("the scene has more than {MOST_THINGS} shapes, counting each ObjectInstance");
            return Err(thing.spot.error(message).help("join the shapes of objects into one plymesh"));
        }
        let [open, close] = thing.maps;
        let world_from_object = self.map(&open, thing)?;
        let at_close = if open == close { None } else { Some(self.map(&close, thing)?) };
        if at_close.is_some() {
            self.check_interval();
            let mirrors = |map: &DAffine3| map.matrix3.determinant() < 0.0;
            if mirrors(&open) != mirrors(&close) {
                return Err(thing
                    .spot
                    .error("of the transforms at both times only one mirrors")
                    .help("a thing that moves cannot be turned inside out"));
            }
        }
        let material = thing.material;
        let name = thing.spot.name(thing.kind);
        match thing.geometry {
            Geometry::Shape(kind) => {
                self.scene.shapes.push(Shape { name, kind, material, world_from_object, at_close });
            }
            Geometry::Mesh(mesh) => {
                self.scene.instances.push(Instance { name, mesh, material, world_from_object, at_close });
            }
        }
        Ok(())
    }

    fn map(&self, map: &DAffine3, thing: &Thing) -> Result<Affine3A> {
        narrow(map).ok_or_else(|| {
            thing
                .spot
                .error(format!("the transform of the {} cannot be inverted", thing.kind))
                .help("give every axis a size in Scale and Transform")
        })
    }

    /// Things move while the shutter is open, whatever `TransformTimes` says.
    pub(super) fn check_interval(&mut self) {
        if let Some((times, spot)) = self.interval.clone()
            && times != self.shutter
        {
            self.unsupported(Unsupported::Interval, &spot);
        }
    }
}
