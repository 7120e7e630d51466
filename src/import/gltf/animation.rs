//! Animations: the places and weights of nodes at a time (glTF 2.0, section 3.11 and appendix C).

use super::document::{Document, index_into};
use super::json::Json;
use super::node::{Nodes, unit};
use crate::Result;
use glam::{Quat, Vec3, Vec4};
use std::collections::BTreeSet;

/// Puts the nodes where all animations have them at a time in seconds. Where two of them move one thing, the first counts.
pub(super) fn pose(document: &Document<'_>, nodes: &mut Nodes<'_>, time: f32) -> Result<()> {
    let mut moved = BTreeSet::new();
    for animation in document.root.list("animations")? {
        let samplers = animation.list("samplers")?;
        for channel in animation.list("channels")? {
            let target = channel.need("target")?;
            // Without a node it is the target of an extension
            let Some(node) = target.get("node")? else { continue };
            let node = index_into(&node, "nodes", nodes.nodes.len())?;
            let path = target.need("path")?;
            let sampler = &samplers
                [index_into(&channel.need("sampler")?, "samplers of the animation", samplers.len())?];
            if !moved.insert((node, path.string()?.to_owned())) {
                continue;
            }
            let node = &mut nodes.nodes[node];
            match path.string()? {
                "translation" => {
                    node.split();
                    node.place.translation = sample(document, sampler, time, |a: Vec3, b, t| a.lerp(b, t))?;
                }
                "scale" => {
                    node.split();
                    node.place.scale = sample(document, sampler, time, |a: Vec3, b, t| a.lerp(b, t))?;
                }
                "rotation" => {
                    node.split();
                    node.place.rotation = unit(Quat::from_vec4(sample(document, sampler, time, slerp)?));
                }
                "weights" => node.weights = Some(weights(document, sampler, time)?),
                _ => return Err(path.error("no such thing of a node can be animated")),
            }
        }
    }
    Ok(())
}

/// The shorter way between two rotations.
fn slerp(a: Vec4, b: Vec4, t: f32) -> Vec4 {
    let [a, b] = [a, b].map(|rotation| unit(Quat::from_vec4(rotation)));
    a.slerp(b, t).into()
}

/// How long an animation is in seconds.
pub(super) fn length(document: &Document<'_>, animation: &Json<'_>) -> Result<f32> {
    let mut end = 0.0_f32;
    for sampler in animation.list("samplers")? {
        let times = document.floats::<1>(&sampler.need("input")?)?;
        end = times.last().map_or(end, |[last]| end.max(*last));
    }
    Ok(end)
}

/// How values follow from those of key frames.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Interpolation {
    Linear,
    Step,
    CubicSpline,
}

/// Key frames of a sampler, and where between two of them a time is.
struct Keys {
    interpolation: Interpolation,
    count: usize,
    /// The key frames before and after, which are the same outside of all.
    before: usize,
    after: usize,
    /// From 0 at the one to 1 at the other.
    part: f32,
    /// Seconds between the two.
    span: f32,
}

impl Keys {
    fn find(document: &Document<'_>, sampler: &Json<'_>, time: f32) -> Result<Self> {
        let input = sampler.need("input")?;
        let times = document.floats::<1>(&input)?;
        if !times.is_sorted() {
            return Err(input.error("the times of the key frames do not grow"));
        }
        let interpolation = match sampler.text("interpolation")? {
            None | Some("LINEAR") => Interpolation::Linear,
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::CubicSpline,
            Some(_) => return Err(sampler.error("`interpolation` is none of LINEAR, STEP and CUBICSPLINE")),
        };
        let after = times.partition_point(|[key]| *key <= time);
        let (before, after) = (after.saturating_sub(1), after.min(times.len() - 1));
        let span = times[after][0] - times[before][0];
        let part = if span > 0.0 { ((time - times[before][0]) / span).clamp(0.0, 1.0) } else { 0.0 };
        Ok(Self { interpolation, count: times.len(), before, after, part, span })
    }

    /// How many values there must be, with `size` at each key frame.
    fn values(&self, size: usize) -> usize {
        let parts = if self.interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        self.count.saturating_mul(parts).saturating_mul(size)
    }

    /// Factors on the value and the out-tangent of the key before, and on the in-tangent and the value of the one after: Hermite's
    /// splines.
    fn hermite(&self) -> [f32; 4] {
        let (t, t2, t3) = (self.part, self.part * self.part, self.part * self.part * self.part);
        [
            2.0 * t3 - 3.0 * t2 + 1.0,
            self.span * (t3 - 2.0 * t2 + t),
            self.span * (t3 - t2),
            3.0 * t2 - 2.0 * t3,
        ]
    }
}

fn sample<const N: usize, T>(
    document: &Document<'_>,
    sampler: &Json<'_>,
    time: f32,
    mix: impl Fn(T, T, f32) -> T,
) -> Result<T>
where
    T: From<[f32; N]>,
{
    let keys = Keys::find(document, sampler, time)?;
    let output = sampler.need("output")?;
    let values = document.floats::<N>(&output)?;
    if values.len() != keys.values(1) {
        return Err(output.error(format!("there are {} values for {} key frames", values.len(), keys.count)));
    }
    let Keys { before, after, part, .. } = keys;
    Ok(match keys.interpolation {
        Interpolation::Step => values[before].into(),
        Interpolation::Linear => mix(values[before].into(), values[after].into(), part),
        Interpolation::CubicSpline => {
            let factors = keys.hermite();
            let four = [3 * before + 1, 3 * before + 2, 3 * after, 3 * after + 1].map(|i| values[i]);
            std::array::from_fn(|i| four.iter().zip(factors).map(|(value, factor)| value[i] * factor).sum())
                .into()
        }
    })
}

/// The weights of all morph targets.
fn weights(document: &Document<'_>, sampler: &Json<'_>, time: f32) -> Result<Vec<f32>> {
    let keys = Keys::find(document, sampler, time)?;
    let output = sampler.need("output")?;
    let values = document.floats::<1>(&output)?;
    let size = values.len() / keys.values(1);
    if size == 0 || values.len() != keys.values(size) {
        return Err(output.error(format!(
            "there are {} weights for {} key frames",
            values.len(),
            keys.count
        )));
    }
    let at = |row: usize, i: usize| values[row * size + i][0];
    let (before, after) = (keys.before, keys.after);
    let one = |i: usize| match keys.interpolation {
        Interpolation::Step => at(before, i),
        Interpolation::Linear => at(before, i) + (at(after, i) - at(before, i)) * keys.part,
        Interpolation::CubicSpline => {
            let [a, b, c, d] = keys.hermite();
            a * at(3 * before + 1, i)
                + b * at(3 * before + 2, i)
                + c * at(3 * after, i)
                + d * at(3 * after + 1, i)
        }
    };
    Ok((0..size).map(one).collect())
}
