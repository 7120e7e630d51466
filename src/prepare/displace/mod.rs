//! Displacement: meshes are cut fine, their vertices moved by the values of a texture, and their normals made anew.
//!
//! Silhouettes change and shadows follow. Vertices at one place move alike, by the mean of what their texture coordinates and
//! normals say, so that a closed mesh stays closed across seams and edges.

mod refine;

use super::Displaced;
use crate::layout::TexturePoint;
use crate::scene::{
    Camera, Displacement, DisplacementDirection, EdgeLimit, Film, Handle, Instance, Mesh, MeshPart, Scene,
    Texture,
};
use crate::{Error, Result};
use glam::{Affine3A, Mat3A, Vec2, Vec3};
use refine::{Refined, Vertex};
use std::collections::{BTreeSet, HashMap};

/// The values of a texture at points: red, green and blue.
pub type Values<'a> = dyn FnMut(Handle<Texture>, &[TexturePoint]) -> Result<Vec<[f32; 4]>> + 'a;

/// The textures that displace something.
pub fn displacing(scene: &Scene) -> Vec<Handle<Texture>> {
    let placed = scene.instances.iter().map(|instance| &scene.meshes[instance.mesh]);
    placed.filter_map(|mesh| Some(mesh.displacement?.texture)).collect()
}

/// Puts displaced meshes in place of those that say how they are displaced. Those that `kept` has of the scene before are not made
/// again: `textures` is all that `values` depends on, but for the texture and the points.
///
/// # Errors
/// When a mesh is cut into more triangles than it may have, and those of `values`.
pub fn displace(
    scene: &mut Scene,
    textures: &[u8],
    kept: &mut Displaced,
    values: &mut Values<'_>,
) -> Result<()> {
    // A mesh that is placed several times is displaced once
    let meshes: BTreeSet<_> = scene.instances.iter().map(|instance| instance.mesh).collect();
    for handle in meshes {
        let mesh = &scene.meshes[handle];
        let Some(displacement) = &mesh.displacement else { continue };
        let placed = scene.instances.iter().filter(|instance| instance.mesh == handle);
        let Some(nearest) = nearest(mesh, placed, &scene.camera) else { continue };
        let world = nearest.world_from_object;
        let parts = [textures, &made_from(mesh, displacement, &world, &scene.camera, &scene.film)];
        let key = [&parts[..], &arrays(mesh)].concat();
        let displaced = kept.get(&key, || {
            let refined =
                refine(mesh, displacement, &world, &scene.camera, &scene.film).map_err(|mut error| {
                    error.message = format!("mesh `{}`: {}", scene.meshes.name(handle), error.message);
                    error
                })?;
            moved(mesh, refined, displacement, &world, values)
        })?;
        scene.meshes.replace(handle, displaced);
    }
    Ok(())
}

/// All that a displaced mesh is made from, but for its arrays and the values of its texture.
fn made_from(
    mesh: &Mesh,
    displacement: &Displacement,
    world: &Affine3A,
    camera: &Camera,
    film: &Film,
) -> Vec<u8> {
    // How far edges are cut depends on where they are seen from
    let seen = match displacement.edge {
        EdgeLimit::Length(_) => None,
        EdgeLimit::Pixels(_) => Some((camera, film.width, film.height)),
    };
    format!("{displacement:?} {world:?} {:?} {} {seen:?}", mesh.parts, mesh.round).into_bytes()
}

/// The arrays of a mesh.
fn arrays(mesh: &Mesh) -> [&[u8]; 7] {
    [
        bytemuck::cast_slice(&mesh.positions),
        bytemuck::cast_slice(&mesh.normals),
        bytemuck::cast_slice(&mesh.uvs),
        bytemuck::cast_slice(&mesh.uvs1),
        bytemuck::cast_slice(&mesh.colors),
        bytemuck::cast_slice(&mesh.tangents),
        bytemuck::cast_slice(&mesh.triangles),
    ]
}

/// The instance of a mesh that comes nearest to the camera.
fn nearest<'a>(
    mesh: &Mesh,
    placed: impl Iterator<Item = &'a Instance>,
    camera: &Camera,
) -> Option<&'a Instance> {
    let distance = |instance: &Instance| {
        let near =
            |p: &Vec3| instance.world_from_object.transform_point3(*p).distance_squared(camera.position);
        mesh.positions.iter().map(near).fold(f32::INFINITY, f32::min)
    };
    placed.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

fn refine(
    mesh: &Mesh,
    displacement: &Displacement,
    world: &Affine3A,
    camera: &Camera,
    film: &Film,
) -> Result<Refined> {
    let mut refined = Refined::of(mesh);
    let too_long = |a: Vec3, b: Vec3| {
        let [a, b] = [a, b].map(|p| world.transform_point3(p));
        let limit = match displacement.edge {
            EdgeLimit::Length(length) => length,
            EdgeLimit::Pixels(pixels) => pixels * camera.pixel_width(0.5 * (a + b), film.width, film.height),
        };
        a.distance(b) > limit.max(f32::MIN_POSITIVE)
    };
    refined.refine(displacement.most_triangles, &too_long)?;
    Ok(refined)
}

/// The mesh with its vertices moved.
fn moved(
    mesh: &Mesh,
    refined: Refined,
    displacement: &Displacement,
    world: &Affine3A,
    values: &mut Values<'_>,
) -> Result<Mesh> {
    let directions = place_normals(&refined);
    let normal_map = world.matrix3.inverse().transpose();
    let points: Vec<_> =
        refined.vertices.iter().map(|v| point(&refined, v, &directions, world, &normal_map)).collect();
    let colors = values(displacement.texture, &points)?;
    if colors.len() != points.len() {
        return Err(Error::device("a texture gave the wrong number of heights"));
    }
    // Heights are in units of the world; a map may stretch directions, but a mesh has one scale
    let scale = world.matrix3.determinant().abs().cbrt().max(f32::MIN_POSITIVE);
    let tangents = place_tangents(&refined);
    let mut offsets = vec![(Vec3::ZERO, 0.0_f32); refined.places.len()];
    for (vertex, [r, g, b, _]) in refined.vertices.iter().zip(colors) {
        let place = vertex.place as usize;
        let value = (Vec3::new(r, g, b) - displacement.offset) * (displacement.height / scale);
        let normal = directions[place];
        let offset = match displacement.direction {
            DisplacementDirection::Normal => normal * (value.element_sum() / 3.0),
            DisplacementDirection::Object => value,
            DisplacementDirection::Tangent => {
                let tangent = tangents[place]
                    .reject_from_normalized(normal)
                    .normalize_or(normal.any_orthonormal_vector());
                tangent * value.x + normal.cross(tangent) * value.y + normal * value.z
            }
        };
        offsets[place].0 += offset;
        offsets[place].1 += 1.0;
    }
    let places: Vec<Vec3> =
        refined.places.iter().zip(&offsets).map(|(p, (sum, n))| *p + *sum / n.max(1.0)).collect();
    if !places.iter().all(|p| p.is_finite()) {
        return Err(Error::scene("a displacement is not finite").help("look at the texture and its `height`"));
    }
    let normals = new_normals(&refined, &places);
    let part = |(part, triangles): (&MeshPart, &std::ops::Range<u32>)| MeshPart {
        triangles: triangles.clone(),
        ..part.clone()
    };
    Ok(Mesh {
        positions: refined.vertices.iter().map(|v| places[v.place as usize]).collect(),
        normals,
        uvs: refined.vertices.iter().map(|v| v.uv).collect(),
        uvs1: if mesh.uvs1.is_empty() {
            Vec::new()
        } else {
            refined.vertices.iter().map(|v| v.uv1).collect()
        },
        colors: if mesh.colors.is_empty() {
            Vec::new()
        } else {
            refined.vertices.iter().map(|v| v.color).collect()
        },
        // Those of the mesh were along the surface that has been moved
        tangents: Vec::new(),
        parts: mesh.parts.iter().zip(&refined.parts).map(part).collect(),
        triangles: refined.triangles,
        displacement: None,
        round: false,
    })
}

/// Where the texture is asked for the height of a vertex.
fn point(
    refined: &Refined,
    vertex: &Vertex,
    directions: &[Vec3],
    world: &Affine3A,
    normal_map: &Mat3A,
) -> TexturePoint {
    let position = refined.places[vertex.place as usize];
    let normal = *normal_map * directions[vertex.place as usize];
    TexturePoint {
        position: world.transform_point3(position).to_array(),
        object_position: position.to_array(),
        uv: vertex.uv.to_array(),
        uv1: vertex.uv1.to_array(),
        vertex_color: vertex.color.to_array(),
        normal: normal.normalize_or_zero().to_array(),
        object_normal: directions[vertex.place as usize].to_array(),
        ..TexturePoint::default()
    }
}

/// Twice the area of a triangle, along its normal.
fn area(refined: &Refined, places: &[Vec3], triangle: [u32; 3]) -> Vec3 {
    let [a, b, c] = triangle.map(|v| places[refined.vertices[v as usize].place as usize]);
    (b - a).cross(c - a)
}

/// The unit normal of each place: the mean of those of its vertices, or of the triangles around it in a flat mesh.
fn place_normals(refined: &Refined) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; refined.places.len()];
    for triangle in &refined.triangles {
        let flat = area(refined, &refined.places, *triangle);
        for &v in triangle {
            let vertex = refined.vertices[v as usize];
            sums[vertex.place as usize] +=
                if vertex.normal == Vec3::ZERO { flat } else { vertex.normal * flat.length() };
        }
    }
    sums.into_iter().map(Vec3::normalize_or_zero).collect()
}

/// ∂p/∂u at each place, of any length.
fn place_tangents(refined: &Refined) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; refined.places.len()];
    for triangle in &refined.triangles {
        let [a, b, c] = triangle.map(|v| refined.vertices[v as usize]);
        let [p, q, r] = [a, b, c].map(|v| refined.places[v.place as usize]);
        let (du, dv): (Vec2, Vec2) = (b.uv - a.uv, c.uv - a.uv);
        let along_u = ((q - p) * dv.y - (r - p) * du.y) * du.perp_dot(dv).signum();
        [a, b, c].iter().for_each(|v| sums[v.place as usize] += along_u);
    }
    sums
}

/// Normals of the moved vertices: of the triangles around a place, apart where the mesh had normals that differ.
fn new_normals(refined: &Refined, places: &[Vec3]) -> Vec<Vec3> {
    let key = |v: &Vertex| (v.place, v.normal.to_array().map(f32::to_bits));
    let mut sums: HashMap<_, Vec3> = HashMap::new();
    for triangle in &refined.triangles {
        let flat = area(refined, places, *triangle);
        for &v in triangle {
            *sums.entry(key(&refined.vertices[v as usize])).or_default() += flat;
        }
    }
    let of = |v: &Vertex| sums.get(&key(v)).map_or(Vec3::ZERO, |sum| sum.normalize_or_zero());
    refined.vertices.iter().map(of).collect()
}

#[cfg(test)]
mod tests;
