//! A shape to its faces, edges or vertices, and which of them a selector means.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{Face, Mesh};

use super::form::{rectangle, Form, Geometry, TOLERANCE};
use super::scope::Scope;

/// What a shape is taken apart into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Faces,
    Edges,
    Vertices,
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

/// A component: its number, where it looks (only faces do), and its form.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    pub index: usize,
    pub direction: Option<Direction>,
    pub form: Form,
}

/// The components of a shape, in the order of its faces.
///
/// A face's scope has z along its normal. Where the face stands in the shape's scope, x is level
/// there and y points up; where it lies, x runs along its first edge. An edge's scope has x along
/// the edge, a vertex's is a point along the axes of the shape.
pub fn components(form: &Form, kind: Kind) -> Vec<Component> {
    match kind {
        Kind::Faces => faces(form),
        Kind::Edges => edges(form),
        Kind::Vertices => vertices(form),
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
        "side" | "vertical" => direction.is_some() && !lies,
        "horizontal" => lies,
        _ => return None,
    })
}

fn faces(form: &Form) -> Vec<Component> {
    let mesh = match &form.geometry {
        Geometry::Nothing => return Vec::new(),
        Geometry::Box => return box_faces(&form.scope),
        Geometry::Faces { mesh, .. } => std::borrow::Cow::Borrowed(mesh.as_ref()),
        Geometry::Rectangle(_) => std::borrow::Cow::Owned(form.geometry.mesh()),
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
        direction: Some(direction(scope, normal)),
        form: Form::around(alone, face_axes(scope.axes.y_axis, normal, along), false),
    })
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

/// The axis of the scope that a normal is nearest to; a slope of 45 degrees still looks up.
fn direction(scope: &Scope, normal: DVec3) -> Direction {
    let own = scope.axes.transpose() * normal;
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
    let mut seen = std::collections::HashSet::new();
    let mut found = Vec::new();
    for face in mesh.faces() {
        let normal = face.normal();
        for (from, to) in face.edges() {
            if !seen.insert((from.min(to), from.max(to))) {
                continue;
            }
            let (a, b) = (mesh.points[from as usize], mesh.points[to as usize]);
            let x = (b - a).normalize_or_zero();
            if x == DVec3::ZERO {
                continue;
            }
            let scope = Scope {
                origin: a,
                axes: DMat3::from_cols(x, normal.cross(x), normal),
                size: DVec3::new(a.distance(b), 0.0, 0.0),
            };
            found.push(without_faces(found.len(), scope));
        }
    }
    found
}

fn vertices(form: &Form) -> Vec<Component> {
    let mesh = form.world_mesh();
    mesh.points
        .iter()
        .enumerate()
        .map(|(index, &origin)| {
            let scope = Scope {
                origin,
                axes: form.scope.axes,
                size: DVec3::ZERO,
            };
            without_faces(index, scope)
        })
        .collect()
}

fn without_faces(index: usize, scope: Scope) -> Component {
    Component {
        index,
        direction: None,
        form: Form {
            scope,
            geometry: Geometry::Nothing,
        },
    }
}
