//! The unit shapes that most derivations are made of.

use glam::DVec3;

use super::Mesh;

/// The unit square in the plane z = 0, seen from +z.
pub fn quad() -> Mesh {
    let corner = |x, y| DVec3::new(x, y, 0.0);
    let outline = [
        corner(0.0, 0.0),
        corner(1.0, 0.0),
        corner(1.0, 1.0),
        corner(0.0, 1.0),
    ];
    Mesh::polygon(&[outline])
}

/// The closed unit cube from the origin to (1, 1, 1): bottom and top (y), front and back (z),
/// left and right (x).
pub fn cube() -> Mesh {
    let mut mesh = Mesh::new();
    for corner in 0..8u32 {
        let at = |bit: u32| f64::from((corner >> bit) & 1);
        mesh.push_point(DVec3::new(at(0), at(1), at(2)));
    }
    for outline in [
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [4, 5, 7, 6],
        [0, 2, 3, 1],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ] {
        mesh.push_face(&[outline]);
    }
    mesh
}
