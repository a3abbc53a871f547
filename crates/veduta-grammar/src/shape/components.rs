//! A shape to its faces, edges or vertices, and which of them a selector means.

use std::collections::HashMap;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{point_normals, Face, Mesh};

use super::form::{rectangle, Form, Geometry, TOLERANCE};
use super::scope::Scope;

/// What a shape is taken apart into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Faces,
    /// Each edge once, however many faces have it.
    Edges,
    /// The edges of each face, face by face.
    FaceEdges,
    Vertices,
    /// The corners of each face, face by face.
    FaceVertices,
    /// What fills each hole of each face.
    Holes,
    /// The groups of an asset, or the shape where it has none.
    Groups,
    /// The materials of an asset, or the shape.
    Materials,
}

/// Where a component looks, in the scope of the shape that it was taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
}

/// A component: its number, where it looks, and its form.
///
/// Faces look along their normal, edges of faces away from the face, edges between faces along the
/// mean of the two normals, edges of one face away from it; vertices along the mean of the normals of
/// their faces, and corners of faces along the normal of the face.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    pub index: usize,
    pub direction: Option<Direction>,
    /// The direction in the world; zero where the faces around it look against each other.
    pub normal: DVec3,
    pub form: Form,
}

/// The components of a shape, in the order of its faces.
///
/// A face's scope has z along its normal. Where the face stands in the shape's scope, x is level
/// there and y points up; where it lies, x runs along its first edge. An edge's scope has x along
/// the edge and z along the mean of the normals of its faces, or, of the edges of each face, away from
/// the face; a vertex's is a point with z along the mean of the normals.
pub fn components(form: &Form, kind: Kind) -> Vec<Component> {
    match kind {
        Kind::Faces => faces(form),
        Kind::Edges => edges(form),
        Kind::FaceEdges => face_edges(form),
        Kind::Holes => holes(form),
        Kind::Vertices => vertices(form),
        Kind::FaceVertices => face_vertices(form),
        Kind::Groups | Kind::Materials => parts(form, kind),
    }
}

/// Whether a selector (`front`, `side`, `all`, ...) means a face of this direction; None where
/// there is no such selector.
pub fn is_selected(selector: &str, direction: Option<Direction>) -> Option<bool> {
    use Direction::{Back, Bottom, Front, Left, Right, Top};
    let is = |one: Direction| direction == Some(one);
    let lies = is(Top) || is(Bottom);
    Some(match selector {
        "all" => true,
        "front" => is(Front),
        "back" => is(Back),
        "left" => is(Left),
        "right" => is(Right),
        "top" => is(Top),
        "bottom" => is(Bottom),
        "side" => direction.is_some() && !lies,
        _ => return None,
    })
}

fn faces(form: &Form) -> Vec<Component> {
    let mesh = match &form.geometry {
        Geometry::Nothing => return Vec::new(),
        Geometry::Box => return box_faces(&form.scope),
        Geometry::Faces { mesh, .. } => std::borrow::Cow::Borrowed(mesh.as_ref()),
        other => std::borrow::Cow::Owned(other.mesh()),
    };
    mesh.faces()
        .enumerate()
        .filter_map(|(index, face)| face_component(&form.scope, &mesh, face, index))
        .collect()
}

fn face_component(scope: &Scope, mesh: &Mesh, face: Face<'_>, index: usize) -> Option<Component> {
    let world: Vec<Vec<DVec3>> = face
        .rings()
        .map(|ring| {
            ring.iter()
                .map(|&p| scope.world(mesh.points[p as usize]))
                .collect()
        })
        .collect();
    let alone = Mesh::polygon(&world);
    let normal = alone.face(0).normal();
    if normal == DVec3::ZERO {
        return None;
    }
    let along = world[0][1] - world[0][0];
    Some(Component {
        index,
        direction: Some(direction(scope.axes, normal)),
        normal,
        form: Form::around(alone, face_axes(scope.axes.y_axis, normal, along), false),
    })
}

/// The parts of an asset as its file has them; anything else is one part.
fn parts(form: &Form, kind: Kind) -> Vec<Component> {
    let split = match &form.geometry {
        Geometry::Instance(instance) => instance.parts(kind),
        _ => Vec::new(),
    };
    let whole = || (0, form.clone());
    let forms: Vec<(usize, Form)> = if split.is_empty() {
        vec![whole()]
    } else {
        let in_world = |mesh: Mesh| mesh.mapped(|unit| form.scope.world(unit));
        split
            .into_iter()
            .map(|(part, mesh)| {
                let solid = mesh.is_closed();
                (part, Form::around(in_world(mesh), form.scope.axes, solid))
            })
            .collect()
    };
    let component = |(index, form): (usize, Form)| {
        let normal = form.world_mesh().faces().next().map(Face::normal);
        Component {
            index,
            direction: normal.map(|normal| direction(form.scope.axes, normal)),
            normal: normal.unwrap_or(DVec3::ZERO),
            form,
        }
    };
    forms.into_iter().map(component).collect()
}

fn holes(form: &Form) -> Vec<Component> {
    let mesh = form.geometry.mesh();
    let mut filled = Mesh::with_points(mesh.points.clone());
    for ring in mesh.faces().flat_map(|face| face.rings().skip(1)) {
        filled.push_face(&[ring.iter().rev().copied().collect::<Vec<_>>()]);
    }
    filled
        .faces()
        .enumerate()
        .filter_map(|(index, face)| face_component(&form.scope, &filled, face, index))
        .collect()
}

/// The faces of a box without making its points: bottom, top, front, back, left, right.
fn box_faces(scope: &Scope) -> Vec<Component> {
    use Direction::{Back, Bottom, Front, Left, Right, Top};
    let order = [
        (Bottom, 1, -1.0),
        (Top, 1, 1.0),
        (Front, 2, 1.0),
        (Back, 2, -1.0),
        (Left, 0, -1.0),
        (Right, 0, 1.0),
    ];
    order
        .into_iter()
        .enumerate()
        .map(|(index, (direction, axis, sign))| Component {
            index,
            direction: Some(direction),
            normal: scope.axes.col(axis) * sign,
            form: box_face(scope, axis, sign),
        })
        .collect()
}

fn box_face(scope: &Scope, axis: usize, sign: f64) -> Form {
    let normal = scope.axes.col(axis) * sign;
    let axes = face_axes(scope.axes.y_axis, normal, scope.axes.x_axis);
    let local = axes.transpose();
    let low = rectangle(axis)
        .into_iter()
        .map(|mut corner| {
            corner[axis] = if sign > 0.0 { 1.0 } else { 0.0 };
            local * scope.world(corner)
        })
        .fold(DVec3::INFINITY, DVec3::min);
    let size = match axis {
        0 => DVec3::new(scope.size.z, scope.size.y, 0.0),
        1 => DVec3::new(scope.size.x, scope.size.z, 0.0),
        _ => DVec3::new(scope.size.x, scope.size.y, 0.0),
    };
    Form {
        scope: Scope {
            origin: axes * low,
            axes,
            size,
        },
        geometry: Geometry::Rectangle(2),
    }
}

/// Axes of a face: z outward; x level where the face stands, else along `along`.
fn face_axes(up: DVec3, normal: DVec3, along: DVec3) -> DMat3 {
    let level = up.cross(normal);
    let x = if level.length_squared() > TOLERANCE {
        level.normalize()
    } else {
        (along - normal * along.dot(normal)).normalize()
    };
    DMat3::from_cols(x, normal.cross(x), normal)
}

/// The axis of a frame that a normal is nearest to; a slope of 45 degrees still looks up.
pub fn direction(axes: DMat3, normal: DVec3) -> Direction {
    let own = axes.transpose() * normal;
    let size = own.abs();
    if size.y + TOLERANCE >= size.x.hypot(size.z) {
        return if own.y > 0.0 {
            Direction::Top
        } else {
            Direction::Bottom
        };
    }
    if size.z + TOLERANCE >= size.x {
        return if own.z > 0.0 {
            Direction::Front
        } else {
            Direction::Back
        };
    }
    if own.x > 0.0 {
        Direction::Right
    } else {
        Direction::Left
    }
}

fn edges(form: &Form) -> Vec<Component> {
    let mesh = form.world_mesh();
    let mut found: Vec<Component> = Vec::new();
    let mut known = HashMap::new();
    for face in mesh.faces() {
        let normal = face.normal();
        for (from, to) in face.edges() {
            let ends = (from.min(to), from.max(to));
            if let Some(&at) = known.get(&ends) {
                let edge: &mut Component = &mut found[at];
                edge.normal = (edge.form.scope.axes.z_axis + normal).normalize_or_zero();
                edge.direction = Some(direction(form.scope.axes, edge.normal));
                let up = form.scope.axes.y_axis;
                edge.form.scope = between_faces(&edge.form.scope, up, edge.normal);
                continue;
            }
            let (a, b) = (mesh.points[from as usize], mesh.points[to as usize]);
            if let Some(edge) = edge_component(form, a, b, normal, found.len()) {
                known.insert(ends, found.len());
                found.push(edge);
            }
        }
    }
    found
}

/// The scope of an edge between faces: z along the mean of their normals, and x upwards, where the edge
/// is not level.
fn between_faces(scope: &Scope, up: DVec3, normal: DVec3) -> Scope {
    let x = scope.axes.x_axis;
    let z = if normal == DVec3::ZERO {
        scope.axes.z_axis
    } else {
        normal
    };
    if x.dot(up) >= -TOLERANCE {
        return Scope {
            axes: frame_of(x, z),
            ..*scope
        };
    }
    Scope {
        origin: scope.world(DVec3::X),
        axes: frame_of(-x, z),
        size: scope.size,
    }
}

fn face_edges(form: &Form) -> Vec<Component> {
    let mesh = form.world_mesh();
    let mut found = Vec::new();
    let mut index = 0;
    for face in mesh.faces() {
        let normal = face.normal();
        for (from, to) in face.edges() {
            let (a, b) = (mesh.points[from as usize], mesh.points[to as usize]);
            found.extend(edge_component(form, a, b, normal, index).map(|mut edge| {
                let x = edge.form.scope.axes.x_axis;
                edge.form.scope.axes = frame_of(x, edge.normal);
                edge
            }));
            index += 1;
        }
    }
    found
}

/// Axes with x and, across it, z.
fn frame_of(x: DVec3, z: DVec3) -> DMat3 {
    DMat3::from_cols(x, z.cross(x), z)
}

/// An edge of a face: x along it, z along the normal of the face, y into the face.
fn edge_component(
    form: &Form,
    from: DVec3,
    to: DVec3,
    normal: DVec3,
    index: usize,
) -> Option<Component> {
    let x = (to - from).try_normalize()?;
    let scope = Scope {
        origin: from,
        axes: frame_of(x, normal),
        size: DVec3::new(from.distance(to), 0.0, 0.0),
    };
    let mut edge = without_faces(index, scope);
    edge.normal = x.cross(normal);
    edge.direction = Some(direction(form.scope.axes, edge.normal));
    Some(edge)
}

fn vertices(form: &Form) -> Vec<Component> {
    let mesh = form.world_mesh();
    let normals = point_normals(&mesh);
    let places = mesh.points.iter().zip(normals).enumerate();
    places
        .map(|(index, (&origin, normal))| vertex(form, origin, normal, index))
        .collect()
}

fn face_vertices(form: &Form) -> Vec<Component> {
    let mesh = form.world_mesh();
    let each = mesh.faces().flat_map(|face| {
        let corners = face.rings().flatten();
        let normal = face.normal();
        corners
            .map(move |&point| (point, normal))
            .collect::<Vec<_>>()
    });
    let found = each.enumerate();
    found
        .map(|(index, (point, normal))| vertex(form, mesh.points[point as usize], normal, index))
        .collect()
}

/// A place that looks along a normal: z along it, x level where the normal is not upright.
fn vertex(form: &Form, origin: DVec3, normal: DVec3, index: usize) -> Component {
    let axes = match normal == DVec3::ZERO {
        true => form.scope.axes,
        false => face_axes(form.scope.axes.y_axis, normal, form.scope.axes.x_axis),
    };
    let scope = Scope {
        origin,
        axes,
        size: DVec3::ZERO,
    };
    let mut vertex = without_faces(index, scope);
    vertex.normal = normal;
    vertex.direction = (normal != DVec3::ZERO).then(|| direction(form.scope.axes, normal));
    vertex
}

fn without_faces(index: usize, scope: Scope) -> Component {
    Component {
        index,
        direction: None,
        normal: DVec3::ZERO,
        form: Form {
            scope,
            geometry: Geometry::Nothing,
        },
    }
}
