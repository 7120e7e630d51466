//! Vertices where morph targets and skins have them (glTF 2.0, sections 3.7.2.2 and 3.7.3).

use super::document::{Document, index_into};
use super::json::Json;
use super::primitive::{Primitive, Vertices};
use crate::Result;
use glam::{Affine3A, DAffine3, DMat4, Mat3A, Mat4, Vec2, Vec3, Vec3A};

/// Adds the displacements of the morph targets, each times its weight.
pub(super) fn morph(
    document: &Document<'_>,
    primitive: &Primitive<'_>,
    weights: &[f32],
    vertices: &mut Vertices,
) -> Result<()> {
    for (target, &weight) in primitive.targets.iter().zip(weights) {
        if weight == 0.0 {
            continue;
        }
        for (name, reference) in target {
            let moves = |reference| document.floats::<3>(reference);
            match *name {
                "POSITION" => add(&mut vertices.positions, moves(reference)?, weight),
                "NORMAL" => add(&mut vertices.normals, moves(reference)?, weight),
                "TANGENT" => {
                    let moves = moves(reference)?;
                    for (tangent, by) in vertices.tangents.iter_mut().zip(moves) {
                        *tangent += (Vec3::from(by) * weight).extend(0.0);
                    }
                }
                "TEXCOORD_0" => slide(&mut vertices.uvs, document.floats::<2>(reference)?, weight),
                "TEXCOORD_1" => slide(&mut vertices.uvs1, document.floats::<2>(reference)?, weight),
                "COLOR_0" => {
                    for (color, by) in vertices.colors.iter_mut().zip(document.colors(reference, 0.0)?) {
                        *color += by * weight;
                    }
                }
                _ => {}
            }
        }
    }
    Ok(())
}

fn add(vectors: &mut [Vec3], by: Vec<[f32; 3]>, weight: f32) {
    vectors.iter_mut().zip(by).for_each(|(vector, by)| *vector += Vec3::from(by) * weight);
}

fn slide(uvs: &mut [Vec2], by: Vec<[f32; 2]>, weight: f32) {
    uvs.iter_mut().zip(by).for_each(|(uv, [u, v])| *uv += Vec2::new(u, -v) * weight);
}

/// From the mesh to the world for each joint of a skin.
pub(super) fn joint_maps(
    document: &Document<'_>,
    skin: &Json<'_>,
    world: &[DAffine3],
) -> Result<Vec<Affine3A>> {
    let joints = skin.need("joints")?.items()?;
    let joints: Vec<usize> =
        joints.iter().map(|joint| index_into(joint, "nodes", world.len())).collect::<Result<_>>()?;
    let inverse = match skin.get("inverseBindMatrices")? {
        Some(reference) => {
            let matrices = document.floats::<16>(&reference)?;
            if matrices.len() < joints.len() {
                let (found, wanted) = (matrices.len(), joints.len());
                return Err(
                    reference.error(format!("there are {found} inverse bind matrices for {wanted} joints"))
                );
            }
            matrices
        }
        None => vec![Mat4::IDENTITY.to_cols_array(); joints.len()],
    };
    let maps = joints.iter().zip(inverse).map(|(joint, inverse)| {
        let bind = DAffine3::from_mat4(DMat4::from_cols_array(&inverse.map(f64::from)));
        narrow(&(world[*joint] * bind))
    });
    Ok(maps.collect())
}

/// The same map in 32 bits.
pub(super) fn narrow(map: &DAffine3) -> Affine3A {
    let [x, y, z, translation] = [map.x_axis, map.y_axis, map.z_axis, map.translation].map(|c| c.as_vec3a());
    Affine3A { matrix3: Mat3A::from_cols(x, y, z), translation }
}

/// Moves vertices to the world by the joints that hold them.
pub(super) fn skin(
    document: &Document<'_>,
    primitive: &Primitive<'_>,
    maps: &[Affine3A],
    vertices: &mut Vertices,
) -> Result<()> {
    document.budget.take(vertices.positions.len(), size_of::<(Mat3A, Vec3A, f32)>())?;
    let mut sums = vec![(Mat3A::ZERO, Vec3A::ZERO, 0.0_f32); vertices.positions.len()];
    for set in 0.. {
        let (joints, weights) = (format!("JOINTS_{set}"), format!("WEIGHTS_{set}"));
        let (Some(joints), Some(weights)) = (primitive.attribute(&joints), primitive.attribute(&weights))
        else {
            break;
        };
        let (_, accessor) = document.accessor(joints)?;
        let held = accessor.wholes::<4>(&document.buffers, &document.budget)?;
        for ((sum, held), weights) in sums.iter_mut().zip(held).zip(document.floats::<4>(weights)?) {
            for (joint, weight) in held.into_iter().zip(weights).filter(|(_, weight)| *weight != 0.0) {
                let Some(map) = maps.get(joint as usize) else {
                    return Err(
                        joints.error(format!("joint {joint} is not in the skin, which has {}", maps.len()))
                    );
                };
                sum.0 += map.matrix3 * weight;
                sum.1 += map.translation * weight;
                sum.2 += weight;
            }
        }
    }
    for (i, (matrix, translation, weight)) in sums.into_iter().enumerate() {
        // A vertex that no joint holds stays where it is
        if weight == 0.0 {
            continue;
        }
        let map = Affine3A { matrix3: matrix * (1.0 / weight), translation: translation / weight };
        vertices.positions[i] = map.transform_point3(vertices.positions[i]);
        if let Some(normal) = vertices.normals.get_mut(i) {
            *normal = cofactors(&map.matrix3) * *normal;
        }
        if let Some(tangent) = vertices.tangents.get_mut(i) {
            *tangent = map.transform_vector3(tangent.truncate()).extend(tangent.w);
        }
    }
    Ok(())
}

/// The map of normals up to a factor, which exists for flat maps too.
fn cofactors(m: &Mat3A) -> Mat3A {
    let side = m.determinant().signum();
    let columns = [m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis)];
    let [x, y, z] = columns.map(|column| column * side);
    Mat3A::from_cols(x, y, z)
}
