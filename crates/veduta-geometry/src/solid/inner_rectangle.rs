//! The largest upright rectangle within a polygon.

/// Lines across the polygon that are tried besides those through its vertices.
const LINES: usize = 48;

/// Lower left and upper right corner of a rectangle along x and y within a polygon (the outline
/// first, then holes). It is the largest whose left and right sides run through vertices or on one
/// of 48 lines between; of polygons with right angles along x and y it is the largest of all.
/// Polygons of more than 400 vertices have none, nor have those in which none was found.
pub fn inner_rectangle(rings: &[Vec<[f64; 2]>]) -> Option<([f64; 2], [f64; 2])> {
    let mut places: Vec<f64> = rings.iter().flatten().map(|point| point[0]).collect();
    if places.len() > 400 || places.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    places.extend((1..LINES).map(|k| low + (high - low) * k as f64 / LINES as f64));
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| *a - *b <= 1e-9 * (high - low));
    let slabs: Vec<Vec<[f64; 2]>> = places
        .windows(2)
        .map(|pair| gaps(rings, pair[0], pair[1]))
        .collect();
    let mut best = None;
    let mut most = 0.0;
    for start in 0..slabs.len() {
        let mut open = slabs[start].clone();
        for end in start..slabs.len() {
            if end > start {
                open = common(&open, &slabs[end]);
            }
            for gap in &open {
                let area = (places[end + 1] - places[start]) * (gap[1] - gap[0]);
                if area > most {
                    most = area;
                    best = Some(([places[start], gap[0]], [places[end + 1], gap[1]]));
                }
            }
            if open.is_empty() {
                break;
            }
        }
    }
    best
}

/// The heights between which the polygon is free all the way from `left` to `right`; no vertex
/// lies between the two.
fn gaps(rings: &[Vec<[f64; 2]>], left: f64, right: f64) -> Vec<[f64; 2]> {
    let mut crossed: Vec<[f64; 2]> = Vec::new();
    let middle = 0.5 * (left + right);
    for ring in rings {
        for (k, &a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            if (a[0] > middle) != (b[0] > middle) {
                let at = |x: f64| a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
                crossed.push([at(left), at(right)]);
            }
        }
    }
    crossed.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
    crossed
        .chunks_exact(2)
        .map(|pair| [pair[0][0].max(pair[0][1]), pair[1][0].min(pair[1][1])])
        .filter(|gap| gap[1] > gap[0])
        .collect()
}

/// What two lists of gaps in rising order have in common.
fn common(one: &[[f64; 2]], other: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    let (mut ones, mut others) = (one.iter().peekable(), other.iter().peekable());
    while let (Some(a), Some(b)) = (ones.peek(), others.peek()) {
        let gap = [a[0].max(b[0]), a[1].min(b[1])];
        if gap[1] > gap[0] {
            found.push(gap);
        }
        if a[1] < b[1] {
            ones.next();
        } else {
            others.next();
        }
    }
    found
}
