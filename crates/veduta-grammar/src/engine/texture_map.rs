//! Where a texture lies: texture coordinates as a linear function of the place in the world.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::Mesh;

use crate::shape::{Form, Geometry, Scope};

use super::state::State;

/// The number of texture layers.
pub const LAYERS: usize = 10;
/// Along a face that looks along the growth of a coordinate but for this share, it does not grow.
const ACROSS: f64 = 1e-6;

/// Texture coordinates of places in the world (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureMap {
    /// How u and v grow, per metre.
    pub grow: [DVec3; 2],
    /// u and v at the world's origin.
    pub offset: [f64; 2],
}

impl TextureMap {
    /// u and v grow along these, and are 0 at the origin.
    pub fn from(origin: DVec3, grow: [DVec3; 2]) -> Self {
        Self {
            grow,
            offset: grow.map(|along| -along.dot(origin)),
        }
    }

    /// The map that a shape has by itself: shares of its scope.
    pub fn of_scope(form: &Form) -> Self {
        let (u, v) = axes_of(form);
        let along = |axis: usize| {
            let size = form.scope.size[axis];
            if size > 0.0 {
                form.scope.axes.col(axis) / size
            } else {
                DVec3::ZERO
            }
        };
        Self::from(form.scope.origin, [along(u), along(v)])
    }

    /// Whether its coordinates stay within single precision.
    pub fn is_sound(&self) -> bool {
        let grows = |along: &DVec3| along.abs().max_element() <= 1e20;
        self.grow.iter().all(grows) && self.offset.iter().all(|offset| offset.abs() <= 1e32)
    }

    pub fn at(&self, place: DVec3) -> [f64; 2] {
        [0, 1].map(|axis| self.grow[axis].dot(place) + self.offset[axis])
    }

    /// The coordinates multiplied and then moved.
    pub fn changed(&self, by: [f64; 2], moved: [f64; 2]) -> Self {
        Self {
            grow: [self.grow[0] * by[0], self.grow[1] * by[1]],
            offset: [0, 1].map(|axis| self.offset[axis] * by[axis] + moved[axis]),
        }
    }

    /// The coordinates turned about (0, 0), counter-clockwise (degrees).
    pub fn turned(&self, degrees: f64) -> Self {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let [u, v] = self.grow;
        let [a, b] = self.offset;
        Self {
            grow: [u * cosine - v * sine, u * sine + v * cosine],
            offset: [a * cosine - b * sine, a * sine + b * cosine],
        }
    }

    /// The least and the greatest u (0) or v (1) of these places (m); 0 and 0 of none.
    pub fn range(&self, axis: usize, places: &[DVec3]) -> (f64, f64) {
        let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
        for &place in places {
            let value = self.at(place)[axis];
            ends = (ends.0.min(value), ends.1.max(value));
        }
        if ends.0 <= ends.1 {
            ends
        } else {
            (0.0, 0.0)
        }
    }

    /// How many metres of a surface one unit of u (0) or v (1) covers: by the mean growth per metre of
    /// its faces. Those that it hardly grows along, as the ends of a cylinder's side do, say little.
    pub fn stretch(&self, axis: usize, mesh: &Mesh) -> f64 {
        let grow = self.grow[axis];
        let (mut sum, mut area) = (0.0, 0.0);
        for face in mesh.faces() {
            let vector = face.area_vector();
            let own = vector.length();
            if own > 0.0 {
                let normal = vector / own;
                let per_metre = (grow - normal * grow.dot(normal)).length();
                if per_metre > ACROSS * grow.length() {
                    sum += own * per_metre;
                    area += own;
                }
            }
        }
        if area > 0.0 {
            area / sum
        } else {
            0.0
        }
    }

    /// The map on what has been moved with its scope.
    pub fn carried(&self, before: &Scope, after: &Scope) -> Self {
        let filled = |size: DVec3| {
            DVec3::from_array(size.to_array().map(|s| if s == 0.0 { 1.0 } else { s }))
        };
        let (old, new) = (filled(before.size), filled(after.size));
        // A place after, as one before: back to shares of the scope, and out again.
        let back: DMat3 = before.axes * DMat3::from_diagonal(old / new) * after.axes.transpose();
        self.moved_back(back, before.origin - back * after.origin)
    }

    /// The map on what has been mirrored in the middle of its scope.
    pub fn mirrored(&self, scope: &Scope, signs: DVec3) -> Self {
        let back = scope.axes * DMat3::from_diagonal(signs) * scope.axes.transpose();
        let middle = scope.world(DVec3::splat(0.5));
        self.moved_back(back, middle - back * middle)
    }

    /// The map on what was at `back * place + at_origin` before.
    fn moved_back(&self, back: DMat3, at_origin: DVec3) -> Self {
        Self {
            grow: self.grow.map(|along| back.transpose() * along),
            offset: [0, 1].map(|axis| self.offset[axis] + self.grow[axis].dot(at_origin)),
        }
    }
}

/// The axes of the scope along which u and v grow where nothing else is said: x and y, or, of
/// what is flat, the two that it lies in.
pub fn axes_of(form: &Form) -> (usize, usize) {
    let flat = match form.geometry {
        Geometry::Rectangle(axis) => Some(axis),
        _ => {
            let mut flat = (0..3).filter(|&axis| form.scope.size[axis] == 0.0);
            flat.next().filter(|_| flat.next().is_none())
        }
    };
    flat.map_or((0, 1), |axis| ((axis + 1) % 3, (axis + 2) % 3))
}

/// The number of a texture layer.
pub fn layer(number: f64) -> Result<usize, String> {
    let found = (0..LAYERS).find(|&layer| layer as f64 == number);
    found.ok_or_else(|| format!("there is no texture layer {number}: 0 to {}", LAYERS - 1))
}

/// The map of a layer of a shape.
pub fn map_of(state: &State, number: f64) -> Result<TextureMap, String> {
    let layer = layer(number)?;
    let own = state.extra.as_ref().and_then(|extra| extra.maps[layer]);
    Ok(own.unwrap_or_else(|| TextureMap::of_scope(&state.form)))
}
