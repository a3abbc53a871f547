//! Deriving one shape of a tree anew, and what is below it; the rest stays as it is.

use std::cmp::Ordering;
use std::ops::Range;

use super::clock::Clock;
use super::code::Code;
use super::fault::Fault;
use super::limits::Limit;
use super::overrides::Edited;
use super::run::{derive, Options, Run, Waiting};
use super::tree::{Node, Told, Tree};
use crate::Span;

/// Derives the shape at `path` anew, with the edits that `options` now has at and below it. The
/// tree is then that of a full derivation with the same options, if seed, attributes and the
/// edits elsewhere are those that it was derived with. False where there is no such shape.
///
/// A tree that a fault stops stays as it was.
pub fn rederive(
    code: &Code,
    tree: &mut Tree,
    path: &[u32],
    options: &Options,
) -> Result<bool, Fault> {
    let Some(root) = nearest(tree, path, options) else {
        return Ok(false);
    };
    if code.asks {
        // Answers about other shapes may change anywhere.
        let first = &tree.nodes[0];
        let rule = first.rule.map_or(0, |rule| rule as usize);
        *tree = derive(code, rule, first.state.clone(), options)?;
        return Ok(true);
    }
    let own = tree.path(root);
    let derived = part(code, tree, root, options)?;
    let kept = tree.nodes.len() - tree.below(root).len();
    let count = kept + derived.nodes.len() - (own.len() + 1);
    if count > options.limits.shapes {
        let most = options.limits.shapes;
        let message = format!("more than {most} shapes");
        return Err(Fault::over(Limit::Shapes, Span::default(), message));
    }
    tree.put(root, &own, derived);
    options.overrides.report_missed(tree, &own);
    Ok(true)
}

/// The shape to derive for a change at `path`: of one that is, or is to be, deleted, its parent.
fn nearest(tree: &Tree, path: &[u32], options: &Options) -> Option<u32> {
    let was_deleted = |one: &Edited| one.path == path && one.fault.is_none();
    let found = tree.find(path);
    let name = found.map(|node| &tree.nodes[node as usize].name);
    let through_parent = match name {
        Some(name) => options.overrides.deletes(path, name),
        None => tree.edited.iter().any(was_deleted),
    };
    match path.split_last() {
        Some((_, above)) if through_parent => tree.find(above),
        _ => found,
    }
}

/// A tree of the shapes from the start to `root`, and of all that is derived from this.
fn part(code: &Code, tree: &Tree, root: u32, options: &Options) -> Result<Tree, Fault> {
    let path = tree.path(root);
    let mut line = Tree {
        globals: tree.globals.clone(),
        ..Tree::default()
    };
    let mut at = 0;
    for (depth, place) in path.iter().map(Some).chain([None]).enumerate() {
        let parent = depth.checked_sub(1).map(|parent| parent as u32);
        line.nodes.push(Node {
            parent,
            first_child: depth as u32 + 1,
            child_count: u32::from(place.is_some()),
            ..tree.nodes[at as usize].clone()
        });
        if let Some(place) = place {
            let child = tree
                .children(at)
                .find(|&child| tree.nodes[child as usize].place == *place);
            at = child.unwrap_or(at);
        }
    }
    let mut run = Run::new(code, options, line, Clock::starting(options.limits));
    run.wait(Waiting {
        node: path.len() as u32,
        depth: path.len(),
        trail: Vec::new(),
    });
    run.work()?;
    Ok(run.tree)
}

impl Tree {
    /// Puts what was derived from `root`, whose path is `own`, in place of what was below it.
    fn put(&mut self, root: u32, own: &[u32], mut part: Tree) {
        let old = self.below(root);
        let lead = own.len() as u32;
        let shift = |number: u32| number - (lead + 1) + old.start;
        let mut new = part.nodes.split_off(lead as usize + 1);
        for node in &mut new {
            let moved = |parent| if parent == lead { root } else { shift(parent) };
            node.parent = node.parent.map(moved);
            if node.rule.is_some() {
                node.first_child = shift(node.first_child);
            }
        }
        let told = self.told_again(root, own, &mut part);
        let place = root as usize;
        let (start, end) = (old.start as usize, old.end as usize);
        self.log_sum.take(self.log_sum_in(place..place + 1));
        self.log_sum.take(self.log_sum_in(start..end));
        if let Some(derived) = part.nodes.pop() {
            let node = &mut self.nodes[root as usize];
            node.choices = derived.choices;
            node.inlined = derived.inlined;
            node.child_count = derived.child_count;
        }
        let (before, after) = (old.len() as u32, new.len() as u32);
        let past = |number: u32| number - before + after;
        let empty = match before == after {
            true => Vec::new(),
            false => self.without_children(root, own, old.end),
        };
        self.nodes.splice(start..end, new);
        if before != after {
            self.renumber(root, &old, after, &empty);
        }
        let first = self.leaves.partition_point(|leaf| *leaf < old.start);
        let last = self.leaves.partition_point(|leaf| *leaf < old.end);
        let leaves = self.leaves_in(start..start + after as usize);
        let count = leaves.len();
        self.leaves.splice(first..last, leaves);
        let later = self.leaves.iter_mut().skip(first + count);
        later.for_each(|leaf| *leaf = past(*leaf));
        self.log_sum.add(self.log_sum_in(place..place + 1));
        self.log_sum
            .add(self.log_sum_in(start..start + after as usize));
        self.log_prior = self.log_sum.value();
        self.told = told
            .into_iter()
            .map(|(number, one)| Told {
                node: match number {
                    Place::New if one.node == lead => root,
                    Place::New => shift(one.node),
                    Place::Old if one.node >= old.end => past(one.node),
                    Place::Old => one.node,
                },
                ..one
            })
            .collect();
        self.edited.retain(|one| !one.path.starts_with(own));
        self.edited.extend(part.edited);
    }

    /// Numbers the shapes anew after `after` shapes have taken the place of those of `old`; the
    /// first children of those in `empty` (which have none) stay.
    fn renumber(&mut self, root: u32, old: &Range<u32>, after: u32, empty: &[u32]) {
        let before = old.len() as u32;
        let past = |number: u32| number - before + after;
        for (number, node) in self.nodes.iter_mut().enumerate() {
            let number = number as u32;
            let is_new = number >= old.start && number < old.start + after;
            if is_new || number == root {
                continue;
            }
            if let Some(parent) = node.parent.filter(|parent| *parent >= old.end) {
                node.parent = Some(past(parent));
            }
            let was = if number < old.start {
                number
            } else {
                number + before - after
            };
            let stays = node.first_child == old.end && empty.contains(&was);
            if node.rule.is_some() && node.first_child >= old.end && !stays {
                node.first_child = past(node.first_child);
            }
        }
    }

    /// The shapes before `root` in the order of work, whose children would begin at `end`, but
    /// that have none.
    fn without_children(&self, root: u32, own: &[u32], end: u32) -> Vec<u32> {
        let nodes = self.nodes.iter().enumerate();
        let empty = nodes.filter(|(_, node)| {
            node.rule.is_some() && node.child_count == 0 && node.first_child == end
        });
        let numbers = empty.map(|(number, _)| number as u32);
        numbers
            .filter(|&number| number != root && self.path(number).as_slice() < own)
            .collect()
    }

    /// Puts the messages and reports of `part` in the place of those of `root` and what was below
    /// it; gives whose they are then, with the numbers that they have in their trees.
    fn told_again(&mut self, root: u32, own: &[u32], part: &mut Tree) -> Vec<(Place, Told)> {
        let side = |tree: &Tree, one: &Told| {
            let path = tree.path(one.node);
            if one.node == root || path.starts_with(own) {
                Ordering::Equal
            } else {
                path.as_slice().cmp(own)
            }
        };
        let sides: Vec<Ordering> = self.told.iter().map(|one| side(self, one)).collect();
        let first = sides.iter().take_while(|side| side.is_lt()).count();
        let last = sides.iter().take_while(|side| !side.is_gt()).count();
        let sum = |told: &[Told]| {
            let messages: usize = told.iter().map(|one| one.messages).sum();
            let reports: usize = told.iter().map(|one| one.reports).sum();
            (messages, reports)
        };
        let (start, length) = (sum(&self.told[..first]), sum(&self.told[first..last]));
        self.messages
            .splice(start.0..start.0 + length.0, part.messages.drain(..));
        self.reports
            .splice(start.1..start.1 + length.1, part.reports.drain(..));
        let mark = |place: Place| move |one: &Told| (place, *one);
        let mut told: Vec<(Place, Told)> =
            self.told[..first].iter().map(mark(Place::Old)).collect();
        told.extend(part.told.iter().map(mark(Place::New)));
        told.extend(self.told[last..].iter().map(mark(Place::Old)));
        told
    }
}

/// The tree whose numbers an entry has.
#[derive(Clone, Copy)]
enum Place {
    Old,
    New,
}
