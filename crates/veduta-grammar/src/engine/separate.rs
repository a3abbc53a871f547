//! `normalizeUV` with `separatePerFace`: texture coordinates of each face by itself.

use std::sync::Arc;

use glam::DVec3;

use super::state::State;
use super::texture_map::{TextureMap, LAYERS};

/// Which coordinates `normalizeUV` brings from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Normalized {
    Both,
    /// Both, multiplied by the same.
    Uniform,
    U,
    V,
}

impl Normalized {
    pub fn named(word: &str) -> Self {
        match word {
            "uvUniform" => Self::Uniform,
            "u" => Self::U,
            "v" => Self::V,
            _ => Self::Both,
        }
    }

    /// The map whose coordinates reach from 0 to 1 on these places (m).
    pub fn of(self, map: &TextureMap, places: &[DVec3]) -> TextureMap {
        let ranges = [0, 1].map(|axis| map.range(axis, places));
        let over = |extent: f64| if extent > 0.0 { 1.0 / extent } else { 1.0 };
        let mut by = ranges.map(|(low, high)| over(high - low));
        match self {
            Self::Uniform => by = [by[0].min(by[1]); 2],
            Self::U => by[1] = 1.0,
            Self::V => by[0] = 1.0,
            Self::Both => {}
        }
        let moved = [0, 1].map(|axis| match (self, axis) {
            (Self::U, 1) | (Self::V, 0) => 0.0,
            _ => -ranges[axis].0 * by[axis],
        });
        map.changed(by, moved)
    }
}

/// Coordinates that each face of a shape has by itself, and what has been done to them since.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separate {
    base: TextureMap,
    how: Normalized,
    /// u and v since, each of u, v and 1 of the face.
    since: [[f64; 3]; 2],
}

impl Separate {
    pub fn of(base: TextureMap, how: Normalized) -> Self {
        let since = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        Self { base, how, since }
    }

    /// The map on a face with this outline (m).
    pub fn on(&self, outline: &[DVec3]) -> TextureMap {
        let own = self.how.of(&self.base, outline);
        let [u, v] = own.grow;
        TextureMap {
            grow: self.since.map(|[a, b, _]| u * a + v * b),
            offset: self
                .since
                .map(|[a, b, c]| own.offset[0] * a + own.offset[1] * b + c),
        }
    }

    /// The coordinates multiplied and then moved.
    pub fn changed(&self, by: [f64; 2], moved: [f64; 2]) -> Self {
        let row = |axis: usize| {
            let [a, b, c] = self.since[axis].map(|part| part * by[axis]);
            [a, b, c + moved[axis]]
        };
        Self {
            since: [row(0), row(1)],
            ..*self
        }
    }

    /// The coordinates turned about (0, 0), counter-clockwise (degrees).
    pub fn turned(&self, degrees: f64) -> Self {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let [u, v] = self.since;
        let mixed = |a: f64, b: f64| [0, 1, 2].map(|part| u[part] * a + v[part] * b);
        Self {
            since: [mixed(cosine, -sine), mixed(sine, cosine)],
            ..*self
        }
    }

    /// On what has been moved: `change` tells where its texture lies now.
    pub fn carried(&self, change: impl Fn(&TextureMap) -> TextureMap) -> Self {
        Self {
            base: change(&self.base),
            ..*self
        }
    }
}

impl State {
    /// A shape of one face has the coordinates of that face from now on, however it is divided.
    pub fn settle_textures(&mut self) {
        let some = |extra: &Arc<super::state::Extra>| extra.separate.iter().any(Option::is_some);
        if !self.extra.as_ref().is_some_and(some) {
            return;
        }
        let mesh = self.form.world_mesh();
        if mesh.face_count() != 1 {
            return;
        }
        let extra = self.extra_mut();
        for layer in 0..LAYERS {
            if let Some(separate) = extra.separate[layer].take() {
                extra.maps[layer] = Some(separate.on(&mesh.points));
            }
        }
    }
}
