//! A shape while a rule works on it, and what its children get from it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::shape::Form;

use super::marks::{Made, Mark};
use super::operations::TrimPlane;
use super::separate::Separate;
use super::texture_map::{TextureMap, LAYERS};
use super::value::Value;

/// How a shape looks, and what it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// sRGB, 0 to 1.
    pub colour: [f32; 3],
    pub opacity: f32,
    pub texture: Option<Arc<str>>,
    /// Metres that the texture covers to the right and up, where it is one of a known size.
    pub tile: Option<[f64; 2]>,
    /// What a surface is in the model: `wall`, `window`, `door`, `roof`, ...; empty where the
    /// rules do not say it.
    pub class: Arc<str>,
    /// Properties that rules can read and models do not show, by their full names.
    pub kept: BTreeMap<&'static str, Value>,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            colour: [1.0; 3],
            opacity: 1.0,
            texture: None,
            tile: None,
            class: "".into(),
            kept: BTreeMap::new(),
        }
    }
}

/// Which of how many parts a shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Place {
    pub index: usize,
    pub total: usize,
}

/// What few shapes have; children have it from their parent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extra {
    pub tags: BTreeSet<Arc<str>>,
    /// Whether it has the tags of the start shape's edges: `setTagsFromEdgeAttrs`.
    pub edge_tags: bool,
    /// What made the shape as a whole: its faces get tags by that.
    pub made: Option<Made>,
    /// The tagged surfaces that the shape was put together from.
    pub marks: Vec<Mark>,
    /// What `setupProjection` has prepared, by texture layer.
    pub projections: [Option<TextureMap>; LAYERS],
    /// Where the texture lies, by layer; None is the shape's scope from 0 to 1.
    pub maps: [Option<TextureMap>; LAYERS],
    /// Coordinates that each face has by itself, by layer, in place of those of the whole.
    pub separate: [Option<Separate>; LAYERS],
    /// Origin and axes of the pivot; None is that of the start shape.
    pub pivot: Option<(DVec3, DMat3)>,
    /// The planes of `trim`.
    pub trims: Vec<TrimPlane>,
    /// `trim.horizontal`.
    pub trims_level: bool,
    /// The opposite of `trim.vertical`.
    pub keeps_steep: bool,
}

impl Extra {
    /// Whether all texture coordinates are numbers that pictures can use.
    pub fn is_sound(&self) -> bool {
        let mut maps = self.maps.iter().chain(&self.projections).flatten();
        maps.all(TextureMap::is_sound)
    }
}

/// The current shape.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    pub form: Form,
    pub look: Arc<Look>,
    /// Attributes that `set` has changed for this shape and its children.
    pub set: Option<Arc<BTreeMap<usize, Value>>>,
    /// Tags and texture maps, where there are any.
    pub extra: Option<Arc<Extra>>,
    pub split: Place,
    pub comp: Place,
    /// The selector that `comp` chose the shape by.
    pub selector: Arc<str>,
    /// `seedian`.
    pub seed: f64,
}

impl State {
    pub fn new(form: Form, seed: u32) -> Self {
        Self {
            form,
            look: Arc::new(Look::default()),
            set: None,
            extra: None,
            split: Place::default(),
            comp: Place::default(),
            selector: "".into(),
            seed: f64::from(seed),
        }
    }

    /// What few shapes have, to be changed for this one.
    pub fn extra_mut(&mut self) -> &mut Extra {
        Arc::make_mut(self.extra.get_or_insert_default())
    }

    /// Puts the pivot where it is in a component: at its first corner, with the axes of its scope.
    pub fn pivot_here(&mut self) {
        let scope = self.form.scope;
        let first = self
            .form
            .geometry
            .first_corner()
            .map(|unit| scope.world(unit));
        self.extra_mut().pivot = Some((first.unwrap_or(scope.origin), scope.axes));
    }

    /// Changes where textures lie on the shape. What `setupProjection` has prepared stays where it is.
    pub fn carry_textures(&mut self, change: impl Fn(&TextureMap) -> TextureMap) {
        if let Some(extra) = &mut self.extra {
            let extra = Arc::make_mut(extra);
            for map in extra.maps.iter_mut().flatten() {
                *map = change(map);
            }
            for own in extra.separate.iter_mut().flatten() {
                *own = own.carried(&change);
            }
        }
    }

    /// A component of this shape as the cell that takes it has it: `comp.index` and `comp.total` count
    /// those of the cell, whose selector is `comp.sel`.
    pub fn selected(&self, form: Form, place: Place, selector: Arc<str>) -> Self {
        let mut state = self.component(form);
        state.comp = place;
        state.selector = selector;
        state
    }

    /// A component of this shape. A face has the tags that it had in the whole.
    pub fn component(&self, form: Form) -> Self {
        let mut state = self.with_form(form);
        let has = |extra: &Arc<Extra>| extra.made.is_some() || !extra.marks.is_empty();
        if self.extra.as_ref().is_some_and(has) {
            let mesh = state.form.world_mesh();
            state.extra_mut().settle(&mesh, self.form.scope.axes);
        }
        state.settle_textures();
        state
    }

    /// Another form with the same looks and attributes.
    pub fn with_form(&self, form: Form) -> Self {
        Self {
            form,
            look: self.look.clone(),
            set: self.set.clone(),
            extra: self.extra.clone(),
            split: self.split,
            comp: self.comp,
            selector: self.selector.clone(),
            seed: self.seed,
        }
    }
}
