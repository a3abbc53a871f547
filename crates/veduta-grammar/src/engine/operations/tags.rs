//! `tag` and `deleteTags`: names that shapes carry.

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::measures::is_like;
use super::super::run::Run;
use super::word;

/// The most tags of a shape.
const MOST_TAGS: usize = 1000;

/// `tag(name)`: the shape and its children carry the name, for `isTagged` and `geometry.hasTags`.
/// Other than in CityEngine tags belong to shapes as wholes, not to single faces, edges and
/// vertices, and operations add none by themselves.
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

/// `deleteTags()`, `deleteTags(name)`: all, or those that are like the name; `*` at an end of it
/// stands for anything.
pub fn delete(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let query = match op.args.len() {
        0 => "*".into(),
        _ => word(run, op, 0, frame)?,
    };
    if frame.state.extra.is_some() {
        let tags = &mut frame.state.extra_mut().tags;
        tags.retain(|tag| !is_like(tag, &query));
    }
    frame.changed();
    Ok(())
}
