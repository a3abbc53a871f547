//! One derivation for Python: its tree of shapes, looked at without copying, and edited in place.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use veduta_grammar::engine::{
    derive, lot_form, rederive, to_place, Edit, Node, Options, Overrides, State, Tree,
};

use crate::derived_lot::{derived_of, lot_to_python, rows, DerivedLot};
use crate::given::{values, Given, GivenBack};
use crate::grammar::{GrammarFault, GrammarRules, Rings};
use crate::limits::{limits_of, GrammarLimits};
use crate::surroundings::{neighbours, Beside, Surroundings};

/// Path, name or None, whether to delete, alternatives or None for those to draw, and values.
pub type GivenEdit = (
    Vec<u32>,
    Option<String>,
    bool,
    Vec<Option<u16>>,
    Vec<(String, Given)>,
);

/// The edits of a lot as the engine takes them.
pub fn overrides_of(edits: Vec<GivenEdit>) -> Overrides {
    Overrides::new(
        edits
            .into_iter()
            .map(|(path, name, delete, choices, values)| {
                let values = values.into_iter();
                let edit = Edit {
                    name: name.map(Arc::from),
                    delete,
                    choices,
                    values: values
                        .map(|(name, value)| (name.into(), value.into()))
                        .collect(),
                };
                (path, edit)
            }),
    )
}

/// What became of the edits that could not be done: path and fault.
pub fn edit_faults(tree: &Tree) -> Vec<(Vec<u32>, String)> {
    let faults = tree.edited.iter();
    faults
        .filter_map(|one| Some((one.path.clone(), one.fault.clone()?)))
        .collect()
}

/// A derivation that stays: shapes are named by their number in the tree, which a later
/// `rederive` may change.
#[pyclass(module = "veduta._core")]
struct Derivation {
    rules: Py<GrammarRules>,
    options: Options,
    tree: Tree,
}

/// Corners, first corner of each ring, first ring of each polygon; each with the end.
type Polygons = (Py<PyArray2<f64>>, Py<PyArray1<i64>>, Py<PyArray1<i64>>);

#[pymethods]
impl Derivation {
    #[new]
    #[pyo3(signature = (rules, lot, seed, *, start=None, attributes=None, edits=None, around=None, beside=None, limits=None))]
    #[allow(clippy::too_many_arguments)] // as Python calls it: with names
    fn new(
        py: Python<'_>,
        rules: Py<GrammarRules>,
        lot: Rings,
        seed: u64,
        start: Option<&str>,
        attributes: Option<HashMap<String, Given>>,
        edits: Option<Vec<GivenEdit>>,
        around: Option<&Surroundings>,
        beside: Option<Beside>,
        limits: Option<&GrammarLimits>,
    ) -> PyResult<Self> {
        let beside = beside.map(|one| vec![one]);
        let neighbours = neighbours(around, beside, 1)?.pop().unwrap_or_default();
        let options = Options {
            seed,
            limits: limits_of(limits),
            attributes: values(attributes.unwrap_or_default()),
            overrides: overrides_of(edits.unwrap_or_default()),
            assets: rules.get().known_assets(),
            textures: rules.get().known_textures(),
            files: rules.get().known_files(),
            neighbours,
        };
        let with = rules.get();
        let rule = with.start_rule(start)?;
        let form = lot_form(&lot);
        let form = form.ok_or_else(|| GrammarFault::new_err("the lot encloses nothing"))?;
        let start = State::new(form, (seed & 0xffff_ffff) as u32);
        let tree = py.detach(|| derive(&with.code, rule, start, &options));
        let tree = tree.map_err(|fault| with.raised(&fault))?;
        Ok(Self {
            rules,
            options,
            tree,
        })
    }

    /// Derives the shape at `path` anew with these edits of the whole tree, and leaves the rest.
    /// False where there is no such shape.
    fn rederive(
        &mut self,
        py: Python<'_>,
        path: Vec<u32>,
        edits: Vec<GivenEdit>,
    ) -> PyResult<bool> {
        let before = std::mem::replace(&mut self.options.overrides, overrides_of(edits));
        let with = self.rules.get();
        self.options.assets = with.known_assets();
        let (tree, options) = (&mut self.tree, &self.options);
        let found = py.detach(|| rederive(&with.code, tree, &path, options));
        found.map_err(|fault| {
            self.options.overrides = before;
            with.raised(&fault)
        })
    }

    /// Another derivation with the same shapes, which a later `rederive` of this one leaves alone.
    fn copy(&self, py: Python<'_>) -> Derivation {
        Derivation {
            rules: self.rules.clone_ref(py),
            options: self.options.clone(),
            tree: self.tree.clone(),
        }
    }

    /// The numbers of the shapes whose rules took random alternatives, in the order of the tree.
    #[getter]
    fn random_shapes(&self) -> Vec<u32> {
        let all = (0..).zip(&self.tree.nodes);
        all.filter(|(_, node)| !node.choices.is_empty())
            .map(|(number, _)| number)
            .collect()
    }

    fn __len__(&self) -> usize {
        self.tree.nodes.len()
    }

    fn __repr__(&self) -> String {
        let (name, shapes) = (self.rules.get().name(), self.tree.nodes.len());
        format!("Derivation({name:?}, shapes={shapes})")
    }

    #[getter]
    fn log_prior(&self) -> f64 {
        self.tree.log_prior
    }

    /// Attributes (True) and constants that were needed or drawn by chance: name and value.
    #[getter]
    fn values(&self) -> Vec<(String, bool, GivenBack)> {
        let all = self.tree.globals.iter();
        all.map(|one| (one.name.to_string(), one.is_attribute, (&one.value).into()))
            .collect()
    }

    #[getter]
    fn reports(&self) -> Vec<(String, GivenBack)> {
        let all = self.tree.reports.iter();
        all.map(|(key, value)| (key.to_string(), value.into()))
            .collect()
    }

    #[getter]
    fn messages(&self) -> Vec<String> {
        self.tree.messages.clone()
    }

    /// Path and fault of each edit that could not be done.
    #[getter]
    fn edit_faults(&self) -> Vec<(Vec<u32>, String)> {
        edit_faults(&self.tree)
    }

    /// The number of the shape at a path; None where there is none.
    fn find(&self, path: Vec<u32>) -> Option<u32> {
        self.tree.find(&path)
    }

    fn path(&self, shape: u32) -> PyResult<Vec<u32>> {
        self.node(shape)?;
        Ok(self.tree.path(shape))
    }

    fn parent(&self, shape: u32) -> PyResult<Option<u32>> {
        Ok(self.node(shape)?.parent)
    }

    /// The numbers of the shapes that were made from it: the first, and the one after the last.
    fn children(&self, shape: u32) -> PyResult<(u32, u32)> {
        self.node(shape)?;
        let Range { start, end } = self.tree.children(shape);
        Ok((start, end))
    }

    fn name(&self, shape: u32) -> PyResult<String> {
        Ok(self.node(shape)?.name.to_string())
    }

    /// Whether it stays: no rule was applied to it.
    fn is_leaf(&self, shape: u32) -> PyResult<bool> {
        Ok(self.node(shape)?.rule.is_none())
    }

    /// Name and value of what its rule was given.
    fn parameters(&self, shape: u32) -> PyResult<Vec<(String, GivenBack)>> {
        let node = self.node(shape)?;
        let Some(rule) = node.rule else {
            return Ok(Vec::new());
        };
        let names = self.rules.get().code.rules[rule as usize].params.iter();
        let pairs = names.zip(&node.args);
        Ok(pairs
            .map(|(name, value)| (name.to_string(), value.into()))
            .collect())
    }

    /// The random alternatives of its rule: which one, of how many, and its chance.
    fn choices(&self, shape: u32) -> PyResult<Vec<(u16, u16, f64)>> {
        let taken = self.node(shape)?.choices.iter();
        Ok(taken.map(|one| (one.index, one.of, one.chance)).collect())
    }

    /// What it is in the model; empty where the rules do not say it.
    fn surface_class(&self, shape: u32) -> PyResult<String> {
        Ok(self.node(shape)?.state.look.class.to_string())
    }

    /// sRGB, 0 to 1.
    fn colour(&self, shape: u32) -> PyResult<[f32; 3]> {
        Ok(self.node(shape)?.state.look.colour)
    }

    /// Size of its scope (m): along x and y of its face, and z out of it.
    fn size_m(&self, shape: u32) -> PyResult<[f64; 3]> {
        Ok(self.node(shape)?.state.form.scope.size.to_array())
    }

    /// Where its scope begins (m), in the frame of places: x east, y north, z up.
    fn origin_m(&self, shape: u32) -> PyResult<[f64; 3]> {
        Ok(to_place(self.node(shape)?.state.form.scope.origin))
    }

    /// The polygons of one shape, in the frame of places: corners (n, 3) in metres, the first
    /// corner of each ring and the first ring of each polygon, each with the end.
    fn polygons(&self, py: Python<'_>, shape: u32) -> PyResult<Polygons> {
        let mesh = self.node(shape)?.state.form.world_mesh();
        let (mut corners, mut rings, mut polygons) = (Vec::new(), vec![0], vec![0]);
        for face in mesh.faces() {
            for ring in face.rings() {
                corners.extend(ring.iter().map(|&at| to_place(mesh.points[at as usize])));
                rings.push(corners.len() as i64);
            }
            polygons.push(rings.len() as i64 - 1);
        }
        Ok((
            rows(&corners).into_pyarray(py).unbind(),
            rings.into_pyarray(py).unbind(),
            polygons.into_pyarray(py).unbind(),
        ))
    }

    /// The columns of all leaves.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, DerivedLot>> {
        let (tree, code) = (&self.tree, &self.rules.get().code);
        lot_to_python(py, py.detach(|| derived_of(tree, code)))
    }
}

impl Derivation {
    fn node(&self, shape: u32) -> PyResult<&Node> {
        let missing = || {
            let count = self.tree.nodes.len();
            PyIndexError::new_err(format!("shape {shape} of {count}"))
        };
        self.tree.nodes.get(shape as usize).ok_or_else(missing)
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<Derivation>()
}
