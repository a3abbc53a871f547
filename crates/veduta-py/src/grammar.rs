//! `veduta_grammar` for Python: rule files in, columns of polygons out, the GIL released between.

use std::collections::HashMap;

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use veduta_grammar::engine::{
    derive, lot_form, lower, pack, pieces, surfaces, Code, Expr, ExprKind, Limits, Options, Packed,
    State, Surfaces, Value,
};
use veduta_grammar::{check, Source};

use crate::rules::{program_of, rendered, Files};

create_exception!(_core, GrammarFault, PyValueError);

pub(crate) type Rings = Vec<Vec<[f64; 3]>>;

/// Polygons of a piece that may be repeated: a window has some dozens.
const MOST_IN_PIECE: u32 = 96;

/// Checked rule files, ready to derive.
#[pyclass(frozen, name = "GrammarRules", module = "veduta._core")]
pub(crate) struct GrammarRules {
    code: Code,
    text: Source,
    has_imports: bool,
}

#[pymethods]
impl GrammarRules {
    /// `files` are name and text of each file, the main one first; the others are what it may
    /// import, under the names in its import statements.
    #[new]
    fn new(py: Python<'_>, files: Files) -> PyResult<Self> {
        py.detach(|| read(&files)).map_err(GrammarFault::new_err)
    }

    /// Names of the rules that need no arguments, the start rule first.
    #[getter]
    fn starts(&self) -> Vec<String> {
        let mut names: Vec<usize> = self.code.start.into_iter().collect();
        let all = 0..self.code.rules.len();
        names.extend(
            all.filter(|rule| self.code.rules[*rule].params == 0 && Some(*rule) != self.code.start),
        );
        let name = |rule: usize| self.code.rules[rule].name.to_string();
        names.into_iter().map(name).collect()
    }

    /// The attributes, with what each is where its value says so: `number`, `text`, `bool`, or "".
    #[getter]
    fn attributes(&self) -> Vec<(String, &'static str)> {
        let all = self
            .code
            .globals
            .iter()
            .filter(|global| global.is_attribute);
        all.map(|global| (global.name.to_string(), kind(&global.value)))
            .collect()
    }

    /// Derives each lot (rings of x, y, z in metres, the outline first) with the seed and the
    /// attributes beside it. Per lot: the columns of its leaves, or the text of why there are none.
    #[pyo3(signature = (lots, seeds, *, start=None, attributes=None, seconds=60.0, shapes=5_000_000))]
    #[allow(clippy::too_many_arguments)] // as Python calls it: with names
    fn derive<'py>(
        &self,
        py: Python<'py>,
        lots: Vec<Rings>,
        seeds: Vec<u64>,
        start: Option<&str>,
        attributes: Option<Vec<HashMap<String, Given>>>,
        seconds: f64,
        shapes: usize,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let rule = self.start_rule(start)?;
        let given = attributes.unwrap_or_else(|| lots.iter().map(|_| HashMap::new()).collect());
        if seeds.len() != lots.len() || given.len() != lots.len() {
            return Err(PyValueError::new_err(
                "each lot needs a seed and attributes",
            ));
        }
        let limits = limits_of(seconds, shapes);
        let found = py.detach(|| self.all(&lots, &seeds, given, rule, limits));
        found.into_iter().map(|one| to_python(py, one)).collect()
    }
}

/// A value given from outside.
#[derive(FromPyObject)]
pub(crate) enum Given {
    Bool(bool),
    Number(f64),
    Text(String),
}

impl From<Given> for Value {
    fn from(given: Given) -> Self {
        match given {
            Given::Bool(is) => Value::Bool(is),
            Given::Number(number) => Value::Number(number),
            Given::Text(text) => Value::text(&text),
        }
    }
}

fn values(given: HashMap<String, Given>) -> HashMap<String, Value> {
    let each = given.into_iter();
    each.map(|(name, value)| (name, value.into())).collect()
}

/// What an expression is where it says so itself; of alternatives, the first speaks for all.
fn kind(expr: &Expr) -> &'static str {
    match &expr.kind {
        ExprKind::Number(_) => "number",
        ExprKind::Bool(_) => "bool",
        ExprKind::Text(_) => "text",
        ExprKind::Choice(choice) => choice.branches.first().map_or("", |one| kind(&one.1)),
        _ => "",
    }
}

pub(crate) struct Derived {
    pub packed: Packed,
    pub surfaces: Surfaces,
    /// Leaves that rules may have made several times together, by packed feature.
    pub pieces: Vec<u32>,
    pub names: Vec<String>,
    log_prior: f64,
    pub messages: Vec<String>,
}

fn read(files: &Files) -> Result<GrammarRules, String> {
    let missing = || "no rule file is given".to_string();
    let (name, text) = files.first().ok_or_else(missing)?;
    let program = program_of(files).ok_or_else(missing)?;
    let checked = check(&program);
    if checked.has_errors() {
        return Err(checked.render(&program));
    }
    let lowered = lower(&program, &checked);
    if lowered.has_errors() {
        return Err(rendered(&program, &lowered.diagnostics));
    }
    Ok(GrammarRules {
        code: lowered.code,
        text: Source::new(name.clone(), text.clone()),
        has_imports: program.units.len() > 1,
    })
}

pub(crate) fn limits_of(seconds: f64, shapes: usize) -> Limits {
    Limits {
        seconds,
        shapes,
        ..Limits::default()
    }
}

impl GrammarRules {
    /// What the rules make of each lot; `seeds` and `given` are as long as `lots`.
    pub(crate) fn all(
        &self,
        lots: &[Rings],
        seeds: &[u64],
        given: Vec<HashMap<String, Given>>,
        rule: usize,
        limits: Limits,
    ) -> Vec<Result<Derived, String>> {
        let given: Vec<HashMap<String, Value>> = given.into_iter().map(values).collect();
        let each = lots.par_iter().zip(seeds).zip(given);
        each.map(|((lot, &seed), attributes)| {
            let options = Options {
                seed,
                limits,
                attributes,
                ..Options::default()
            };
            self.one(lot, rule, &options)
        })
        .collect()
    }

    pub(crate) fn start_rule(&self, name: Option<&str>) -> PyResult<usize> {
        let found = match name {
            Some(name) => self.code.rule_named(name),
            None => self.code.start,
        };
        let told = || match name {
            Some(name) => format!("there is no rule `{name}`"),
            None => "there is no rule to start with".to_string(),
        };
        found.ok_or_else(|| GrammarFault::new_err(told()))
    }

    fn one(&self, lot: &Rings, rule: usize, options: &Options) -> Result<Derived, String> {
        let form = lot_form(lot).ok_or("the lot encloses nothing")?;
        let start = State::new(form, (options.seed & 0xffff_ffff) as u32);
        let tree = derive(&self.code, rule, start, options).map_err(|fault| {
            let name = self.text.name();
            if self.has_imports {
                // A fault does not say which file it is in.
                return format!("{name} or what it imports: {}", fault.message);
            }
            let place = self.text.position(fault.span.start);
            format!("{name}:{}:{}: {}", place.line, place.column, fault.message)
        })?;
        let packed = pack(&tree);
        let surfaces = surfaces(&tree, &packed);
        let name = |&node: &u32| tree.nodes[node as usize].name.to_string();
        Ok(Derived {
            names: surfaces.node.iter().map(name).collect(),
            pieces: pieces(&tree, &packed, &surfaces, MOST_IN_PIECE),
            packed,
            surfaces,
            log_prior: tree.log_prior,
            messages: tree.messages,
        })
    }
}

/// The columns of one lot.
#[pyclass(frozen, get_all, module = "veduta._core")]
struct DerivedLot {
    positions_m: Py<PyArray2<f64>>,
    uv: Py<PyArray2<f32>>,
    ring_offsets: Py<PyArray1<i64>>,
    polygon_offsets: Py<PyArray1<i64>>,
    /// The surface that each polygon belongs to.
    polygon_feature: Py<PyArray1<i32>>,
    polygon_look: Py<PyArray1<i32>>,
    feature_name: Vec<String>,
    /// What each surface is, as the rules have it; empty where they do not say it.
    feature_class: Vec<String>,
    feature_size_m: Py<PyArray2<f64>>,
    /// Red, green, blue, opacity (0 to 1), texture and class of each look.
    looks: Vec<(f32, f32, f32, f32, Option<String>, String)>,
    log_prior: f64,
    messages: Vec<String>,
}

fn to_python<'py>(py: Python<'py>, found: Result<Derived, String>) -> PyResult<Bound<'py, PyAny>> {
    let derived = match found {
        Ok(derived) => derived,
        Err(why) => return Ok(why.into_pyobject(py)?.into_any()),
    };
    let (packed, surfaces) = (derived.packed, derived.surfaces);
    let of_polygon = |column: &[u32]| -> Vec<i32> {
        let leaves = packed.polygon_feature.iter();
        leaves.map(|&leaf| column[leaf as usize] as i32).collect()
    };
    let looks = packed.looks.iter().map(|look| {
        let [r, g, b] = look.colour;
        let texture = look.texture.as_ref().map(ToString::to_string);
        (r, g, b, look.opacity, texture, look.class.to_string())
    });
    let lot = DerivedLot {
        positions_m: rows(&packed.positions).into_pyarray(py).unbind(),
        uv: rows(&packed.uv).into_pyarray(py).unbind(),
        ring_offsets: packed.ring_offsets.into_pyarray(py).unbind(),
        polygon_offsets: packed.polygon_offsets.into_pyarray(py).unbind(),
        polygon_feature: of_polygon(&surfaces.of_feature).into_pyarray(py).unbind(),
        polygon_look: of_polygon(&packed.feature_look).into_pyarray(py).unbind(),
        feature_name: derived.names,
        feature_class: surfaces.class.iter().map(ToString::to_string).collect(),
        feature_size_m: rows(&surfaces.size).into_pyarray(py).unbind(),
        looks: looks.collect(),
        log_prior: derived.log_prior,
        messages: derived.messages,
    };
    Ok(Bound::new(py, lot)?.into_any())
}

fn rows<T: Copy, const N: usize>(tuples: &[[T; N]]) -> Array2<T> {
    Array2::from_shape_fn((tuples.len(), N), |(row, column)| tuples[row][column])
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("GrammarFault", m.py().get_type::<GrammarFault>())?;
    m.add_class::<GrammarRules>()?;
    m.add_class::<DerivedLot>()
}
