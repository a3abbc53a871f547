//! Where a texture of a known size lies by itself, as a mason would lay it.

use glam::DVec3;

use super::texture_map::TextureMap;

/// Faces that are this near to level have no direction up the slope (sine).
const LEVEL: f64 = 1e-3;

/// The map of a face with this unit normal (y up): u grows to the right as seen from outside, level;
/// v up the face, in tiles of `size` (m). It counts from the lot's origin, so that courses go on from
/// one face to the next in the same plane. What lies level has u to the east and v to the north.
pub fn laid(normal: DVec3, size: [f64; 2]) -> TextureMap {
    let level = DVec3::Y.cross(normal);
    let right = if level.length() > LEVEL {
        level.normalize()
    } else {
        DVec3::X
    };
    let up = normal.cross(right).normalize_or_zero();
    TextureMap::from(DVec3::ZERO, [right / size[0], up / size[1]])
}

/// The unit normal of a ring; zero where it encloses nothing.
pub fn normal(ring: &[DVec3]) -> DVec3 {
    let from = ring.first().copied().unwrap_or_default();
    let pairs = ring.iter().zip(ring.iter().skip(1));
    let sum: DVec3 = pairs.map(|(a, b)| (*a - from).cross(*b - from)).sum();
    sum.normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [f64; 2] = [2.0, 0.5];

    #[test]
    fn a_wall_has_u_along_it_and_v_up() {
        // It looks south; rule files have z to the south.
        let map = laid(DVec3::Z, SIZE);
        assert_eq!(map.at(DVec3::new(3.0, 1.0, 9.0)), [1.5, 2.0]);
        // One that looks north runs the other way, as it is seen from outside.
        let map = laid(DVec3::NEG_Z, SIZE);
        assert_eq!(map.at(DVec3::new(3.0, 1.0, 9.0)), [-1.5, 2.0]);
    }

    #[test]
    fn a_slope_is_measured_along_itself() {
        let map = laid(DVec3::new(0.0, 0.8, 0.6), SIZE);
        let eaves = DVec3::new(1.0, 0.0, 0.0);
        // 5 m up a slope of 3 in 4 is 4 m back and 3 m up.
        let above = eaves + DVec3::new(0.0, 3.0, -4.0);
        let [u, v] = map.at(above);
        let [u0, v0] = map.at(eaves);
        assert!((u - u0).abs() < 1e-12 && (v - v0 - 10.0).abs() < 1e-12);
    }

    #[test]
    fn what_lies_level_looks_north() {
        let map = laid(DVec3::Y, SIZE);
        assert_eq!(map.at(DVec3::new(3.0, 1.0, -2.0)), [1.5, 4.0]);
    }

    #[test]
    fn the_normal_of_a_ring_is_that_of_its_plane() {
        let ring =
            [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 0.2)].map(|(x, y)| DVec3::new(x, y, 5.0));
        assert_eq!(normal(&ring), DVec3::Z);
        assert_eq!(normal(&ring[..2]), DVec3::ZERO);
    }
}
