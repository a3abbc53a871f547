//! Union, difference and intersection of meshes, and where one lies to another.
//!
//! The faces of both are cut along where they meet (`cuts`), each face becomes the regions
//! between its cuts (`regions`), and each region lies in, out of, or on the other mesh (`sides`): by
//! its winding number, which is a sum over all faces and knows no unlucky rays (Jacobson, Kavan and
//! Sorkine-Hornung 2013, eq. 5). Places nearer to each other than [`NEAR`] of the extent are one
//! before anything is decided, so that both faces at an edge decide alike and closed meshes give
//! closed ones.

mod cuts;
mod flat;
mod regions;
mod result;
mod sides;

use glam::DVec3;

use super::mesh::Mesh;
use crate::{Budget, Spent, Unlimited};
use cuts::Cuts;
use flat::Polygon;

/// How far places may lie apart and still be one, as a share of the extent of both meshes.
const NEAR: f64 = 1e-9;

/// How near that is taken to be where closed meshes gave an open one: in turn.
const OTHERS_NEAR: [f64; 3] = [1e-8, 1e-7, 1e-10];

/// How far the second mesh is moved, where none of these gave a closed one: in turn, as shares of
/// the extent. Faces that were neither one nor apart are apart then.
const MOVES: [f64; 4] = [6.4e-8, 2.6e-7, 1e-6, 4e-6];

/// The share of the volume of both meshes that may be rounding.
const VOLUME: f64 = 1e-5;

/// The most pairs of faces that are looked at, and of cuts within one face.
const MOST_PAIRS: usize = 100_000_000;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boolean {
    Union,
    /// The first without the second.
    Subtract,
    Intersect,
}

/// Where a region of one mesh lies to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    In,
    Out,
    /// On a face of the other that looks the same way.
    Same,
    /// On a face of the other that looks the opposite way.
    Opposite,
}

/// Why two meshes cannot be combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum BooleanError {
    #[error("shapes of {a} and {b} faces are too many to be combined")]
    TooManyFaces { a: usize, b: usize },
    /// Closed meshes gave an open one: faces lie nearer to each other than can be told apart.
    #[error("the shapes lie too near to each other to be told apart; move one by a millimetre")]
    Unclear,
    #[error(transparent)]
    Spent(#[from] Spent),
}

/// A part of a face with its place to the other mesh.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Region {
    pub rings: Vec<Vec<u32>>,
    pub face: usize,
    pub side: Side,
    /// Its area, in the unit of the meshes.
    pub area: f64,
}

/// Two meshes cut along each other: their common points, and the regions of each.
pub(super) struct Overlay {
    pub points: Vec<DVec3>,
    pub regions: [Vec<Region>; 2],
    /// The normals of the faces of each.
    pub normals: [Vec<DVec3>; 2],
}

fn overlay(a: &Mesh, b: &Mesh, near: f64, budget: &dyn Budget) -> Result<Overlay, BooleanError> {
    let too_many = BooleanError::TooManyFaces {
        a: a.face_count(),
        b: b.face_count(),
    };
    if a.face_count().saturating_mul(b.face_count()) > MOST_PAIRS {
        return Err(too_many);
    }
    let mut cuts = Cuts::new(a, b, near);
    cuts.meet(budget)?;
    if !cuts.divide(budget)? {
        return Err(too_many);
    }
    Ok(Overlay {
        regions: [
            regions::of(&cuts, 0, budget)?,
            regions::of(&cuts, 1, budget)?,
        ],
        normals: [0, 1].map(|which| cuts.polygons[which].iter().map(Polygon::normal).collect()),
        points: cuts.points,
    })
}

/// The two meshes as one (`a` is the first). Of closed meshes, the result is closed; of an open
/// mesh and a closed one, it is what is in or out of the closed one of the open, and all faces of
/// both for a union; of two that lie in one plane, it is in that plane.
pub fn boolean(a: &Mesh, b: &Mesh, operation: Boolean) -> Result<Combined, BooleanError> {
    boolean_within(a, b, operation, &Unlimited)
}

/// [`boolean`] within a budget.
pub fn boolean_within(
    a: &Mesh,
    b: &Mesh,
    operation: Boolean,
    budget: &dyn Budget,
) -> Result<Combined, BooleanError> {
    let closed = [a.is_closed(), b.is_closed()];
    let made = |b: &Mesh, near: f64| -> Result<Combined, BooleanError> {
        let overlay = overlay(a, b, near, budget)?;
        Ok(result::of(&overlay, operation, closed))
    };
    let first = made(b, NEAR)?;
    if closed != [true; 2] || is_sound(a, b, operation, &first.mesh) {
        return Ok(first);
    }
    for near in OTHERS_NEAR {
        let found = made(b, near)?;
        if is_sound(a, b, operation, &found.mesh) {
            return Ok(found);
        }
    }
    for (share, turn) in MOVES.into_iter().zip(0u8..) {
        let angle = 1.0 + 2.4 * f64::from(turn);
        let direction = DVec3::new(angle.cos(), angle.sin(), 0.6180);
        let by = share * extent(a, b) * direction;
        let found = made(&b.clone().mapped(|point| point + by), NEAR)?;
        if is_sound(a, b, operation, &found.mesh) {
            return Ok(found);
        }
    }
    // A mesh that overlaps itself has more volume than it fills: there, closed has to do.
    if first.mesh.is_closed() {
        return Ok(first);
    }
    Err(BooleanError::Unclear)
}

/// How large two meshes are together.
fn extent(a: &Mesh, b: &Mesh) -> f64 {
    let [(low_a, high_a), (low_b, high_b)] = [a, b].map(|mesh| mesh.bounds().unwrap_or_default());
    low_a.min(low_b).distance(high_a.max(high_b))
}

/// Whether what closed meshes gave is closed, and has a volume that it can have. Meshes whose faces
/// look inwards have no volume to tell from.
fn is_sound(a: &Mesh, b: &Mesh, operation: Boolean, made: &Mesh) -> bool {
    if !made.is_empty() && !made.is_closed() {
        return false;
    }
    let [first, second, volume] = [a, b, made].map(Mesh::volume);
    let near = VOLUME * (first + second);
    let (least, most) = match operation {
        Boolean::Union => (first.max(second), first + second),
        Boolean::Subtract => (first - second, first),
        Boolean::Intersect => (0.0, first.min(second)),
    };
    let told = first > 0.0 && second > 0.0;
    !told || (least - near..=most + near).contains(&volume)
}

/// What [`boolean`] makes.
#[derive(Debug, Clone, PartialEq)]
pub struct Combined {
    pub mesh: Mesh,
    /// For each face whether it is of the second mesh, and the number of the face there.
    pub sources: Vec<(bool, usize)>,
}

/// How much of a mesh lies where to another, and of the other to it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Relation {
    /// Shares of the area of the first mesh: in, out of, on faces of the second that look the same
    /// way, on those that look the opposite way.
    pub first: [f64; 4],
    /// The same of the second mesh.
    pub second: [f64; 4],
}

/// How two meshes lie to each other.
pub fn relation(a: &Mesh, b: &Mesh, budget: &dyn Budget) -> Result<Relation, BooleanError> {
    let overlay = overlay(a, b, NEAR, budget)?;
    let shares = |regions: &[Region]| {
        let mut sums = [0.0; 4];
        for region in regions {
            sums[region.side as usize] += region.area;
        }
        let whole: f64 = sums.iter().sum();
        sums.map(|sum| if whole > 0.0 { sum / whole } else { 0.0 })
    };
    Ok(Relation {
        first: shares(&overlay.regions[0]),
        second: shares(&overlay.regions[1]),
    })
}
