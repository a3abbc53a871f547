//! The operations that shapes are made with; each is a function of the run and the frame.

mod along_uv;
mod appearance;
mod assets;
mod components;
mod dividing;
mod dividing_textures;
mod envelopes;
mod extruding;
mod inlining;
mod inner_rectangles;
mod meshes;
mod modifying;
mod offsets;
mod perimeter;
mod pivots;
mod primitives;
mod reshaping;
mod roof_types;
mod roofs;
mod scattering;
mod scopes;
mod setbacks;
mod setting;
mod snapping;
mod solids;
mod speech;
mod standing;
mod tags;
mod textures;
mod transform;
mod trimming;
mod wings;

pub use trimming::TrimPlane;

use std::sync::Arc;

use super::code::{Arg, Operation, Sizing};
use super::fault::Fault;
use super::frame::Frame;
use super::limits::Limit;
use super::run::Run;
use super::value::Value;
use crate::shape::Geometry;

/// An operation: its place in the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OperationId(usize);

type Work = fn(&mut Run<'_>, &Operation, &mut Frame) -> Result<(), Fault>;

/// All operations that derive, and the fewest and most arguments of each.
const TABLE: &[(&str, Work, usize, usize)] = &[
    ("NIL", appearance::nothing, 0, 0),
    ("alignScopeToAxes", scopes::align_to_axes, 0, 1),
    ("alignScopeToGeometry", scopes::align_to_geometry, 2, 3),
    ("alignScopeToGeometryBBox", scopes::align_to_box, 1, 1),
    ("bakeUV", textures::bake, 1, 1),
    ("center", transform::center, 1, 1),
    ("cleanupGeometry", reshaping::clean, 2, 2),
    ("color", appearance::colour, 1, 4),
    ("comp", components::components, 1, 2),
    ("convexify", meshes::convexify, 0, 1),
    ("copyUV", textures::copy, 2, 2),
    ("deleteHoles", meshes::delete_holes, 0, 0),
    ("deleteTags", tags::delete, 0, 1),
    ("deleteUV", textures::delete, 1, 1),
    ("envelope", envelopes::envelope, 4, 10),
    ("extrude", solids::extrude, 1, 2),
    ("footprint", reshaping::footprint, 0, 0),
    ("i", assets::insert, 1, 4),
    ("inline", inlining::inline, 0, 1),
    ("innerRect", inner_rectangles::inner_rect, 0, 0),
    ("innerRectangle", inner_rectangles::inner_rectangle, 1, 1),
    ("insertAlongUV", along_uv::insert, 3, 5),
    ("intersect", inlining::intersect, 0, 1),
    ("label", speech::label, 1, 1),
    ("mirror", scopes::mirror, 3, 3),
    ("mirrorScope", scopes::mirror_scope, 3, 3),
    ("modify", modifying::modify, 1, 2),
    ("normalizeUV", textures::normalize, 3, 3),
    ("offset", offsets::offset, 1, 2),
    ("offsetUV", textures::translate, 3, 3),
    ("primitiveCone", primitives::make_cone, 0, 3),
    ("primitiveCube", solids::cube, 0, 3),
    ("primitiveCylinder", primitives::make_cylinder, 0, 3),
    ("primitiveDisk", primitives::make_disk, 0, 2),
    ("primitiveQuad", solids::quad, 0, 2),
    ("primitiveSphere", primitives::make_sphere, 0, 3),
    ("print", speech::print, 1, 1),
    ("projectUV", textures::project, 1, 1),
    ("r", transform::turn_scope, 3, 4),
    ("rectify", reshaping::rectify, 1, 1),
    ("report", speech::report, 2, 2),
    ("resetGeometry", reshaping::reset, 0, 0),
    ("resetMaterial", appearance::reset_material, 0, 1),
    ("reverseNormals", solids::reverse, 0, 0),
    ("roofButterfly", roof_types::butterfly, 1, 4),
    ("roofCrossGable", roof_types::cross_gable, 1, 4),
    ("roofDome", roof_types::dome, 1, 3),
    ("roofDutch", roof_types::dutch, 2, 4),
    ("roofFlat", roof_types::flat, 2, 4),
    ("roofGable", roofs::gable, 1, 6),
    ("roofGambrel", roof_types::gambrel, 3, 5),
    ("roofHalfHip", roof_types::half_hip, 2, 5),
    ("roofHip", roofs::hip, 1, 4),
    ("roofMansard", roof_types::mansard, 3, 4),
    ("roofOnion", roof_types::onion, 1, 3),
    ("roofPerEdge", roof_types::per_edge, 1, 3),
    ("roofPyramid", roofs::pyramid, 1, 3),
    ("roofRidge", roofs::ridge, 2, 3),
    ("roofSaltbox", roof_types::saltbox, 2, 5),
    ("roofSawtooth", roof_types::sawtooth, 2, 5),
    ("roofShed", roofs::shed, 1, 4),
    ("roofSkillion", roof_types::skillion, 1, 4),
    ("roofVault", roof_types::vault, 1, 4),
    ("rotate", transform::rotate, 5, 5),
    ("rotateScope", scopes::rotate_scope, 3, 3),
    ("rotateUV", textures::rotate, 2, 2),
    ("s", transform::resize, 3, 3),
    ("scaleUV", textures::scale, 3, 3),
    ("scatter", scattering::scatter, 3, 5),
    ("set", setting::set, 2, 2),
    ("setMaterial", appearance::set_material, 1, 1),
    ("setPivot", pivots::set_pivot, 2, 2),
    ("setback", setbacks::setback, 1, 2),
    ("setTagsFromEdgeAttrs", tags::of_edges, 0, 0),
    ("setbackPerEdge", setbacks::per_edge, 1, 2),
    ("setbackToArea", setbacks::to_area, 1, 4),
    ("setupProjection", textures::set_up, 4, 7),
    ("shapeL", wings::l, 2, 2),
    ("shapeO", wings::o, 4, 4),
    ("shapeU", wings::u, 3, 3),
    ("snap", snapping::snap, 2, 3),
    ("split", dividing::split, 1, 3),
    (
        "splitAndSetbackPerimeter",
        perimeter::split_and_set_back,
        1,
        3,
    ),
    ("splitArea", dividing::split_area, 1, 2),
    ("subtract", inlining::subtract, 0, 1),
    ("t", transform::move_scope, 3, 3),
    ("tag", tags::tag, 1, 1),
    ("taper", standing::taper, 1, 1),
    ("texture", appearance::texture, 1, 1),
    ("tileUV", textures::tile_uv, 3, 3),
    ("translate", transform::translate, 5, 5),
    ("translateUV", textures::translate, 3, 3),
    ("trim", trimming::trim, 0, 0),
    ("union", inlining::union, 0, 1),
];

impl OperationId {
    /// The operation of this name.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().position(|entry| entry.0 == name).map(Self)
    }

    /// Whether shapes have to keep the planes that part them from each other.
    pub fn trims(self) -> bool {
        TABLE[self.0].0 == "trim"
    }

    /// Whether it turns scopes about the axes of the pivot.
    pub fn turns_about_pivot(self) -> bool {
        matches!(TABLE[self.0].0, "r" | "rotateScope")
    }

    /// Whether it has to do with tags.
    pub fn tags(self) -> bool {
        matches!(TABLE[self.0].0, "tag" | "deleteTags")
    }

    /// Which argument names an asset.
    pub fn asset_argument(self) -> Option<usize> {
        match TABLE[self.0].0 {
            "i" => Some(0),
            "insertAlongUV" => Some(1),
            _ => None,
        }
    }

    /// Which argument is an attribute itself, not its value.
    pub fn attribute_argument(self) -> Option<usize> {
        (TABLE[self.0].0 == "set").then_some(0)
    }

    /// Whether it has to do with other shapes.
    pub fn asks(self) -> bool {
        TABLE[self.0].0 == "snap"
    }

    /// The fewest and most arguments.
    pub fn arguments(self) -> (usize, usize) {
        (TABLE[self.0].2, TABLE[self.0].3)
    }
}

/// The names of all operations that derive.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|entry| entry.0)
}

/// Places and sizes beyond this have lost their millimetres, and are a mistake (m).
const FARTHEST_M: f64 = 1e12;

pub(super) fn run(
    run: &mut Run<'_>,
    operation: &Operation,
    frame: &mut Frame,
) -> Result<(), Fault> {
    if matches!(frame.state.form.geometry, Geometry::Instance(_)) && !takes_parts(operation) {
        assets::open_for(TABLE[operation.id.0].0, frame);
    }
    TABLE[operation.id.0].1(run, operation, frame)?;
    let form = &frame.state.form;
    let extent = form.scope.origin.abs().max(form.scope.size.abs());
    if !(extent.max_element() <= FARTHEST_M && form.scope.axes.is_finite()) {
        return Err(Fault::at(
            operation.span,
            format!("a shape that reaches beyond {FARTHEST_M} m"),
        ));
    }
    if frame
        .state
        .extra
        .as_ref()
        .is_some_and(|extra| !extra.is_sound())
    {
        return Err(Fault::at(
            operation.span,
            "texture coordinates beyond all numbers",
        ));
    }
    if let Geometry::Faces { mesh, .. } = &form.geometry {
        run.hold(mesh.byte_count(), operation.span)?;
        run.take(mesh.corner_count(), operation.span)?;
        check_faces(
            run,
            operation,
            mesh.face_count().max(mesh.corner_count() / 4),
        )?;
        run.check_time(operation.span)?;
    }
    Ok(())
}

/// Whether it takes an asset apart by the parts that its file has.
fn takes_parts(operation: &Operation) -> bool {
    let kind = operation.args.first();
    TABLE[operation.id.0].0 == "comp"
        && matches!(kind, Some(Arg::Word(word)) if matches!(word.as_ref(), "g" | "m"))
}

/// A fault where a shape has too many faces.
fn check_faces(run: &Run<'_>, operation: &Operation, faces: usize) -> Result<(), Fault> {
    let most = run.options.limits.faces;
    if faces > most {
        let message = format!("a shape of {faces} faces; {most} are the most");
        return Err(Fault::over(Limit::Faces, operation.span, message));
    }
    Ok(())
}

/// The argument at `index` as metres; `'` takes it of `whole`.
fn length(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    whole: f64,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    let (expr, whole) = match &operation.args[index] {
        Arg::Value(Sizing::Absolute, expr) => (expr, 1.0),
        Arg::Value(Sizing::Relative, expr) => (expr, whole),
        Arg::Value(_, expr) => {
            return Err(Fault::at(expr.span, "`~` has a meaning in splits alone"));
        }
        Arg::Word(word) => {
            let message = format!("a number is needed, not `{word}`");
            return Err(Fault::at(operation.span, message));
        }
    };
    let number = whole * run.evaluate_finite(expr, frame)?;
    if number.is_finite() {
        Ok(number)
    } else {
        let message = format!("a finite number is needed, not {number}");
        Err(Fault::at(expr.span, message))
    }
}

/// The argument at `index` as a number that is not below zero.
fn positive(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    let value = number(run, operation, index, frame)?;
    if value >= 0.0 {
        return Ok(value);
    }
    let message = format!("a number from 0 on is needed, not {value}");
    Err(Fault::at(operation.span, message))
}

/// The argument at `index` as a value; a word is a string.
fn value(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<Value, Fault> {
    match &operation.args[index] {
        Arg::Word(word) => Ok(Value::Text(word.clone())),
        Arg::Value(_, expr) => run.evaluate(expr, frame),
    }
}

/// An array as numbers from 0 on; 0 stands for those without bounds, and a message says so.
fn numbers(run: &mut Run<'_>, operation: &Operation, value: &Value) -> Result<Vec<f64>, Fault> {
    let Value::Array(array) = value else {
        let message = format!("an array is needed, not {}", value.kind());
        return Err(Fault::at(operation.span, message));
    };
    let numbers = array.values.iter().map(Value::number);
    let found: Option<Vec<f64>> = numbers
        .map(|n| n.filter(|n| n.is_nan() || *n >= 0.0))
        .collect();
    let needed = || Fault::at(operation.span, "numbers from 0 on are needed");
    let found = found.ok_or_else(needed)?;
    let each = found.into_iter();
    each.map(|number| run.without_bounds(number, operation.span))
        .collect()
}

/// The same, where each of the edges needs one.
fn numbers_of_edges(
    run: &mut Run<'_>,
    operation: &Operation,
    value: &Value,
    count: usize,
) -> Result<Vec<f64>, Fault> {
    let found = numbers(run, operation, value)?;
    if found.len() == count {
        return Ok(found);
    }
    let message = format!("{} numbers for {count} edges", found.len());
    Err(Fault::at(operation.span, message))
}

/// The argument at `index` as a number that has nothing to do with the scope's size.
fn number(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    length(run, operation, index, 1.0, frame)
}

/// The argument at `index` as a word: as it is written, or the value of a string.
fn word(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<Arc<str>, Fault> {
    match &operation.args[index] {
        Arg::Word(word) => Ok(word.clone()),
        Arg::Value(_, expr) => {
            let text = run.evaluate(expr, frame)?.written();
            Ok(text.map_err(|why| Fault::at(expr.span, why))?.into())
        }
    }
}

/// The axes that a word such as `xz` names.
fn axes(operation: &Operation, word: &str) -> Result<Vec<usize>, Fault> {
    let place = |letter: char| "xyz".find(letter);
    let found: Option<Vec<usize>> = word.chars().map(place).collect();
    found.filter(|axes| !axes.is_empty()).ok_or_else(|| {
        Fault::at(
            operation.span,
            format!("axes are needed (x, y, z), not `{word}`"),
        )
    })
}
