//! One point for what several depth maps show of the same spot.

use crate::camera::{back, dot};
use crate::consistent::{Agreement, Depths};

/// What a view tells besides depths: normals in the camera's frame, and colours.
pub struct Shown<'a> {
    pub depths: Depths<'a>,
    pub normals: &'a [[f32; 3]],
    pub colours: &'a [[u8; 3]],
}

#[derive(Default)]
pub struct Cloud {
    pub points: Vec<[f64; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub colours: Vec<[u8; 3]>,
    /// How many views show each point.
    pub views: Vec<u8>,
}

/// The points of the first view that no earlier one made, and the pixels of each view that went into
/// them: a pixel that went into a point makes no other.
///
/// used: of each view, the pixels that earlier points have. least: views that must agree.
pub fn fuse(
    shown: &[Shown<'_>],
    used: &[Vec<bool>],
    agreement: Agreement,
    least: u8,
) -> (Cloud, Vec<Vec<u32>>) {
    let mut cloud = Cloud::default();
    let mut taken: Vec<Vec<u32>> = vec![Vec::new(); shown.len()];
    let Some((own, others)) = shown.split_first() else {
        return (cloud, taken);
    };
    let mut met = Vec::with_capacity(shown.len());
    for y in 0..own.depths.height {
        for x in 0..own.depths.width {
            let i = y * own.depths.width + x;
            let Some(depth) = own.depths.depth(x, y).filter(|_| !used[0][i]) else {
                continue;
            };
            met.clear();
            met.push((0, i));
            for (n, other) in others.iter().enumerate() {
                let there = &other.depths;
                if let Some((u, v)) = agreement.seen_by(&own.depths, (x, y), depth, there) {
                    met.push((n + 1, v * there.width + u));
                }
            }
            if met.len() >= usize::from(least) {
                cloud.add(shown, &met);
                for &(view, at) in &met {
                    taken[view].push(at as u32);
                }
            }
        }
    }
    (cloud, taken)
}

impl Cloud {
    /// The mean of what the pixels (view, index) show.
    fn add(&mut self, shown: &[Shown<'_>], met: &[(usize, usize)]) {
        let (mut point, mut normal, mut colour) = ([0.0f64; 3], [0.0f64; 3], [0.0f64; 3]);
        for &(view, at) in met {
            let one = &shown[view];
            let (x, y) = (at % one.depths.width, at / one.depths.width);
            let depth = f64::from(one.depths.depths[at]);
            let own = one.depths.camera.point(Depths::centre(x, y), depth);
            let turned = back(&one.depths.camera.turn, one.normals[at].map(f64::from));
            for axis in 0..3 {
                point[axis] += own[axis];
                normal[axis] += turned[axis];
                colour[axis] += f64::from(one.colours[at][axis]);
            }
        }
        let count = met.len() as f64;
        let length = dot(normal, normal).sqrt().max(1e-9);
        self.points.push(point.map(|one| one / count));
        self.normals.push(normal.map(|one| (one / length) as f32));
        self.colours
            .push(colour.map(|one| (one / count).round() as u8));
        self.views.push(met.len().min(255) as u8);
    }
}
