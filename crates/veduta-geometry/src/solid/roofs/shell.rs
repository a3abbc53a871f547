//! Roofs whose height depends on the distance to the eaves: skeletons cut level and bent.

use glam::DVec3;

use super::profile::Profile;
use crate::skeleton::{Eaves, FaceOrigin, Roof};
use crate::solid::cut::scored;
use crate::solid::loops::close_in_plane;
use crate::solid::Mesh;

/// Levels nearer to each other than this, as a share of the diagonal, are one.
const SAME_LEVEL_SHARE: f64 = 1e-9;

/// The faces of a roof without a floor; x and y, and the time of the wavefront as z.
pub struct Shell<'a> {
    eaves: &'a Eaves,
    pub mesh: Mesh,
    upright: Vec<bool>,
}

impl<'a> Shell<'a> {
    pub fn of(eaves: &'a Eaves, found: &Roof) -> Self {
        let points = found.nodes_m.iter().map(|&p| DVec3::from_array(p));
        let mut mesh = Mesh::with_points(points.collect());
        let mut upright = Vec::with_capacity(found.faces.len());
        for face in &found.faces {
            mesh.push_face(&face.rings);
            upright.push(match face.origin {
                FaceOrigin::Edge(edge) => eaves.speeds()[edge as usize] == 0.0,
                FaceOrigin::Step { .. } => true,
            });
        }
        Self {
            eaves,
            mesh,
            upright,
        }
    }

    /// How far the ridge that is farthest from the eaves is.
    pub fn deepest(&self) -> f64 {
        self.mesh.points.iter().map(|p| p.z).fold(0.0, f64::max)
    }

    fn scored(&self, levels: impl Iterator<Item = f64>) -> Mesh {
        let deepest = self.deepest();
        let near = SAME_LEVEL_SHARE * self.eaves.diagonal_m();
        let within = |&level: &f64| level > near && level < deepest - near;
        let levels: Vec<f64> = levels.filter(within).collect();
        let whole = |face: u32| self.upright[face as usize];
        scored(&self.mesh, 2, &levels, near, whole).0
    }

    /// Closed by a floor at height 0, with `height` over each place instead of the time.
    pub fn closed(&self, height: impl Fn(DVec3) -> f64) -> Mesh {
        self.bent(self.mesh.clone(), height)
    }

    /// Closed by a floor, with the height that the profile has over the distance to the eaves.
    pub fn profiled(&self, profile: &Profile) -> Mesh {
        self.bent(self.scored(profile.levels()), |p| profile.height(p.z))
    }

    fn bent(&self, mesh: Mesh, height: impl Fn(DVec3) -> f64) -> Mesh {
        let mut solid = mesh.mapped(|p| DVec3::new(p.x, p.y, height(p)));
        let mut floor = Vec::with_capacity(self.eaves.ring_count());
        let mut first = 0;
        for ring in 0..self.eaves.ring_count() {
            let end = first + self.eaves.ring(ring).len() as u32;
            floor.push((first..end).rev().collect::<Vec<_>>());
            first = end;
        }
        solid.push_face(&floor);
        solid
    }

    /// A roof that bulges over its foot: up to `neck` from the eaves there is a second surface
    /// below, from the floor up to the eaves at the height `belly`. The profile begins there.
    pub fn bulging(&self, profile: &Profile, neck: f64, belly: f64) -> Mesh {
        let near = SAME_LEVEL_SHARE * self.eaves.diagonal_m();
        let neck = self.beside_nodes(neck, 1e3 * near);
        let mut levels: Vec<f64> = profile.levels().chain([neck]).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|a, b| *a - *b <= 4.0 * near);
        let sheet = self.scored(levels.into_iter());
        let mut solid = Mesh::with_points(Vec::with_capacity(2 * sheet.points.len()));
        let mut below: Vec<u32> = Vec::with_capacity(sheet.points.len());
        for point in &sheet.points {
            let height = belly + profile.height(point.z);
            solid.push_point(DVec3::new(point.x, point.y, height));
        }
        for (number, point) in sheet.points.iter().enumerate() {
            let height = belly * (1.0 - point.z / neck);
            below.push(if point.z <= 0.0 {
                number as u32
            } else {
                let height = if (point.z - neck).abs() <= near {
                    0.0
                } else {
                    height
                };
                solid.push_point(DVec3::new(point.x, point.y, height))
            });
        }
        let mut underside = Vec::new();
        for face in sheet.faces() {
            let rings: Vec<Vec<u32>> = face.rings().map(<[u32]>::to_vec).collect();
            solid.push_face(&rings);
            if face.points().all(|p| p.z <= neck + near) {
                let turned = |ring: &Vec<u32>| -> Vec<u32> {
                    ring.iter().rev().map(|&p| below[p as usize]).collect()
                };
                underside.push(rings.iter().map(turned).collect::<Vec<_>>());
            }
        }
        let points = solid.points.clone();
        let on_floor = |p: u32| points[p as usize].z == 0.0;
        let rings = underside.iter().flatten();
        let floor = close_in_plane(&points, rings, on_floor, DVec3::NEG_Z);
        for face in underside.iter().chain(&floor) {
            solid.push_face(face);
        }
        solid.compact()
    }

    /// A level near to the one wanted that no node lies at.
    fn beside_nodes(&self, wanted: f64, apart: f64) -> f64 {
        let is_free = |level: f64| self.mesh.points.iter().all(|p| (p.z - level).abs() > apart);
        let nearby = (0..64).map(|k| wanted * (1.0 - 0.003 * f64::from(k)));
        nearby
            .into_iter()
            .find(|&level| is_free(level))
            .unwrap_or(wanted)
    }
}
