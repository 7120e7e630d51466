//! The vertices of a PLY file.

use super::ply::{Source, list_length};
use super::ply_header::{Element, Scalar};
use super::srgb::linear_from_srgb;
use crate::scene::{Mesh, unit};
use crate::{Error, Result};
use glam::{Vec2, Vec3, Vec4};

/// Names of the properties that are read: x y z, normal, uv in its three spellings, a second uv, tangent, and colour.
const POSITION: [&str; 3] = ["x", "y", "z"];
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
const UVS: [[&str; 2]; 3] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]];
const UV1: [&str; 2] = ["u1", "v1"];
const TANGENT: [&str; 4] = ["tx", "ty", "tz", "tw"];
const COLOR: [&str; 3] = ["red", "green", "blue"];
const ALPHA: &str = "alpha";
/// Slots of a row: those of colours are the last four.
const SLOTS: usize = 18;
const FIRST_COLOR: usize = 14;

pub(super) fn read_vertices(element: &Element, source: &mut impl Source, mesh: &mut Mesh) -> Result<()> {
    let find = |name: &&str| element.properties.iter().position(|p| p.name == *name && p.length.is_none());
    let all = |names: &[&str]| -> Option<Vec<usize>> { names.iter().map(find).collect() };
    let positions = all(&POSITION).ok_or_else(|| {
        Error::scene("the vertices have no complete position").help("give them the properties x, y and z")
    })?;
    let normals = all(&NORMAL);
    let uvs = UVS.iter().find_map(|names| all(names));
    let uvs1 = all(&UV1);
    let tangents = all(&TANGENT);
    let colors = all(&COLOR);
    let alpha = colors.as_ref().and_then(|_| find(&ALPHA));

    // Slot of a row in which each property is kept; none = passed over.
    let mut slots = vec![None; element.properties.len()];
    let used = positions.iter().chain(normals.iter().flatten()).zip(0_usize..);
    let used = used.chain(uvs.iter().flatten().zip(6..)).chain(uvs1.iter().flatten().zip(8..));
    let used = used.chain(tangents.iter().flatten().zip(10..));
    for (&property, slot) in used.chain(colors.iter().flatten().chain(&alpha).zip(FIRST_COLOR..)) {
        slots[property] = Some(slot);
    }
    let count = element.count as usize;
    mesh.positions.reserve_exact(count);
    mesh.normals.reserve_exact(if normals.is_some() { count } else { 0 });
    mesh.uvs.reserve_exact(if uvs.is_some() { count } else { 0 });
    mesh.uvs1.reserve_exact(if uvs1.is_some() { count } else { 0 });
    mesh.tangents.reserve_exact(if tangents.is_some() { count } else { 0 });
    mesh.colors.reserve_exact(if colors.is_some() { count } else { 0 });
    for _ in 0..count {
        let mut row = [0.0_f32; SLOTS];
        row[SLOTS - 1] = 1.0;
        source.start_row();
        for (property, slot) in element.properties.iter().zip(&slots) {
            match (slot, property.length) {
                (_, Some(length)) => {
                    let length = list_length(source, length, property.scalar)?;
                    source.skip(property.scalar, length)?;
                }
                (None, None) => source.skip(property.scalar, 1)?,
                (Some(slot), None) => {
                    let value = source.scalar(property.scalar)? as f32;
                    if !value.is_finite() {
                        let vertex = mesh.positions.len();
                        let message = format!("{} of vertex {vertex} is not a finite number", property.name);
                        return Err(
                            Error::scene(message).help("export the mesh again without NaN and infinities")
                        );
                    }
                    row[*slot] = match *slot {
                        FIRST_COLOR.. => channel(value, property.scalar, *slot == SLOTS - 1),
                        _ => value,
                    };
                }
            }
        }
        source.end_row()?;
        let [x, y, z, nx, ny, nz, u, v, u1, v1, tx, ty, tz, tw, red, green, blue, alpha] = row;
        mesh.positions.push(Vec3::new(x, y, z));
        if normals.is_some() {
            mesh.normals.push(Vec3::new(nx, ny, nz));
        }
        if uvs.is_some() {
            mesh.uvs.push(Vec2::new(u, v));
        }
        if uvs1.is_some() {
            mesh.uvs1.push(Vec2::new(u1, v1));
        }
        if tangents.is_some() {
            let side = if tw < 0.0 { -1.0 } else { 1.0 };
            mesh.tangents.push(unit(Vec3::new(tx, ty, tz)).unwrap_or_default().extend(side));
        }
        if colors.is_some() {
            mesh.colors.push(Vec4::new(red, green, blue, alpha));
        }
    }
    Ok(())
}

/// A channel of a colour as linear light; alpha is linear as it is.
fn channel(value: f32, scalar: Scalar, is_alpha: bool) -> f32 {
    let most = match scalar {
        Scalar::F32 | Scalar::F64 => return value.max(0.0),
        Scalar::U16 => 65535.0,
        _ => 255.0,
    };
    let part = (value / most).clamp(0.0, 1.0);
    if is_alpha { part } else { linear_from_srgb(part) }
}
