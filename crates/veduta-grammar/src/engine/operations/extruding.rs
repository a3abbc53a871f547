//! `extrude` of shapes whose faces look in several directions, up to a level top, and of edges.

use std::collections::HashSet;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{self, joined, Face, Mesh};

use super::meshes::triangles;
use super::standing::upright;
use crate::shape::{Form, Geometry, Scope, TOLERANCE};

/// How near to 1 the cosine between normals of one direction is.
const ALIKE: f64 = 1.0 - 1e-9;

/// What is extruded, and the direction of its first face or corner.
pub struct Extruded {
    pub form: Form,
    pub along: DVec3,
}

/// Each face along its own normal; None where all faces have the same, or none has any.
pub fn by_faces(form: &Form, height: f64) -> Option<Extruded> {
    let mesh = form.world_mesh();
    let first = several_directions(&mesh)?;
    let mut solid = Mesh::new();
    for face in mesh.faces().filter(|face| face.normal() != DVec3::ZERO) {
        let alone = mesh.of_faces([face.index()]);
        solid.append(&solid::extrude(&alone, face.normal() * height));
    }
    Some(around(form, solid, first))
}

/// All corners along the mean of the normals of the faces there, which stay together; None as for
/// [`by_faces`].
pub fn by_corners(form: &Form, height: f64) -> Option<Extruded> {
    let near = form.scope.size.length() * TOLERANCE;
    let mesh = joined(&[&form.world_mesh()], near);
    several_directions(&mesh)?;
    let normals = solid::point_normals(&mesh);
    let sides: HashSet<(u32, u32)> = mesh.faces().flat_map(Face::edges).collect();
    let mut upper = mesh.clone();
    for (point, normal) in upper.points.iter_mut().zip(&normals) {
        *point += normal * height;
    }
    let mut solid = mesh.clone().reversed();
    let above = |point: u32| point + mesh.points.len() as u32;
    solid.points.extend(&upper.points);
    for (index, face) in mesh.faces().enumerate() {
        for piece in planar_pieces(&upper, &mesh, index) {
            let rings = piece
                .iter()
                .map(|ring| ring.iter().map(|&point| above(point)));
            solid.push_face(&rings.map(Iterator::collect::<Vec<_>>).collect::<Vec<_>>());
        }
        for (a, b) in face.edges().filter(|&(a, b)| !sides.contains(&(b, a))) {
            solid.push_face(&[[a, b, above(b)]]);
            solid.push_face(&[[a, above(b), above(a)]]);
        }
    }
    let first = mesh.face(0).outline()[0] as usize;
    let solid = if height < 0.0 {
        solid.reversed()
    } else {
        solid
    };
    Some(around(form, solid, normals[first]))
}

/// The rings of a face whose corners moved: as it is where it stays in a plane, else of triangles. Where
/// none fit into its new outline, those of the face before.
fn planar_pieces(moved: &Mesh, before: &Mesh, index: usize) -> Vec<Vec<Vec<u32>>> {
    let face = moved.face(index);
    let whole = || vec![face.rings().map(<[u32]>::to_vec).collect()];
    if triangles(moved, face).is_ok() {
        return whole();
    }
    let bent = solid::triangles(moved, face, f64::MAX).map_err(|error| error.to_string());
    let found = bent.or_else(|_| triangles(before, before.face(index)));
    found.map_or_else(
        |_| whole(),
        |all| all.iter().map(|ring| vec![ring.to_vec()]).collect(),
    )
}

/// Up to a level top, so high above the lowest corner, but no lower than the highest; below zero down to
/// a level floor under the highest. None where the shape is level or stands upright.
pub fn to_level(form: &Form, height: f64) -> Option<Extruded> {
    let mesh = form.world_mesh();
    let (low, high) = mesh.bounds()?;
    let extent = high.y - low.y;
    let near = form.scope.size.length() * TOLERANCE;
    if extent <= near {
        return None;
    }
    let level = match height < 0.0 {
        true => high.y - extent.max(-height),
        false => low.y + extent.max(height),
    };
    let mut solid = Mesh::new();
    for face in mesh.faces() {
        let up = face.area_vector().y;
        if up == 0.0 {
            continue;
        }
        let rings = face.rings().map(|ring| {
            let points = ring.iter().map(|&point| mesh.points[point as usize]);
            let mut ring: Vec<DVec3> = points.collect();
            if up < 0.0 {
                ring.reverse();
            }
            ring
        });
        add_column(&mut solid, &rings.collect::<Vec<_>>(), level, near);
    }
    let solid = if height < 0.0 {
        solid.reversed()
    } else {
        solid
    };
    (!solid.is_empty()).then(|| around(form, solid, DVec3::Y))
}

/// The wall over an edge, along z of its scope or another direction; None where the shape is no edge.
pub fn of_edge(form: &Form, direction: Option<DVec3>, height: f64) -> Option<Extruded> {
    let Scope { origin, axes, size } = form.scope;
    if form.geometry != Geometry::Nothing || size.x <= 0.0 || size.y != 0.0 || size.z != 0.0 {
        return None;
    }
    let along = direction.unwrap_or(axes.z_axis);
    let x = (axes.x_axis - along * axes.x_axis.dot(along)).try_normalize()?;
    let end = origin + axes.x_axis * size.x;
    let by = along * height;
    let wall = Mesh::polygon(&[[origin, end, end + by, origin + by]]);
    let turned = DMat3::from_cols(x, along, x.cross(along));
    let form = Form::around(wall, turned, false);
    Some(Extruded { form, along })
}

/// The normal of the first face, where others look elsewhere.
fn several_directions(mesh: &Mesh) -> Option<DVec3> {
    let mut normals = mesh.faces().map(|face| face.normal());
    let first = normals.find(|normal| *normal != DVec3::ZERO)?;
    let differs = |normal: DVec3| normal != DVec3::ZERO && normal.dot(first) < ALIKE;
    normals.any(differs).then_some(first)
}

fn around(form: &Form, solid: Mesh, along: DVec3) -> Extruded {
    let is_closed = solid.is_closed();
    Extruded {
        form: Form::around(solid, upright(form, along), is_closed),
        along,
    }
}

/// The column over rings that look up, with its other end at a height.
fn add_column(solid: &mut Mesh, rings: &[Vec<DVec3>], level: f64, near: f64) {
    let (mut floor, mut top, mut walls) = (Vec::new(), Vec::new(), Vec::new());
    for ring in rings {
        let low: Vec<u32> = ring.iter().map(|&point| solid.push_point(point)).collect();
        let each = ring.iter().zip(&low);
        let high: Vec<u32> = each
            .map(|(point, &own)| match (point.y - level).abs() <= near {
                true => own,
                false => solid.push_point(DVec3::new(point.x, level, point.z)),
            })
            .collect();
        for k in 0..ring.len() {
            let next = (k + 1) % ring.len();
            let mut wall = vec![low[k], low[next], high[next], high[k]];
            wall.dedup();
            if wall.len() > 2 && wall[0] == wall[wall.len() - 1] {
                wall.pop();
            }
            walls.push(wall);
        }
        floor.push(low.into_iter().rev().collect::<Vec<_>>());
        top.push(high);
    }
    solid.push_face(&floor);
    solid.push_face(&top);
    for wall in walls.into_iter().filter(|wall| wall.len() > 2) {
        solid.push_face(&[wall]);
    }
}
