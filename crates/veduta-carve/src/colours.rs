//! Colours of a surface's vertices, from the photos that see them best.

use rayon::prelude::*;

use crate::error::CarveError;
use crate::view::Photo;
use crate::visibility::DepthMap;

/// How views are chosen for a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourRule {
    /// The distance between vertices (m): so much of the picture each of them covers.
    pub spacing_m: f64,
    /// A view that sees the surface more slantingly than this cosine does not count.
    pub least_cosine: f64,
    /// The power of the cosine in a view's weight: how much straight views are preferred.
    pub power: f64,
    /// The best so many views are blended.
    pub views: usize,
}

/// Colours and, of each vertex, how many views gave it; those that no view sees take the mean of the
/// vertices around, again and again until all have one.
#[derive(Debug, Clone, PartialEq)]
pub struct Colours {
    pub rgb: Vec<[u8; 3]>,
    pub views: Vec<u16>,
}

#[derive(Clone)]
struct Seen {
    weight: f64,
    colour: [f32; 3],
}

pub fn colours(
    photos: &[Photo<'_>],
    positions: &[[f64; 3]],
    normals: &[[f64; 3]],
    triangles: &[[u32; 3]],
    rule: &ColourRule,
) -> Result<Colours, CarveError> {
    let mut each = photos.iter().enumerate();
    each.try_for_each(|(at, photo)| photo.check(at))?;
    let maps: Vec<DepthMap> = photos
        .par_iter()
        .map(|photo| {
            let size = [photo.width, photo.height];
            DepthMap::of_points(&photo.projection, size, positions, 0.75 * rule.spacing_m)
        })
        .collect();
    let found: Vec<(Option<[f32; 3]>, u16)> = positions
        .par_iter()
        .zip(normals)
        .map(|(at, normal)| of_vertex(photos, &maps, *at, *normal, rule))
        .collect();
    let views = found.iter().map(|one| one.1).collect();
    let mut rgb: Vec<Option<[f32; 3]>> = found.into_iter().map(|one| one.0).collect();
    spread(&mut rgb, triangles);
    let byte = |value: f32| value.round().clamp(0.0, 255.0) as u8;
    let plain = |one: Option<[f32; 3]>| one.unwrap_or([128.0; 3]).map(byte);
    Ok(Colours {
        rgb: rgb.into_iter().map(plain).collect(),
        views,
    })
}

fn of_vertex(
    photos: &[Photo<'_>],
    maps: &[DepthMap],
    at: [f64; 3],
    normal: [f64; 3],
    rule: &ColourRule,
) -> (Option<[f32; 3]>, u16) {
    let mut best: Vec<Seen> = Vec::with_capacity(rule.views + 1);
    let mut count = 0;
    for (photo, map) in photos.iter().zip(maps) {
        let Some(cosine) = facing(photo.projection.centre_m, at, normal) else {
            continue;
        };
        if cosine < rule.least_cosine {
            continue;
        }
        let (pixel, depth) = photo.projection.project(at);
        if depth <= 0.0 || !map.sees(pixel, depth, 2.0 * rule.spacing_m) {
            continue;
        }
        let Some(colour) = photo.colour(pixel) else {
            continue;
        };
        count += 1;
        let weight = cosine.powf(rule.power) / (depth * depth);
        let place = best.partition_point(|one| one.weight >= weight);
        best.insert(place, Seen { weight, colour });
        best.truncate(rule.views);
    }
    let sum: f64 = best.iter().map(|one| one.weight).sum();
    let mean = [0, 1, 2].map(|channel| {
        let of = |one: &Seen| one.weight * f64::from(one.colour[channel]);
        (best.iter().map(of).sum::<f64>() / sum) as f32
    });
    ((!best.is_empty()).then_some(mean), count)
}

/// The cosine between a normal and the way to the camera.
pub(crate) fn facing(centre: [f64; 3], at: [f64; 3], normal: [f64; 3]) -> Option<f64> {
    let way: [f64; 3] = std::array::from_fn(|axis| centre[axis] - at[axis]);
    let length = way.iter().map(|one| one * one).sum::<f64>().sqrt();
    let along: f64 = (0..3).map(|axis| way[axis] * normal[axis]).sum();
    (length > 0.0).then(|| along / length)
}

/// From vertices with a colour to those without, along the triangles.
fn spread(rgb: &mut [Option<[f32; 3]>], triangles: &[[u32; 3]]) {
    let mut open: Vec<[u32; 3]> = triangles.to_vec();
    loop {
        open.retain(|triangle| triangle.iter().any(|at| rgb[*at as usize].is_none()));
        let mut sums: std::collections::BTreeMap<u32, ([f32; 3], f32)> = Default::default();
        for triangle in &open {
            let known = triangle.iter().filter_map(|at| rgb[*at as usize]);
            let (mut sum, mut count) = ([0.0; 3], 0.0);
            for colour in known {
                (0..3).for_each(|channel| sum[channel] += colour[channel]);
                count += 1.0;
            }
            if count == 0.0 {
                continue;
            }
            for at in triangle.iter().filter(|at| rgb[**at as usize].is_none()) {
                let own = sums.entry(*at).or_default();
                (0..3).for_each(|channel| own.0[channel] += sum[channel]);
                own.1 += count;
            }
        }
        if sums.is_empty() {
            return;
        }
        for (at, (sum, count)) in sums {
            rgb[at as usize] = Some(sum.map(|one| one / count));
        }
    }
}
