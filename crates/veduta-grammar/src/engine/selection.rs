//! Which components of a shape a selector means.

use std::cell::OnceCell;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{joined, Mesh};

use crate::ast::{BinaryOp, Joining, UnaryOp};
use crate::shape::{
    components, connected, is_meant, surroundings, Component, Form, Frames, Geometry, Kind, Lies,
    Scope, SlotTexture, Surroundings, TOLERANCE,
};
use crate::Span;

use super::code::{ComponentValue, Expr, ExprKind, Selector};
use super::evaluate::Scene;
use super::fault::Fault;
use super::limits::Limit;
use super::run::Run;
use super::state::{Place, State};
use super::texture_map::{map_of, TextureMap};
use super::value::Value;

/// The kind of component that a word such as `f` names.
pub fn kind_named(word: &str) -> Option<Kind> {
    Some(match word {
        "f" => Kind::Faces,
        "e" => Kind::Edges,
        "fe" => Kind::FaceEdges,
        "v" => Kind::Vertices,
        "fv" => Kind::FaceVertices,
        "h" => Kind::Holes,
        "g" => Kind::Groups,
        "m" => Kind::Materials,
        _ => return None,
    })
}

/// The components of a shape, for selectors to choose from.
pub struct Choosing {
    pub found: Vec<Component>,
    form: Form,
    kind: Kind,
    frames: Frames,
    around: OnceCell<Vec<Surroundings>>,
    keeps_pivot: bool,
    /// Where the texture lies, for selectors that ask for it.
    texture: Option<TextureMap>,
}

impl Choosing {
    pub fn of(form: &Form, kind: Kind, run: &Run<'_>) -> Self {
        Self {
            found: components(form, kind),
            form: form.clone(),
            kind,
            frames: Frames {
                scope: form.scope.axes,
                object: run.first().state.form.scope.axes,
            },
            around: OnceCell::new(),
            keeps_pivot: false,
            texture: None,
        }
    }

    /// Components whose scopes have the axes of the shape, and whose pivot is the shape's (`noAlign`).
    pub fn unaligned(mut self) -> Self {
        let axes = self.form.scope.axes;
        for one in &mut self.found {
            one.form = match one.form.geometry {
                Geometry::Nothing => without_faces(std::iter::once(&one.form.scope), axes),
                _ => Form::around(one.form.world_mesh(), axes, one.form.geometry.is_solid()),
            };
        }
        self.keeps_pivot = true;
        self
    }

    /// With the texture of a layer of the shape, for selectors such as `uv.left`.
    pub fn textured(self, state: &State, layer: f64) -> Result<Self, String> {
        Ok(Self {
            texture: Some(map_of(state, layer)?),
            ..self
        })
    }

    /// Whether an edge looks to this side of the texture: u grows to the right, v upwards. None where there
    /// is no such side.
    fn is_beside(&self, side: &str, at: usize) -> Option<bool> {
        let normal = self.found[at].normal;
        let along = |grow: DVec3| grow.normalize_or_zero().dot(normal);
        let [u, v] = self.texture.as_ref()?.grow.map(along);
        let looks = u.abs().max(v.abs()) > TOLERANCE;
        let across = looks && u.abs() >= v.abs();
        Some(match side {
            "left" => across && u < 0.0,
            "right" => across && u > 0.0,
            "side" => across,
            "bottom" => looks && !across && v < 0.0,
            "top" => looks && !across && v > 0.0,
            _ => return None,
        })
    }

    fn around(&self, at: usize) -> Surroundings {
        let all = self
            .around
            .get_or_init(|| surroundings(&self.form, self.kind));
        // Edges are numbered as they are found, the others as they are in the mesh.
        let index = match self.kind {
            Kind::Edges => at,
            _ => self.found[at].index,
        };
        all.get(index).copied().unwrap_or_default()
    }

    fn is_meant(&self, word: &str, at: usize, span: Span) -> Result<bool, Fault> {
        let meant = match word.strip_prefix("uv.") {
            Some(side) => self.is_beside(side, at),
            None => is_meant(word, &self.found[at], self.frames, || self.around(at)),
        };
        meant.ok_or_else(|| Fault::at(span, format!("`{word}` selects no component")))
    }

    /// The shape of a component, with what it has from the whole, before a cell has taken it:
    /// `comp.index` is its number among all.
    pub fn state(&self, whole: &State, at: usize) -> State {
        let mut state = whole.component(self.found[at].form.clone());
        self.dress(&mut state, at);
        state.comp = Place {
            index: self.found[at].index,
            total: self.found.len(),
        };
        state
    }

    /// Gives a part of an asset the look that it has there.
    pub fn dress(&self, state: &mut State, at: usize) {
        let (Geometry::Instance(instance), Kind::Groups | Kind::Materials) =
            (&self.form.geometry, self.kind)
        else {
            return;
        };
        let part = self.found[at].index;
        let look = Arc::make_mut(&mut state.look);
        if let Some(slot) = instance.asset.slot_of_part(self.kind, part) {
            // What lies by the asset's own corners has none once it is a shape: its colour stays.
            look.colour = slot.plain_in(look.colour);
            if let Some(SlotTexture {
                name,
                lies: Lies::InMetres(size_m),
            }) = &slot.texture
            {
                (look.texture, look.tile) = (Some(name.clone()), Some(*size_m));
            }
        }
        if self.kind == Kind::Materials {
            if let Some(name) = instance.asset.part_names(self.kind).get(part) {
                look.class = name.clone();
            }
        }
    }

    /// The picked components by the shapes that they become together: all, or those that hang
    /// together.
    pub fn together(&self, picked: Vec<usize>, joining: Joining) -> Vec<Vec<usize>> {
        if picked.is_empty() || joining != Joining::Connected {
            return vec![picked];
        }
        let forms: Vec<&Form> = picked.iter().map(|&at| &self.found[at].form).collect();
        connected(&forms, self.near())
            .into_iter()
            .map(|group| group.into_iter().map(|number| picked[number]).collect())
            .collect()
    }

    /// What met in a corner still does when it is nearer than this (m).
    fn near(&self) -> f64 {
        TOLERANCE * self.form.scope.size.length()
    }

    /// The picked components as one shape, along the axes of the first; none where nothing is picked.
    pub fn combined(&self, picked: &[usize]) -> Option<Form> {
        let parts: Vec<Mesh> = picked
            .iter()
            .map(|&at| self.found[at].form.world_mesh())
            .collect();
        if parts.is_empty() {
            return None;
        }
        let all = joined(&parts.iter().collect::<Vec<_>>(), self.near());
        let axes = self.found[picked[0]].form.scope.axes;
        if all.is_empty() {
            let scopes = picked.iter().map(|&at| &self.found[at].form.scope);
            return Some(without_faces(scopes, axes));
        }
        Some(Form::around(all, axes, false))
    }

    /// Whether its components have pivots of their own.
    pub fn has_pivots(&self) -> bool {
        !self.keeps_pivot && !matches!(self.kind, Kind::Groups | Kind::Materials)
    }
}

/// Edges or vertices as one shape: a scope around them.
fn without_faces<'s>(scopes: impl Iterator<Item = &'s Scope>, axes: DMat3) -> Form {
    let ends = scopes.flat_map(|scope| [scope.origin, scope.world(DVec3::ONE)]);
    let local: Vec<DVec3> = ends.map(|end| axes.transpose() * end).collect();
    let low = local.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = local.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let scope = Scope {
        origin: axes * low,
        axes,
        size: high - low,
    };
    Form {
        scope,
        geometry: Geometry::Nothing,
    }
}

impl Run<'_> {
    /// Whether a selector means component `at` of the shape in the scene. A number means the
    /// component with this number, -1 the last; conditions are evaluated for the component.
    pub(super) fn selects(
        &mut self,
        selector: &Selector,
        choosing: &Choosing,
        at: usize,
        span: Span,
        scene: &mut Scene<'_>,
    ) -> Result<bool, Fault> {
        match selector {
            Selector::Word(word) => self.is_meant(choosing, word, at, span),
            Selector::Value(_, expr) => self.holds(expr, choosing, at, scene),
        }
    }

    /// Whether a word means a component. Where it is known which edges of the start shape have a
    /// street before them, `street.front` means what stands there, and its like none of that.
    /// `streetSide` and `noStreetSide` are older words for it and for the other sides.
    fn is_meant(
        &self,
        choosing: &Choosing,
        word: &str,
        at: usize,
        span: Span,
    ) -> Result<bool, Fault> {
        if word == "streetSide" {
            return self.is_meant(choosing, "street.front", at, span);
        }
        if word == "noStreetSide" {
            return Ok(choosing.is_meant("object.side", at, span)?
                && !self.is_meant(choosing, "street.front", at, span)?);
        }
        let side = match word.strip_prefix("street.") {
            Some("side") | None => return choosing.is_meant(word, at, span),
            Some(_) if !self.has_streets() => return choosing.is_meant(word, at, span),
            Some(side) => side,
        };
        let fronts =
            choosing.is_meant("object.side", at, span)? && self.at_street(&choosing.found[at].form);
        Ok(match side {
            "front" => fronts,
            _ => !fronts && choosing.is_meant(word, at, span)?,
        })
    }

    fn holds(
        &mut self,
        expr: &Expr,
        choosing: &Choosing,
        at: usize,
        scene: &mut Scene<'_>,
    ) -> Result<bool, Fault> {
        match &expr.kind {
            ExprKind::Word(word) => self.is_meant(choosing, word, at, expr.span),
            ExprKind::Unary {
                op: UnaryOp::Not,
                operand,
            } => Ok(!self.holds(operand, choosing, at, scene)?),
            ExprKind::Binary {
                op: BinaryOp::And,
                left,
                right,
            } => {
                Ok(self.holds(left, choosing, at, scene)?
                    && self.holds(right, choosing, at, scene)?)
            }
            ExprKind::Binary {
                op: BinaryOp::Or,
                left,
                right,
            } => {
                Ok(self.holds(left, choosing, at, scene)?
                    || self.holds(right, choosing, at, scene)?)
            }
            ExprKind::Number(index) => Ok(is_index(*index, choosing, at)),
            _ => {
                let state = choosing.state(scene.state, at);
                let value = self.value(expr, &mut scene.of(&state))?;
                match value {
                    Value::Bool(is) => Ok(is),
                    Value::Number(index) => Ok(is_index(index, choosing, at)),
                    Value::Text(word) => self.is_meant(choosing, &word, at, expr.span),
                    other => {
                        let message = format!("{} selects no component", other.kind());
                        Err(Fault::at(expr.span, message))
                    }
                }
            }
        }
    }

    /// The components of each cell: each goes to the first that selects it. `is_rest` says which
    /// selectors take no part.
    pub(super) fn chosen<'s>(
        &mut self,
        selectors: impl Iterator<Item = &'s Selector>,
        choosing: &Choosing,
        span: Span,
        scene: &mut Scene<'_>,
    ) -> Result<Vec<Vec<usize>>, Fault> {
        let mut free = vec![true; choosing.found.len()];
        let mut chosen = Vec::new();
        for selector in selectors {
            let mut picked = Vec::new();
            self.take(choosing.found.len(), span)?;
            if !matches!(selector, Selector::Word(word) if word.as_ref() == REMAINDER) {
                for (at, is_free) in free.iter_mut().enumerate() {
                    if *is_free && self.selects(selector, choosing, at, span, scene)? {
                        *is_free = false;
                        picked.push(at);
                    }
                }
            }
            chosen.push(picked);
        }
        Ok(chosen)
    }

    /// A value for each component, from the first cell that selects it; 0 where none does. After `=`
    /// and `=:` it is that of the shape that the component becomes a part of.
    pub(super) fn component_values(
        &mut self,
        (kind, aligned): (Kind, bool),
        cells: &[ComponentValue],
        span: Span,
        scene: &mut Scene<'_>,
    ) -> Result<Vec<Value>, Fault> {
        self.check_time(span)?;
        let choosing = Choosing::of(&scene.state.form, kind, self).textured(scene.state, 0.0);
        let mut choosing = choosing.map_err(|message| Fault::at(span, message))?;
        if !aligned {
            choosing = choosing.unaligned();
        }
        if choosing.found.len() > self.options.limits.parts {
            let message = format!("an array of {} elements", choosing.found.len());
            return Err(Fault::over(Limit::Parts, span, message));
        }
        let selectors = cells.iter().map(|cell| &cell.selector);
        let chosen = self.chosen(selectors, &choosing, span, scene)?;
        let mut values = vec![None; choosing.found.len()];
        for (cell, picked) in cells.iter().zip(chosen) {
            if cell.joining != Joining::Each {
                let groups = choosing.together(picked, cell.joining);
                let total = groups.len();
                for (index, group) in groups.into_iter().enumerate() {
                    let Some(form) = choosing.combined(&group) else {
                        continue;
                    };
                    let place = Place { index, total };
                    let value =
                        self.value_of_component(cell, form, choosing.has_pivots(), place, scene)?;
                    for at in group {
                        values[at] = Some(value.clone());
                    }
                }
                continue;
            }
            let total = picked.len();
            for (index, at) in picked.into_iter().enumerate() {
                let form = choosing.found[at].form.clone();
                let place = Place { index, total };
                let value =
                    self.value_of_component(cell, form, choosing.has_pivots(), place, scene)?;
                values[at] = Some(value);
            }
        }
        let none = match values.iter().flatten().next() {
            Some(Value::Text(_)) => Value::text(""),
            Some(Value::Bool(_)) => Value::Bool(false),
            _ => Value::Number(0.0),
        };
        let value = |value: Option<Value>| value.unwrap_or_else(|| none.clone());
        Ok(values.into_iter().map(value).collect())
    }

    fn value_of_component(
        &mut self,
        cell: &ComponentValue,
        form: Form,
        has_pivots: bool,
        place: Place,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        let mut state = scene.state.selected(form, place, cell.selector.name());
        if self.code.tells_pivot && has_pivots {
            state.pivot_here();
        }
        let value = self.value(&cell.value, &mut scene.of(&state))?;
        if let Value::Array(_) = value {
            return Err(Fault::at(cell.value.span, "an array in an array"));
        }
        Ok(value)
    }
}

/// The selector of what is left.
pub const REMAINDER: &str = "remainder";

fn is_index(index: f64, choosing: &Choosing, at: usize) -> bool {
    let count = choosing.found.len() as f64;
    let wanted = if index < 0.0 { index + count } else { index };
    wanted == choosing.found[at].index as f64
}
