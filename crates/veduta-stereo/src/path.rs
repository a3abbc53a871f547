//! The best path of disparities along a row: dynamic programming.

/// What a step of one disparity to the next pixel costs, and one of more, which costs no less.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    pub step: u16,
    pub jump: u16,
}

const SAME: u8 = 0;
const FROM_BELOW: u8 = 1;
const FROM_ABOVE: u8 = 2;
const JUMPED: u8 = 3;
/// What lies beside the least and the greatest disparity.
const NOWHERE: u16 = 1 << 15;

/// For each pixel, the disparity on the path of least cost. costs: `count` for each pixel.
pub fn best_path(costs: &[u16], count: usize, path: Path) -> Vec<usize> {
    let width = costs.len() / count;
    let mut came = vec![SAME; costs.len()];
    let mut jumps = vec![0_usize; width];
    // The sums of the pixel before, less their least, and one more to each side.
    let mut before = vec![NOWHERE; count + 2];
    let mut now = vec![NOWHERE; count + 2];
    before[1..=count].copy_from_slice(&costs[..count]);
    for x in 1..width {
        jumps[x] = settle(&mut before);
        let own = &costs[x * count..][..count];
        let came = &mut came[x * count..][..count];
        let (below, same, above) = (&before[..count], &before[1..=count], &before[2..]);
        let sums = &mut now[1..=count];
        for d in 0..count {
            let mut best = same[d];
            let mut way = SAME;
            let (up, down) = (below[d] + path.step, above[d] + path.step);
            way = if up < best { FROM_BELOW } else { way };
            best = best.min(up);
            way = if down < best { FROM_ABOVE } else { way };
            best = best.min(down);
            way = if path.jump < best { JUMPED } else { way };
            best = best.min(path.jump);
            sums[d] = own[d] + best;
            came[d] = way;
        }
        std::mem::swap(&mut before, &mut now);
    }
    let mut found = vec![0; width];
    let mut at = settle(&mut before);
    for x in (0..width).rev() {
        found[x] = at;
        at = match came[x * count + at] {
            FROM_BELOW => at - 1,
            FROM_ABOVE => at + 1,
            JUMPED => jumps[x],
            _ => at,
        };
    }
    found
}

/// Takes the least from all sums, and says which it was.
fn settle(sums: &mut [u16]) -> usize {
    let inner = 1..sums.len() - 1;
    let least = sums[inner.clone()].iter().copied().min().unwrap_or(0);
    sums[inner.clone()].iter_mut().for_each(|one| *one -= least);
    sums[inner].iter().position(|one| *one == 0).unwrap_or(0)
}
