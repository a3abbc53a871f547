//! `tag` and `deleteTags`: names that shapes carry.

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::marks::is_asked;
use super::super::run::Run;
use super::word;

/// The most tags of a shape.
const MOST_TAGS: usize = 1000;

/// `tag(name)`: the faces of the shape carry the name, for `isTagged` and `geometry.hasTags`. Other
/// than in CityEngine edges and vertices have the tags of the whole that they were taken from.
pub fn tag(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let name = word(run, op, 0, frame)?;
    let tags = &mut frame.state.extra_mut().tags;
    tags.insert(name);
    if tags.len() > MOST_TAGS {
        return Err(Fault::at(
            op.span,
            format!("more than {MOST_TAGS} tags of a shape"),
        ));
    }
    frame.changed();
    Ok(())
}

/// `deleteTags()`, `deleteTags(name)`: all, or those of this name and below it.
pub fn delete(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let query = match op.args.len() {
        0 => "*".into(),
        _ => word(run, op, 0, frame)?,
    };
    if frame.state.extra.is_some() {
        let extra = frame.state.extra_mut();
        extra.tags.retain(|tag| !is_asked(tag, &query));
        for mark in &mut extra.marks {
            mark.tags.retain(|tag| !is_asked(tag, &query));
        }
        if op.args.is_empty() {
            extra.edge_tags = false;
            extra.made = None;
        }
    }
    frame.changed();
    Ok(())
}

/// `setTagsFromEdgeAttrs()`: from here on a shape has a tag `edgeattr.NAME.TEXT` of each attribute of
/// texts of the start shape's edges: of the edge that it stands for when it is asked.
pub fn of_edges(_: &mut Run<'_>, _: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    frame.state.extra_mut().edge_tags = true;
    frame.changed();
    Ok(())
}
