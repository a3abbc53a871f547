//! Shapes that stand in the way of others, and where in a derivation a shape stands.

use std::sync::Arc;

use glam::DVec3;
use veduta_geometry::solid::Mesh;

use crate::shape::Scope;
use crate::Span;

use super::fault::Fault;
use super::run::Run;
use super::state::State;

/// Where the current shape stands: from the start shape on, which copy, part or child of the one
/// before it is. A shape keeps its place while operations change it.
#[derive(Debug, Clone, Default)]
pub struct Trail {
    places: Vec<u32>,
    /// For the rule's shape and each part in part below it, how many have been made of it.
    made: Vec<u32>,
}

impl Trail {
    /// The trail of a shape that a rule begins with.
    pub fn at(places: Vec<u32>) -> Self {
        Self {
            places,
            made: vec![0],
        }
    }

    fn next(&mut self) -> u32 {
        match self.made.last_mut() {
            Some(made) => {
                *made += 1;
                *made - 1
            }
            None => 0,
        }
    }

    /// The place of a new child.
    pub fn child(&mut self) -> Vec<u32> {
        let next = self.next();
        let mut places = self.places.clone();
        places.push(next);
        places
    }

    /// On to a part of the shape.
    fn enter(&mut self) {
        let next = self.next();
        self.places.push(next);
        self.made.push(0);
    }

    fn back(&mut self) {
        self.places.pop();
        self.made.pop();
    }
}

/// A shape that questions are about.
#[derive(Debug, Clone, PartialEq)]
pub struct Occluder {
    pub(super) trail: Vec<u32>,
    /// The text that `label` gave it.
    pub label: Option<Arc<str>>,
    /// Whether its surface is closed, so that something can lie in it.
    pub closed: bool,
    pub scope: Scope,
    /// Its faces in the world (m).
    pub mesh: Mesh,
    pub low: DVec3,
    pub high: DVec3,
}

/// What [`occluders`](super::occluders) gave for a start shape, seen from another one.
#[derive(Debug, Clone)]
pub struct Neighbour {
    shapes: Arc<Vec<Occluder>>,
    /// From the frame that the shapes are in to that of the start shape beside it (m).
    offset: DVec3,
    /// The box around all of them, in that frame.
    low: DVec3,
    high: DVec3,
}

impl Neighbour {
    pub fn new(shapes: Arc<Vec<Occluder>>, offset: DVec3) -> Self {
        let low = shapes
            .iter()
            .fold(DVec3::INFINITY, |low, one| low.min(one.low));
        let high = shapes
            .iter()
            .fold(DVec3::NEG_INFINITY, |high, one| high.max(one.high));
        Self {
            low: low + offset,
            high: high + offset,
            shapes,
            offset,
        }
    }

    /// How many shapes it has.
    pub fn count(&self) -> usize {
        self.shapes.len()
    }

    /// Its shapes.
    pub(super) fn around(&self) -> impl Iterator<Item = Around<'_>> {
        let shapes = self.shapes.iter();
        shapes.map(|shape| Around {
            shape,
            offset: self.offset,
        })
    }

    /// Whether the box around its shapes comes near another.
    pub(super) fn reaches(&self, low: DVec3, high: DVec3, near: f64) -> bool {
        low.cmple(self.high + near).all() && self.low.cmple(high + near).all()
    }
}

/// A shape that stands around another, and how far the frame that it is in lies off (m).
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub shape: &'a Occluder,
    pub offset: DVec3,
}

impl<'a> From<&'a Occluder> for Around<'a> {
    fn from(shape: &'a Occluder) -> Self {
        let offset = DVec3::ZERO;
        Self { shape, offset }
    }
}

impl Around<'_> {
    pub fn low(&self) -> DVec3 {
        self.shape.low + self.offset
    }

    pub fn high(&self) -> DVec3 {
        self.shape.high + self.offset
    }
}

impl Run<'_> {
    pub(super) fn enter(&mut self) {
        if let Some(trail) = &mut self.trail {
            trail.enter();
        }
    }

    pub(super) fn back(&mut self) {
        if let Some(trail) = &mut self.trail {
            trail.back();
        }
    }

    /// In the first of two passes, keeps the current shape for the second: where it is closed, or
    /// has a label.
    pub(super) fn record(
        &mut self,
        label: Option<Arc<str>>,
        state: &State,
        span: Span,
    ) -> Result<(), Fault> {
        let closed = state.form.geometry.is_solid();
        let (Some(recorded), Some(trail)) = (&mut self.recorded, &self.trail) else {
            return Ok(());
        };
        if closed || label.is_some() {
            let mesh = state.form.world_mesh();
            let (low, high) = mesh.bounds().unwrap_or_default();
            recorded.push(Occluder {
                trail: trail.places.clone(),
                label,
                closed,
                scope: state.form.scope,
                mesh,
                low,
                high,
            });
            let last = recorded.last().map_or(0, |one| one.mesh.byte_count());
            self.hold(last + size_of::<Occluder>(), span)?;
        }
        Ok(())
    }

    /// Whether the current shape came from another, or the other from it.
    pub(super) fn is_kin(&self, other: &Occluder) -> bool {
        let Some(trail) = &self.trail else {
            return false;
        };
        let (own, other) = (&trail.places, &other.trail);
        own.starts_with(other) || other.starts_with(own)
    }

    /// Whether the current shape came from another, or is it.
    pub(super) fn came_from(&self, other: &Occluder) -> bool {
        let trail = self.trail.as_ref();
        trail.is_some_and(|trail| trail.places.starts_with(&other.trail))
    }
}
