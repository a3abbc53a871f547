//! `i`: assets in place of what a shape is filled with.

use std::sync::Arc;

use glam::DVec3;

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::word;
use crate::shape::{Asset, Geometry, Instance, Scope};

/// Operations that leave an asset whole: they change where it stands and how it looks, or do not
/// look at it at all.
const KEEPS_WHOLE: &[&str] = &[
    "NIL",
    "center",
    "color",
    "deleteTags",
    "i",
    "label",
    "mirror",
    "print",
    "r",
    "report",
    "resetMaterial",
    "reverseNormals",
    "rotate",
    "s",
    "set",
    "setMaterial",
    "setPivot",
    "snap",
    "t",
    "tag",
    "translate",
];

/// `i(name)`, `i(name, yUp | zUp)`, `i(name, yUp | zUp, mode)`: the asset stretched to the scope.
/// Along an axis where the scope has no size, the asset keeps its proportion to the others; it begins in
/// a flat scope, and lies where it lies in its own frame where two sizes or all are missing; in a flat
/// scope, too, where its plane z = 0 is that of a wall. `keepSizeAndPosition` takes all sizes of the scope for none;
/// `keepSizeAlignPosition` keeps the asset's size and stands it in the middle of the scope's floor.
/// A fourth word (about cleaning) changes nothing: assets are cleaned when they are read.
pub fn insert(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let asset = asset(run, op, 0, frame)?;
    let z_up = op.args.len() > 1 && word(run, op, 1, frame)?.as_ref() == "zUp";
    let mode = match op.args.len() {
        0..=2 => "alignSizeAndPosition".into(),
        _ => word(run, op, 2, frame)?,
    };
    let instance = Instance::new(asset, z_up);
    let (low, size) = instance.bounds();
    let scope = frame.state.form.scope;
    let (by, size) = match mode.as_ref() {
        "keepSizeAndPosition" => (low, size),
        "keepSizeAlignPosition" => (DVec3::new(0.5, 0.0, 0.5) * (scope.size - size), size),
        _ => fitted(scope.size, low, size, &instance.asset),
    };
    frame.state.form.scope = Scope {
        size,
        ..scope.moved(by)
    };
    frame.state.form.geometry = Geometry::Instance(instance);
    frame.state.replaced();
    frame.changed();
    Ok(())
}

/// The asset that the argument at `index` names.
pub fn asset(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<Arc<Asset>, Fault> {
    let name = word(run, op, index, frame)?;
    let asset = run.options.assets.get(&name).cloned();
    asset.ok_or_else(|| Fault::missing(op.span, name))
}

/// How deep a panel is, of the mean of its other sizes.
const PANEL: f64 = 0.01;

/// How far the scope moves, and its size, for an asset to fill it: where it has no size, the asset
/// is as large as the mean stretch along the other axes makes it, a panel in a flat
/// scope by a share of that.
fn fitted(scope: DVec3, low: DVec3, size: DVec3, asset: &Asset) -> (DVec3, DVec3) {
    let axes = (0..3).filter(|&axis| scope[axis] > 0.0 && size[axis] > 0.0);
    let stretches: Vec<f64> = axes.map(|axis| scope[axis] / size[axis]).collect();
    let mean = match stretches.len() {
        0 => 1.0,
        count => stretches.iter().sum::<f64>() / count as f64,
    };
    let open = scope.cmpeq(DVec3::ZERO);
    let flat = open.bitmask().count_ones() == 1;
    let begins = flat && !asset.in_plane;
    let thin = if flat && asset.panel { PANEL } else { 1.0 };
    let by = if begins { DVec3::ZERO } else { low * mean };
    (
        DVec3::select(open, by, DVec3::ZERO),
        DVec3::select(open, size * mean * thin, scope),
    )
}

/// Turns an asset into faces where an operation needs them.
pub fn open_for(operation: &str, frame: &mut Frame) {
    if !KEEPS_WHOLE.contains(&operation) {
        frame.state.form.geometry = frame.state.form.geometry.opened();
    }
}
