//! The run of a wavefront from the eaves to the top, or to a height to stop at.

use super::corner::{Corner, Meeting};
use super::double_double::Dd;
use super::eaves::ring_area_m2;
use super::events::{Event, Happening, Queue, STEPS_PER_PAIR};
use super::front::Front;
use super::tolerance::{PARALLEL, SAME_NODE_SHARE};
use super::SkeletonError;
use crate::Budget;

/// A part of the wavefront that is left: its nodes, the inside to the left.
pub type Rest = Vec<u32>;

/// Moves the wavefront until nothing is left of it, or until `stop`. Gives what is left.
///
/// `last` is a time by which every wavefront that ends has ended.
pub fn sweep(
    front: &mut Front,
    stop: Option<f64>,
    last: f64,
    diagonal_m: f64,
    budget: &dyn Budget,
) -> Result<Vec<Rest>, SkeletonError> {
    // What happens a hair after the stop belongs to the same event as what happens a hair before.
    let until = stop.map_or(last, |time| last.min(time * (1.0 + 1e-12)));
    let most = 64 + 16 * front.corners.len();
    let mut queue = Queue::new(front.corners.len(), until, diagonal_m);
    queue.fill(front, budget)?;
    let mut events = 0;
    while let Some(event) = queue.pop() {
        if is_void(front, event.what) {
            continue;
        }
        events += 1;
        if events > most {
            return Err(SkeletonError::TooManyEvents { most });
        }
        budget.take(STEPS_PER_PAIR * (front.alive().len() + 8))?;
        apply(front, &mut queue, event)?;
    }
    chains(front)
        .into_iter()
        .map(|chain| match stop {
            Some(time) => Ok(cut(front, &chain, time)),
            None => shaft(front, &chain, diagonal_m),
        })
        .collect()
}

/// The closed chains of corners that are alive, each from its lowest number.
fn chains(front: &Front) -> Vec<Vec<u32>> {
    let mut seen = vec![false; front.corners.len()];
    let mut open: Vec<u32> = front.alive().to_vec();
    open.sort_unstable();
    let mut found = Vec::new();
    for first in open {
        let mut chain = Vec::new();
        let mut corner = first;
        while !std::mem::replace(&mut seen[corner as usize], true) {
            chain.push(corner);
            corner = front.corner(corner).next;
        }
        if !chain.is_empty() {
            found.push(chain);
        }
    }
    found
}

/// Closes a shaft between standing faces that is there only because lines were moved a hair: in
/// truth the faces meet. A wider one has no top.
fn shaft(front: &mut Front, chain: &[u32], diagonal_m: f64) -> Result<Rest, SkeletonError> {
    let mut time: f64 = 0.0;
    let mut ring = Vec::with_capacity(chain.len());
    for &id in chain {
        let corner = front.corner(id);
        time = time.max(corner.quick().time);
        ring.push(corner.quick().place);
        let face = corner.after as usize;
        if front.planes[face].speed > 0.0 {
            return Err(SkeletonError::Lost { face });
        }
    }
    if ring_area_m2(&ring).abs() > SAME_NODE_SHARE * diagonal_m * diagonal_m {
        let face = front.corner(chain[0]).after as usize;
        return Err(SkeletonError::Unbounded { face });
    }
    Ok(cut(front, chain, time))
}

fn is_void(front: &Front, what: Happening) -> bool {
    let corner = |id: u32| front.corner(id);
    match what {
        Happening::Collapse { start, end } => {
            !corner(start).alive || !corner(end).alive || corner(start).next != end
        }
        Happening::Split {
            corner: reflex,
            start,
            end,
        } => {
            !corner(reflex).alive
                || !corner(start).alive
                || !corner(end).alive
                || corner(start).next != end
        }
        Happening::Bridge { first, second } => !corner(first).alive || !corner(second).alive,
    }
}

/// A place where the chain is to be closed again: after which corner, before which, and which
/// edges meet there.
struct Gap {
    previous: u32,
    next: u32,
    before: u32,
    after: u32,
}

impl Gap {
    /// Between what comes before one corner and what comes after another.
    fn across(from: &Corner, to: &Corner) -> Self {
        Self {
            previous: from.previous,
            next: to.next,
            before: from.before,
            after: to.after,
        }
    }
}

fn apply(front: &mut Front, queue: &mut Queue, event: Event) -> Result<(), SkeletonError> {
    let time = event.time;
    match event.what {
        Happening::Collapse { start, end } => {
            let gap = Gap::across(front.corner(start), front.corner(end));
            let rest = gap.previous;
            if rest == end || rest == gap.next {
                let (node, _) = meet(front, &[start, end, rest], time);
                for corner in [start, end, rest] {
                    front.end(corner, node);
                }
                return Ok(());
            }
            close(front, queue, &[start, end], vec![gap], time)
        }
        Happening::Split { corner, start, end } => {
            let edge = front.corner(start).after;
            let (mut one, mut other) = {
                let v = front.corner(corner);
                (Gap::across(v, v), Gap::across(v, v))
            };
            (one.next, one.after) = (end, edge);
            (other.previous, other.before) = (start, edge);
            close(front, queue, &[corner], vec![one, other], time)
        }
        Happening::Bridge { first, second } => {
            let (a, b) = (front.corner(first), front.corner(second));
            let gaps = vec![Gap::across(a, b), Gap::across(b, a)];
            close(front, queue, &[first, second], gaps, time)
        }
    }
}

/// A node at which the corners meet, at the place of the one that moves least fast: a place on a
/// fast way is known less well.
fn meet(front: &mut Front, corners: &[u32], time: Dd) -> (u32, [Dd; 2]) {
    let place = slowest(front, corners).place_at(time);
    (front.add_node(place, time), place)
}

fn slowest<'a>(front: &'a Front, corners: &[u32]) -> &'a Corner {
    let mut best = front.corner(corners[0]);
    for &id in &corners[1..] {
        let corner = front.corner(id);
        if corner.quick().pace < best.quick().pace {
            best = corner;
        }
    }
    best
}

/// Ends the corners at a new node, and closes the chains there.
fn close(
    front: &mut Front,
    queue: &mut Queue,
    ending: &[u32],
    gaps: Vec<Gap>,
    time: Dd,
) -> Result<(), SkeletonError> {
    let (node, place) = meet(front, ending, time);
    for &corner in ending {
        front.end(corner, node);
    }
    let (mut made, mut grown) = (Vec::with_capacity(2), Vec::new());
    for gap in gaps {
        let (gap, place, node) = take_over(front, gap, place, node, time);
        match front.join(gap.before, gap.after, place, time, node)? {
            Some(corner) => {
                front.link(gap.previous, corner);
                front.link(corner, gap.next);
                made.push((corner, node));
            }
            None => {
                front.link(gap.previous, gap.next);
                grown.push((gap.previous, node));
            }
        }
    }
    for &(corner, node) in made.iter().chain(&grown) {
        end_of_two(front, corner, node);
    }
    for (corner, _) in made {
        if front.corner(corner).alive {
            queue.add_corner(front, corner, time);
        }
    }
    for (start, _) in grown {
        if front.corner(start).alive {
            queue.add_edge(front, start, time);
        }
    }
    Ok(())
}

/// Where two parallel edges of different speeds meet, they lie in one line at that time: the
/// faster takes the slower's part of the wavefront over, and the slower's face ends in a level
/// side. (A standing step between them, as at the eaves, can wall a part of the inside in.)
fn take_over(
    front: &mut Front,
    mut gap: Gap,
    mut place: [Dd; 2],
    mut node: u32,
    time: Dd,
) -> (Gap, [Dd; 2], u32) {
    while let Meeting::Step { up } = Meeting::of(&front.planes, gap.before, gap.after, PARALLEL) {
        let far_end = if up { gap.previous } else { gap.next };
        if gap.previous == gap.next {
            break;
        }
        let far = *front.corner(far_end);
        place = far.place_at(time);
        let (slow, fast) = if up {
            let slow = std::mem::replace(&mut gap.before, far.before);
            gap.previous = far.previous;
            (slow, gap.after)
        } else {
            let slow = std::mem::replace(&mut gap.after, far.after);
            gap.next = far.next;
            (slow, gap.before)
        };
        if let Meeting::Corner = Meeting::of(&front.planes, gap.before, gap.after, PARALLEL) {
            place = front.crossing(gap.before, gap.after, time).unwrap_or(place);
        }
        let far_node = front.add_node(place, time);
        front.end(far_end, far_node);
        let (first, last) = if up {
            (far_node, node)
        } else {
            (node, far_node)
        };
        front.draw(fast, first, last);
        front.draw(slow, last, first);
        node = far_node;
    }
    (gap, place, node)
}

/// A chain of one or two corners encloses nothing: its corners are all at the node.
fn end_of_two(front: &mut Front, corner: u32, node: u32) {
    let next = front.corner(corner).next;
    if front.corner(corner).alive && front.corner(next).next == corner {
        front.end(corner, node);
        front.end(next, node);
    }
}

/// Cuts a chain of the wavefront off at `time`: its edges become the upper sides of their faces.
fn cut(front: &mut Front, chain: &[u32], time: f64) -> Rest {
    let time = Dd::from(time);
    let rest: Rest = chain
        .iter()
        .map(|&corner| front.add_node(front.corner(corner).place_at(time), time))
        .collect();
    for (place, (&corner, &node)) in chain.iter().zip(&rest).enumerate() {
        let face = front.corner(corner).after;
        front.draw(face, rest[(place + 1) % rest.len()], node);
        front.end(corner, node);
    }
    rest
}
