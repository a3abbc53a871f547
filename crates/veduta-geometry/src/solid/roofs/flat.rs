//! Flat roofs with a parapet around them.

use glam::DVec3;

use super::field::{field, Plane};
use crate::skeleton::{roof_within, Eaves, SkeletonError};
use crate::solid::inset::Rings;
use crate::solid::Mesh;
use crate::Budget;

/// How often the parapet is made a little thinner where what it leaves touches itself.
const ATTEMPTS: u32 = 8;

/// A level slab with a rim that is `width` wide and `parapet` high, both above a floor at 0.
pub fn flat(
    eaves: &Eaves,
    slab: f64,
    parapet: f64,
    width: f64,
    budget: &dyn Budget,
) -> Result<Mesh, SkeletonError> {
    let rings: Rings = (0..eaves.ring_count())
        .map(|ring| eaves.ring(ring).to_vec())
        .collect();
    let least = 1e-9 * parapet.max(slab);
    let mut attempt = 0;
    loop {
        let width = width * (1.0 - 0.01 * f64::from(attempt));
        let found = roof_within(eaves, Some(width), budget)?;
        let points = found.nodes_m.iter().map(|&[x, y, _]| DVec3::new(x, y, 0.0));
        let mut plan = Mesh::with_points(points.collect());
        let mut heights: Vec<Plane> = Vec::new();
        let rests = found.rest.iter().map(|rest| (&rest.rings, slab));
        for (rings, height) in found
            .faces
            .iter()
            .map(|face| (&face.rings, parapet))
            .chain(rests)
        {
            plan.push_face(rings);
            heights.push([0.0, 0.0, height]);
        }
        let mut inner: Vec<u32> = found.rest.iter().flat_map(|r| r.rings.concat()).collect();
        let count = inner.len();
        inner.sort_unstable();
        inner.dedup();
        attempt += 1;
        if inner.len() == count || attempt == ATTEMPTS {
            return Ok(field(&rings, &plan, &heights, least));
        }
    }
}
