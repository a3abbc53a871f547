//! A surface as a camera sees it: the nearest triangle in the middle of each pixel.

use crate::view::Projection;

pub const NOTHING: i32 = -1;

/// Of each pixel, row by row, the triangle that is seen there, or NOTHING, and its depth (m).
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    pub triangles: Vec<i32>,
    pub depths_m: Vec<f32>,
}

/// Triangles that reach behind the camera are left out.
pub fn rasterise(
    projection: &Projection,
    [width, height]: [usize; 2],
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> Seen {
    let mut seen = Seen {
        triangles: vec![NOTHING; width * height],
        depths_m: vec![f32::INFINITY; width * height],
    };
    let placed: Vec<([f64; 2], f64)> = positions.iter().map(|at| projection.project(*at)).collect();
    for (number, triangle) in triangles.iter().enumerate() {
        let corners = triangle.map(|at| placed[at as usize]);
        if corners.iter().all(|corner| corner.1 > 0.0) {
            draw(&mut seen, [width, height], number as i32, corners);
        }
    }
    seen
}

fn draw(seen: &mut Seen, [width, height]: [usize; 2], number: i32, corners: [([f64; 2], f64); 3]) {
    let [a, b, c] = corners.map(|corner| corner.0);
    let area = cross(a, b, c);
    if area == 0.0 {
        return;
    }
    let span = |axis: usize, size: usize| {
        let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
        let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
        let first = low.ceil().max(0.0) as usize;
        first..((high.floor() + 1.0).max(0.0) as usize).min(size)
    };
    let inverse = corners.map(|corner| 1.0 / corner.1);
    for row in span(1, height) {
        for column in span(0, width) {
            let at = [column as f64 + 0.5, row as f64 + 0.5];
            let parts = [cross(b, c, at), cross(c, a, at), cross(a, b, at)].map(|one| one / area);
            if parts.iter().any(|part| *part < 0.0) {
                continue;
            }
            let depth = 1.0 / (0..3).map(|n| parts[n] * inverse[n]).sum::<f64>();
            let place = row * width + column;
            if (depth as f32) < seen.depths_m[place] {
                seen.depths_m[place] = depth as f32;
                seen.triangles[place] = number;
            }
        }
    }
}

fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearer_triangle_is_seen_and_its_pixels_are_counted() {
        let projection = Projection {
            rows: [
                [100.0, 0.0, 0.0, 0.0],
                [0.0, 100.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
            focal_px: 100.0,
            centre_m: [0.0; 3],
        };
        let square = |depth: f64, side: f64| {
            [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
                .map(|[x, y]| [x * depth, y * depth, depth])
        };
        let positions: Vec<[f64; 3]> = [square(2.0, 0.2), square(1.0, 0.1)].concat();
        let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let seen = rasterise(&projection, [30, 30], &positions, &triangles);
        let count = |of: fn(i32) -> bool| seen.triangles.iter().filter(|at| of(**at)).count();
        assert_eq!(count(|at| at >= 2), 100, "the near square");
        assert_eq!(count(|at| at >= 0), 400, "both");
        assert_eq!(seen.depths_m[0], 1.0);
    }
}
