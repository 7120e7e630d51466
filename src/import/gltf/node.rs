//! Nodes: where each is in its parent, and in the world.

use super::document::{Document, index_into};
use super::json::Json;
use crate::Result;
use glam::{DAffine3, DMat4, Mat4, Quat, Vec3};

/// Stretch, then rotation, then translation of a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub translation: Vec3,
    pub rotation: Quat,
    pub scale: Vec3,
}

/// A node of the document.
pub(super) struct Node<'a> {
    pub json: Json<'a>,
    pub name: String,
    pub children: Vec<usize>,
    /// Its place in its parent, when that is not a matrix.
    pub place: Place,
    matrix: Option<Mat4>,
    /// Weights of morph targets, when the node has its own.
    pub weights: Option<Vec<f32>>,
}

impl<'a> Node<'a> {
    fn read(json: Json<'a>, index: usize, count: usize) -> Result<Self> {
        let children = json.list("children")?;
        let children =
            children.iter().map(|child| index_into(child, "nodes", count)).collect::<Result<_>>()?;
        let matrix = json.get("matrix")?.map(|matrix| matrix.numbers::<16>()).transpose()?;
        let rotation = Quat::from_array(json.numbers_or("rotation", [0.0, 0.0, 0.0, 1.0])?);
        let place = Place {
            translation: json.numbers_or("translation", [0.0; 3])?.into(),
            rotation: unit(rotation),
            scale: json.numbers_or("scale", [1.0; 3])?.into(),
        };
        let weights = json.get("weights")?.map(|weights| numbers(&weights)).transpose()?;
        Ok(Self {
            name: json.name("node", index)?,
            matrix: matrix.map(|columns| Mat4::from_cols_array(&columns)),
            json,
            children,
            place,
            weights,
        })
    }

    /// From the node to its parent.
    fn local(&self) -> DAffine3 {
        match self.matrix {
            Some(matrix) => DAffine3::from_mat4(matrix.as_dmat4()),
            None => self.place.map(),
        }
    }

    /// Takes a matrix apart, so that its parts can be animated one by one.
    pub fn split(&mut self) {
        if let Some(matrix) = self.matrix.take() {
            let (scale, rotation, translation) = DMat4::to_scale_rotation_translation(&matrix.as_dmat4());
            let place = Place {
                scale: scale.as_vec3(),
                rotation: rotation.as_quat(),
                translation: translation.as_vec3(),
            };
            self.place = place;
        }
    }
}

impl Place {
    /// From where a thing is placed to around it.
    pub fn map(&self) -> DAffine3 {
        let (scale, translation) = (self.scale.as_dvec3(), self.translation.as_dvec3());
        DAffine3::from_scale_rotation_translation(scale, self.rotation.as_dquat(), translation)
    }
}

/// A rotation of unit length; one of no length turns nothing.
pub(super) fn unit(rotation: Quat) -> Quat {
    let rotation = rotation.as_dquat();
    let length = rotation.length();
    if length > 0.0 { (rotation * (1.0 / length)).as_quat() } else { Quat::IDENTITY }
}

/// A list of numbers of any length.
pub(super) fn numbers(json: &Json<'_>) -> Result<Vec<f32>> {
    json.items()?.iter().map(Json::number).collect()
}

/// All nodes of a document, which are trees.
pub(super) struct Nodes<'a> {
    pub nodes: Vec<Node<'a>>,
    /// Each node after its parent.
    order: Vec<usize>,
}

impl<'a> Nodes<'a> {
    /// Reads the nodes and sees to it that they are trees.
    pub fn read(document: &Document<'a>) -> Result<Self> {
        let items = document.root.list("nodes")?;
        let count = items.len();
        let nodes: Vec<Node<'a>> = items
            .into_iter()
            .enumerate()
            .map(|(i, json)| Node::read(json, i, count))
            .collect::<Result<_>>()?;
        let mut parents = vec![None; count];
        for (i, node) in nodes.iter().enumerate() {
            for &child in &node.children {
                if let Some(other) = parents[child].replace(i) {
                    let message = format!("node {child} is a child of node {other} and of node {i}");
                    return Err(node.json.error(message));
                }
            }
        }
        let mut order: Vec<usize> = (0..count).filter(|i| parents[*i].is_none()).collect();
        let mut at = 0;
        while let Some(&node) = order.get(at) {
            order.extend(&nodes[node].children);
            at += 1;
        }
        if order.len() < count {
            let mut reached = vec![false; count];
            order.iter().for_each(|&node| reached[node] = true);
            let looped = reached.iter().position(|reached| !reached).unwrap_or(0);
            return Err(nodes[looped].json.error("the node is its own ancestor, or below one that is"));
        }
        Ok(Self { nodes, order })
    }

    /// From each node to the world.
    pub fn world(&self) -> Vec<DAffine3> {
        let mut world: Vec<DAffine3> = self.nodes.iter().map(Node::local).collect();
        for &node in &self.order {
            for &child in &self.nodes[node].children {
                world[child] = world[node] * world[child];
            }
        }
        world
    }

    /// The nodes of the scene that is shown: the default one, or the first; all nodes of a file without scenes.
    pub fn shown(&self, document: &Document<'_>) -> Result<Vec<usize>> {
        let scenes = document.root.list("scenes")?;
        for (i, scene) in scenes.iter().enumerate() {
            scene.name("scene", i)?;
            for node in scene.list("nodes")? {
                index_into(&node, "nodes", self.nodes.len())?;
            }
        }
        let default = document
            .root
            .get("scene")?
            .map(|scene| index_into(&scene, "scenes", scenes.len()))
            .transpose()?;
        let Some(scene) = scenes.get(default.unwrap_or(0)) else { return Ok(self.order.clone()) };
        let mut shown = vec![false; self.nodes.len()];
        for root in scene.list("nodes")? {
            shown[root.whole()?] = true;
        }
        for &node in &self.order {
            if shown[node] {
                self.nodes[node].children.iter().for_each(|&child| shown[child] = true);
            }
        }
        Ok((0..self.nodes.len()).filter(|node| shown[*node]).collect())
    }
}
