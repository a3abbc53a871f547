//! Functions that choose assets and pictures by how well they fit the scope of a shape.
//!
//! The reference says what is compared, not how: how far off one is, is the largest of the logarithms
//! of its stretches along the axes, and of two equally good ones the first by name is taken.

use std::cmp::Ordering;
use std::sync::Arc;

use glam::DVec3;

use crate::Span;

use super::evaluate::Scene;
use super::fault::Fault;
use super::files::{matching, plain};
use super::run::Run;
use super::value::Value;

/// What is taken of those that were sorted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Taken {
    /// All, in their order, as they were given: a list in a string, or an array.
    All,
    Best,
    /// One of the `n` best at random.
    OneOfBest,
    /// One at random of those that fit well enough.
    OneThatFits,
}

/// A function that sorts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sorting {
    taken: Taken,
    by_ratio: bool,
    pictures: bool,
}

const fn sorting(taken: Taken, by_ratio: bool, pictures: bool) -> Sorting {
    Sorting {
        taken,
        by_ratio,
        pictures,
    }
}

/// Names, functions, and the fewest and most arguments.
const TABLE: &[(&str, Sorting, usize, usize)] = &[
    ("assetsSortRatio", sorting(Taken::All, true, false), 2, 2),
    ("assetsSortSize", sorting(Taken::All, false, false), 3, 3),
    ("imagesSortRatio", sorting(Taken::All, true, true), 2, 2),
    ("assetBestRatio", sorting(Taken::Best, true, false), 2, 2),
    ("assetBestSize", sorting(Taken::Best, false, false), 2, 2),
    ("imageBestRatio", sorting(Taken::Best, true, true), 2, 2),
    (
        "assetApproxRatio",
        sorting(Taken::OneOfBest, true, false),
        3,
        3,
    ),
    (
        "assetApproxSize",
        sorting(Taken::OneOfBest, false, false),
        3,
        3,
    ),
    (
        "imageApproxRatio",
        sorting(Taken::OneOfBest, true, true),
        3,
        3,
    ),
    (
        "assetFitSize",
        sorting(Taken::OneThatFits, false, false),
        3,
        3,
    ),
];

impl Sorting {
    /// The function of this name, with its fewest and most arguments.
    pub fn named(name: &str) -> Option<(Self, usize, usize)> {
        let found = TABLE.iter().find(|entry| entry.0 == name)?;
        Some((found.1, found.2, found.3))
    }

    /// The names of all functions that sort.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|entry| entry.0)
    }
}

/// A file with how far off it is, and its largest stretch less one.
struct Rated {
    name: Arc<str>,
    off: f64,
    stretch: f64,
}

impl Run<'_> {
    /// The value of a function that sorts, for the shape of the scene.
    pub(super) fn sorted(
        &mut self,
        sorting: Sorting,
        args: &[Value],
        span: Span,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        let at = |message: String| Fault::at(span, message);
        let draw = match sorting.taken {
            Taken::OneOfBest | Taken::OneThatFits => scene.stream.draw(),
            Taken::All | Taken::Best => 0.0,
        };
        let names = self.candidates(sorting, &args[0], span)?;
        let axes = axes_named(&args[1].to_string()).map_err(at)?;
        let third = match args.get(2) {
            None => 0.0,
            Some(value) => value
                .number()
                .ok_or_else(|| at(format!("a number is needed, not {}", value.kind())))?,
        };
        let scope = scene.state.form.scope.size;
        let mut rated = Vec::with_capacity(names.len());
        for name in names {
            let size = self.size_of(sorting, &name, span)?;
            let (off, stretch) = if sorting.by_ratio {
                (off_in_ratio(scope, size, &axes, sorting.pictures), 0.0)
            } else {
                off_in_size(scope, size, &axes)
            };
            rated.push(Rated { name, off, stretch });
        }
        rated.sort_by(|a, b| a.off.partial_cmp(&b.off).unwrap_or(Ordering::Equal));
        let is_limited = !sorting.by_ratio
            && matches!(sorting.taken, Taken::All | Taken::OneThatFits)
            && third > 0.0;
        if is_limited {
            rated.retain(|one| one.stretch <= third);
        }
        Ok(match sorting.taken {
            Taken::All => listed(&rated, &args[0]),
            Taken::Best => picked(&rated, 1, 0.0),
            Taken::OneOfBest => picked(&rated, third.max(1.0) as usize, draw),
            Taken::OneThatFits => picked(&rated, rated.len(), draw),
        })
    }

    /// The files that are to be compared: those that a list names, or that a search finds.
    fn candidates(
        &self,
        sorting: Sorting,
        given: &Value,
        span: Span,
    ) -> Result<Vec<Arc<str>>, Fault> {
        if sorting.taken != Taken::All {
            let files = &self.options.files;
            self.take(files.names.len(), span)?;
            let query = given.to_string();
            return Ok(matching(files, &query).map(Arc::from).collect());
        }
        Ok(match given {
            Value::Array(array) => array.values.iter().map(|v| v.to_string().into()).collect(),
            text => {
                let all = text.to_string();
                let parts = all.split(';').map(str::trim);
                parts
                    .filter(|part| !part.is_empty())
                    .map(Arc::from)
                    .collect()
            }
        })
    }

    /// Width, height and depth: of an asset in metres, of a picture in pixels.
    fn size_of(&self, sorting: Sorting, name: &Arc<str>, span: Span) -> Result<DVec3, Fault> {
        if sorting.pictures {
            let size = self.options.files.pictures.get(plain(name));
            return Ok(size.map_or(DVec3::ZERO, |[width, height]| {
                DVec3::new(*width, *height, 0.0)
            }));
        }
        let asset = self.options.assets.get(name);
        let asset = asset.ok_or_else(|| Fault::missing(span, name.clone()))?;
        Ok(asset.bounds().1)
    }
}

/// The axes (0, 1, 2) that a word such as `xz` names, in its order.
fn axes_named(word: &str) -> Result<Vec<usize>, String> {
    let found: Option<Vec<usize>> = word.chars().map(|letter| "xyz".find(letter)).collect();
    found
        .filter(|axes| (1..=3).contains(&axes.len()))
        .ok_or_else(|| format!("axes are needed (x, xy, xyz), not `{word}`"))
}

/// How far off a size is along the axes, and by which share it has to be stretched at the most.
fn off_in_size(scope: DVec3, size: DVec3, axes: &[usize]) -> (f64, f64) {
    let stretches = axes.iter().map(|&axis| scope[axis] / size[axis]);
    stretches.fold((0.0, 0.0), |(off, most), stretch| {
        let own = if stretch > 0.0 && stretch.is_finite() {
            (stretch.ln().abs(), (stretch - 1.0).abs())
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        (own.0.max(off), own.1.max(most))
    })
}

/// How far off the ratios of sizes are: of two axes, or of each two of three.
fn off_in_ratio(scope: DVec3, size: DVec3, axes: &[usize], is_picture: bool) -> f64 {
    let pairs = match axes {
        [a, b] => vec![(*a, *b)],
        [a, b, c] => vec![(*a, *b), (*a, *c), (*b, *c)],
        _ => Vec::new(),
    };
    let off = pairs.into_iter().map(|(a, b)| {
        // A picture is as wide as the first axis, and as high as the second.
        let own = if is_picture {
            size.x / size.y
        } else {
            size[a] / size[b]
        };
        let stretch = (scope[a] / scope[b]) / own;
        if stretch > 0.0 && stretch.is_finite() {
            stretch.ln().abs()
        } else {
            f64::INFINITY
        }
    });
    off.fold(0.0, f64::max)
}

/// All, as they were given.
fn listed(rated: &[Rated], given: &Value) -> Value {
    let names = rated.iter().map(|one| &one.name);
    if let Value::Array(_) = given {
        return Value::texts(names.map(|name| Value::Text(name.clone())).collect());
    }
    Value::text(&names.map(|name| format!("{name};")).collect::<String>())
}

/// One of the first `count`; empty where there is none.
fn picked(rated: &[Rated], count: usize, draw: f64) -> Value {
    let count = count.min(rated.len());
    let place = ((draw * count as f64) as usize).min(count.saturating_sub(1));
    match rated.get(place) {
        Some(one) if count > 0 => Value::Text(one.name.clone()),
        _ => Value::text(""),
    }
}
