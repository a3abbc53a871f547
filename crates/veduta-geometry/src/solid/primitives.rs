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

/// A level regular polygon in the unit square of x and z, seen from above (+y). Its corners lie on
/// the circle that touches the sides of the square.
pub fn disk(sides: usize) -> Mesh {
    let outline: Vec<DVec3> = (0..sides).map(|k| rim(k, sides, 0.0)).collect();
    Mesh::polygon(&[outline])
}

/// A closed upright prism over [`disk`], from y = 0 to 1.
pub fn cylinder(sides: usize) -> Mesh {
    super::extrude(&disk(sides), DVec3::Y)
}

/// A closed upright cone over [`disk`], its tip at y = 1.
pub fn cone(sides: usize) -> Mesh {
    super::pyramids(&disk(sides), |_| DVec3::new(0.5, 1.0, 0.5))
}

/// A closed sphere in the unit cube: `sides` around the y axis, `rows` from pole to pole.
pub fn sphere(sides: usize, rows: usize) -> Mesh {
    let mut mesh = Mesh::new();
    let bottom = mesh.push_point(DVec3::new(0.5, 0.0, 0.5));
    let top = mesh.push_point(DVec3::new(0.5, 1.0, 0.5));
    let number = |row: usize, side: usize| 2 + ((row - 1) * sides + side % sides) as u32;
    for row in 1..rows {
        let angle = std::f64::consts::PI * row as f64 / rows as f64;
        for side in 0..sides {
            let point = rim(side, sides, 0.5 - 0.5 * angle.cos());
            let centre = DVec3::new(0.5, point.y, 0.5);
            mesh.push_point(centre + (point - centre) * angle.sin());
        }
    }
    for side in 0..sides {
        mesh.push_face(&[[bottom, number(1, side + 1), number(1, side)]]);
        for row in 1..rows - 1 {
            let (low, high) = (number(row, side), number(row + 1, side));
            let (low_next, high_next) = (number(row, side + 1), number(row + 1, side + 1));
            mesh.push_face(&[[low, low_next, high_next, high]]);
        }
        mesh.push_face(&[[number(rows - 1, side), number(rows - 1, side + 1), top]]);
    }
    mesh
}

/// Corner `k` of a regular polygon around the middle of the unit square, counter-clockwise seen
/// from above.
fn rim(k: usize, sides: usize, y: f64) -> DVec3 {
    let angle = std::f64::consts::TAU * k as f64 / sides as f64;
    DVec3::new(0.5 + 0.5 * angle.cos(), y, 0.5 - 0.5 * angle.sin())
}
