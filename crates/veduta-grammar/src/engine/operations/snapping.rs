//! `snap`: shapes that line up with others.

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::transform::place;
use super::{axes, positive, word};

/// Sine up to which two directions are the same.
const SAME_DIRECTION: f64 = 1e-6;

/// `snap(x | y | ... | xyz, name)`, `snap(axes, name, reach)`: each side of the scope across these
/// axes moves to the nearest side of a shape that `label` gave this name and that has an axis along
/// it, if one is within the reach (m; half of the scope's size where it is not given). What is in the
/// scope is stretched with it. After the snap lines of Mueller et al., *Procedural modeling of
/// buildings* (SIGGRAPH 2006), section 3.2, where splits snap.
///
/// As questions about other shapes it is about those of the first pass.
pub fn snap(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let along = axes(op, &word(run, op, 0, frame)?)?;
    let name = word(run, op, 1, frame)?;
    let reach = match op.args.len() {
        3 => Some(positive(run, op, 2, frame)?),
        _ => None,
    };
    let scope = frame.state.form.scope;
    let mut snapped = scope;
    for axis in along {
        run.check_time(op.span)?;
        let own = scope.axes.col(axis);
        let mut lines = Vec::new();
        for other in run.labelled(&name) {
            let its = other.shape.scope;
            let origin = its.origin + other.offset;
            for k in 0..3 {
                let direction = its.axes.col(k);
                if direction.cross(own).length() <= SAME_DIRECTION {
                    let start = (origin - scope.origin).dot(own);
                    lines.push(start);
                    lines.push(start + direction.dot(own) * its.size[k]);
                }
            }
        }
        let size = scope.size[axis];
        let reach = reach.unwrap_or(0.5 * size);
        let nearest = |side: f64| {
            let away = |line: &f64| (line - side).abs();
            let near = lines.iter().copied().filter(|line| away(line) <= reach);
            near.min_by(|a, b| away(a).total_cmp(&away(b)))
                .unwrap_or(side)
        };
        let (low, high) = (nearest(0.0), nearest(size));
        // Both sides on one line would leave nothing of the shape.
        if high > low || (size == 0.0 && high == low) {
            snapped.origin += own * low;
            snapped.size[axis] = high - low;
        }
    }
    if run.recorded.is_none() {
        place(frame, snapped);
    }
    frame.changed();
    Ok(())
}
