//! `veduta_grammar` for Python: rule files in, columns of polygons out, the GIL released between.

use std::collections::HashMap;
use std::sync::{Arc, RwLock};

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_grammar::engine::{
    asset_names, lower_in_style, Code, Expr, ExprKind, Files as FileTable, Limits, Options,
};
use veduta_grammar::{check_from, Checked, Program, Source, Style};

use crate::assets::{
    asset_of, labels_of, pairs, Assets, GivenLabels, GivenSlots, MissingAsset, Textures,
};
use crate::derivation::{overrides_of, GivenEdit};
use crate::derived_lot::{to_python, DerivedLot, Outcome};
use crate::given::{values, Given};
use crate::interruptible::of_each_lot;
use crate::limits::{limits_of, GrammarLimits};
use crate::pace::pace;
use crate::rules::{program_of, rendered, Files};

create_exception!(_core, GrammarFault, PyValueError);
// Told, and the name of the asset.
create_exception!(_core, AssetWanted, GrammarFault);

pub type Rings = Vec<Vec<[f64; 3]>>;

const WANTED: &str = "each lot needs a seed, attributes and edits";

/// Checked rule files, ready to derive.
#[pyclass(frozen, name = "GrammarRules", module = "veduta._core")]
pub struct GrammarRules {
    pub code: Code,
    /// The files, as faults number them.
    pub sources: Vec<Source>,
    assets: RwLock<Arc<Assets>>,
    files: RwLock<Arc<FileTable>>,
    /// What is built otherwise than the rules say, as text; empty where nothing is.
    notes: String,
    /// What would be a fault where it were reached, as text; empty where nothing is.
    unreached: String,
    textures: RwLock<Arc<Textures>>,
    styles: Vec<String>,
}

#[pymethods]
impl GrammarRules {
    /// `files` are name and text of each file, the main one first; the others are what it may
    /// import, under the names in its import statements.
    /// `style` is one of the main file's; `Default` where it is None. `start`: the rule that is
    /// derived with, where it is known; faults of rules that it does not reach are no faults.
    #[new]
    #[pyo3(signature = (files, style=None, start=None))]
    fn new(
        py: Python<'_>,
        files: Files,
        style: Option<&str>,
        start: Option<&str>,
    ) -> PyResult<Self> {
        py.detach(|| read(&files, style, start))
            .map_err(GrammarFault::new_err)
    }

    fn __repr__(&self) -> String {
        let globals = self.code.globals.iter();
        let (name, rules) = (self.name(), self.code.rules.len());
        let attributes = globals.filter(|global| global.is_attribute).count();
        format!("GrammarRules({name:?}, rules={rules}, attributes={attributes})")
    }

    /// The styles of the main file, `Default` first.
    #[getter]
    fn styles(&self) -> Vec<String> {
        self.styles.clone()
    }

    /// Names of the rules that need no arguments, the start rule first.
    #[getter]
    fn starts(&self) -> Vec<String> {
        let mut names: Vec<usize> = self.code.start.into_iter().collect();
        let all = 0..self.code.rules.len();
        names.extend(all.filter(|rule| {
            self.code.rules[*rule].params.is_empty() && Some(*rule) != self.code.start
        }));
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

    /// Whether they ask about shapes of other lots.
    #[getter]
    fn asks_beside(&self) -> bool {
        self.code.asks_beside
    }

    /// The names of assets that stand in the rules, and whether there are others that are computed.
    #[getter]
    fn asset_names(&self) -> (Vec<String>, bool) {
        let found = asset_names(&self.code);
        let written = found.written.iter().map(ToString::to_string).collect();
        (written, found.computed)
    }

    /// What is built otherwise than the rules say, with its places; empty where nothing is.
    #[getter]
    fn notes(&self) -> String {
        self.notes.clone()
    }

    /// What would be a fault where the start rule reached it, with its places.
    #[getter]
    fn unreached(&self) -> String {
        self.unreached.clone()
    }

    /// Whether they ask where shapes lie on Earth.
    #[getter]
    fn asks_place(&self) -> bool {
        self.code.asks_place
    }

    /// Whether the rules ask which files there are, and whether they read some.
    #[getter]
    fn asks_files(&self) -> (bool, bool) {
        (self.code.lists_files, self.code.reads_files)
    }

    /// Makes the files of a project known: their names, the content of those that are text, and the
    /// width and height of those that are pictures (px), and what assets say besides, by its keys.
    #[pyo3(signature = (names, texts, pictures, metadata=HashMap::new()))]
    fn add_files(
        &self,
        names: Vec<String>,
        texts: HashMap<String, String>,
        pictures: HashMap<String, [f64; 2]>,
        metadata: HashMap<String, HashMap<String, Given>>,
    ) -> PyResult<()> {
        let shared = |name: String| -> Arc<str> { name.into() };
        let mut names: Vec<Arc<str>> = names.into_iter().map(shared).collect();
        names.sort();
        names.dedup();
        let texts = texts.into_iter();
        let pictures = pictures.into_iter();
        let files = FileTable {
            names,
            texts: texts
                .map(|(name, text)| (name.into(), text.into()))
                .collect(),
            pictures: pictures.map(|(name, size)| (name.into(), size)).collect(),
            metadata: metadata
                .into_iter()
                .map(|(name, told)| (name.into(), values(told)))
                .collect(),
        };
        let fault = |_| PyValueError::new_err("files cannot be added now");
        *self.files.write().map_err(fault)? = Arc::new(files);
        Ok(())
    }

    /// Makes an asset known. `points`: (v, 3) metres, y up. `corners`: numbers of points, face by
    /// face, counter-clockwise seen from outside. `offsets`: (f + 1,) the first corner of each face.
    /// `box_m`: (2, 3) the corners of the box that fills a scope. `face_slot`: (f,) the slot of each
    /// face. `slots`: the colour of each (sRGB) or None for that of the shape, and the colour where
    /// the shape is white, and the texture or None: its name, its size in metres (None where it lies
    /// by `uv`), and its mean colour (sRGB).
    /// `labels`: the name of each slot's material, the group of each face, and the names of the groups.
    /// `in_plane`: whether z = 0 lies in the plane of a flat shape that it is put into; `panel`:
    /// whether it is thin there.
    /// `uv`: (c, 2) where each of `corners` lies on its slot's picture, from the lower left.
    #[pyo3(signature = (name, points, corners, offsets, box_m, face_slot=None, slots=None, labels=None, in_plane=false, panel=false, uv=None))]
    #[allow(clippy::too_many_arguments)] // columns
    fn add_asset(
        &self,
        name: &str,
        points: PyReadonlyArray2<'_, f64>,
        corners: PyReadonlyArray1<'_, u32>,
        offsets: PyReadonlyArray1<'_, i64>,
        box_m: PyReadonlyArray2<'_, f64>,
        face_slot: Option<PyReadonlyArray1<'_, i32>>,
        slots: Option<GivenSlots>,
        labels: Option<GivenLabels>,
        in_plane: bool,
        panel: bool,
        uv: Option<PyReadonlyArray2<'_, f32>>,
    ) -> PyResult<()> {
        let fault = || PyValueError::new_err(format!("asset {name}: no faces of points"));
        let (corners, offsets) = (corners.as_slice()?, offsets.as_slice()?);
        let looks = face_slot.zip(slots);
        let asset = asset_of(name, &points, corners, offsets, &box_m, looks).ok_or_else(fault)?;
        let mut asset = match labels {
            Some(labels) => asset.with_labels(labels_of(labels)).ok_or_else(fault)?,
            None => asset,
        };
        if let Some(uv) = uv {
            let own = pairs(&uv).ok_or_else(fault)?;
            asset = asset.with_uv(own).ok_or_else(fault)?;
        }
        asset.in_plane = in_plane;
        asset.panel = panel;
        let mut known = self.assets.write().map_err(|_| fault())?;
        Arc::make_mut(&mut known).insert(asset.name.clone(), Arc::new(asset));
        Ok(())
    }

    /// Makes textures known that cover so many metres to the right and up: they lie in metres where
    /// no rule says how they lie, and a name of a built-in one that is not among them is a fault.
    fn add_textures(&self, sizes_m: HashMap<String, [f64; 2]>) -> PyResult<()> {
        let is_size = |size: &[f64; 2]| size.iter().all(|side| (1e-3..1e6).contains(side));
        if let Some((name, _)) = sizes_m.iter().find(|(_, size)| !is_size(size)) {
            let fault = format!("texture {name}: not from a millimetre to 1000 km");
            return Err(PyValueError::new_err(fault));
        }
        let fault = |_| PyValueError::new_err("textures cannot be added now");
        let mut known = self.textures.write().map_err(fault)?;
        let sizes = sizes_m.into_iter();
        Arc::make_mut(&mut known).extend(sizes.map(|(name, size)| (name.into(), size)));
        Ok(())
    }

    /// Derives each lot (rings of x, y, z in metres, the outline first) with the seed and the
    /// attributes beside it. Per lot: the columns of its leaves, or the text of why there are none.
    #[pyo3(signature = (lots, seeds, *, start=None, attributes=None, edits=None, limits=None))]
    #[allow(clippy::too_many_arguments)] // as Python calls it: with names
    fn derive<'py>(
        &self,
        py: Python<'py>,
        lots: Vec<Rings>,
        seeds: Vec<u64>,
        start: Option<&str>,
        attributes: Option<Vec<HashMap<String, Given>>>,
        edits: Option<Vec<Vec<GivenEdit>>>,
        limits: Option<&GrammarLimits>,
    ) -> PyResult<Vec<Outcome<'py>>> {
        let rule = self.start_rule(start)?;
        let given = attributes.unwrap_or_else(|| lots.iter().map(|_| HashMap::new()).collect());
        let edits = edits.unwrap_or_else(|| lots.iter().map(|_| Vec::new()).collect());
        if seeds.len() != lots.len() {
            return Err(PyValueError::new_err(WANTED));
        }
        let options = self.options_of(&seeds, given, edits, limits_of(limits))?;
        let found = of_each_lot(py, &lots, &options, |lot, options| {
            self.one(lot, options, rule)
        })?;
        found.into_iter().map(|one| to_python(py, one)).collect()
    }

    /// Derives and packs the lots on so many cores, and keeps nothing: how many leaves and polygons
    /// there were, and the seconds that it took. For benchmarks.
    #[pyo3(signature = (lots, seeds, cores, *, start=None))]
    fn pace(
        &self,
        py: Python<'_>,
        lots: Vec<Rings>,
        seeds: Vec<u64>,
        cores: usize,
        start: Option<&str>,
    ) -> PyResult<(usize, usize, f64)> {
        pace(self, py, &lots, &seeds, cores, start)
    }
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

fn read(files: &Files, style: Option<&str>, start: Option<&str>) -> Result<GrammarRules, String> {
    let missing = || "no rule file is given".to_string();
    let program = program_of(files).ok_or_else(missing)?;
    let checked = check_from(&program, start);
    if checked.has_errors() {
        return Err(checked.render(&program));
    }
    let styles = style_names(&program, &checked);
    let wanted = style.unwrap_or("Default");
    let style = styles.iter().position(|one| one == wanted);
    let style = style.ok_or_else(|| format!("{} has no style `{wanted}`", files[0].0))?;
    let lowered = lower_in_style(&program, &checked, style);
    if lowered.has_errors() {
        return Err(rendered(&program, &lowered.diagnostics));
    }
    let rendered_notes = rendered(&program, &lowered.diagnostics);
    let unreached = rendered(&program, &checked.unreached);
    Ok(GrammarRules {
        code: lowered.code,
        sources: program.units.into_iter().map(|unit| unit.source).collect(),
        assets: RwLock::default(),
        files: RwLock::default(),
        notes: rendered_notes,
        unreached,
        textures: RwLock::default(),
        styles,
    })
}

fn style_names(program: &Program, checked: &Checked) -> Vec<String> {
    let main = checked.definitions.first();
    let styles = main.into_iter().flat_map(|defined| &defined.styles);
    let name = |style: &Style| {
        style
            .name
            .map_or("Default", |name| program.names.text(name))
    };
    styles.map(|style| name(style).to_string()).collect()
}

impl GrammarRules {
    /// The name of the main file.
    pub fn name(&self) -> &str {
        self.sources.first().map_or("", Source::name)
    }

    pub fn start_rule(&self, name: Option<&str>) -> PyResult<usize> {
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

    /// How each lot is to be derived: of lots that stand alone.
    pub fn options_of(
        &self,
        seeds: &[u64],
        given: Vec<HashMap<String, Given>>,
        edits: Vec<Vec<GivenEdit>>,
        limits: Limits,
    ) -> PyResult<Vec<Options>> {
        if [given.len(), edits.len()] != [seeds.len(); 2] {
            return Err(PyValueError::new_err(WANTED));
        }
        let (assets, textures) = (self.known_assets(), self.known_textures());
        let files = self.known_files();
        let each = seeds.iter().zip(given).zip(edits);
        let each = each.map(|((&seed, given), edits)| Options {
            seed,
            limits,
            attributes: values(given),
            assets: assets.clone(),
            textures: textures.clone(),
            files: files.clone(),
            overrides: overrides_of(edits),
            neighbours: Vec::new(),
        });
        Ok(each.collect())
    }

    /// The files that the rules may ask for.
    pub fn known_files(&self) -> Arc<FileTable> {
        self.files
            .read()
            .map_or_else(|_| Arc::default(), |known| known.clone())
    }

    /// The textures of known sizes.
    pub fn known_textures(&self) -> Arc<Textures> {
        self.textures
            .read()
            .map_or_else(|_| Arc::default(), |known| known.clone())
    }

    /// The assets that are known by now.
    pub fn known_assets(&self) -> Arc<Assets> {
        self.assets
            .read()
            .map_or_else(|_| Arc::default(), |known| known.clone())
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("AssetWanted", m.py().get_type::<AssetWanted>())?;
    m.add("GrammarFault", m.py().get_type::<GrammarFault>())?;
    m.add_class::<GrammarRules>()?;
    m.add_class::<MissingAsset>()?;
    m.add_class::<DerivedLot>()
}
