//! Rule files and lots for tests of derivations.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec3;
use veduta_geometry::solid::{cube, Mesh};
use veduta_grammar::engine::{derive, lot_form, lower, Code, Fault, Limits, Options, State, Tree};
use veduta_grammar::shape::{Asset, Form, Geometry, Scope};
use veduta_grammar::{check, Program, Source};

pub fn code(text: &str) -> Code {
    let program = Program::single(Source::new("test.cga", text));
    let checked = check(&program);
    assert!(!checked.has_errors(), "{}", checked.render(&program));
    let lowered = lower(&program, &checked);
    assert!(!lowered.has_errors(), "{:?}", lowered.diagnostics);
    lowered.code
}

/// A lot of 10 m by 6 m: x to the east, the front (z) in the south.
pub fn lot() -> State {
    let form = Form {
        scope: Scope::of_size(DVec3::new(10.0, 0.0, 6.0)),
        geometry: Geometry::Rectangle(1),
    };
    State::new(form, 0)
}

/// A lot with its corners at these places east and north.
pub fn lot_of(rings: &[&[(f64, f64)]]) -> State {
    let ring = |ring: &&[(f64, f64)]| ring.iter().map(|&(x, y)| [x, y, 0.0]).collect();
    State::new(
        lot_form(&rings.iter().map(ring).collect::<Vec<_>>()).unwrap(),
        0,
    )
}

/// One asset, `brick.obj`: a box of 2 m by 1 m by 1 m from its origin on.
pub fn assets() -> Arc<HashMap<Arc<str>, Arc<Asset>>> {
    let size = DVec3::new(2.0, 1.0, 1.0);
    let mesh = cube().mapped(|unit| unit * size);
    let asset = Asset::new("brick.obj".into(), mesh, (DVec3::ZERO, size)).unwrap();
    Arc::new(HashMap::from([(asset.name.clone(), Arc::new(asset))]))
}

pub fn derived(text: &str, start: State) -> Result<Tree, Fault> {
    let code = code(text);
    let options = Options {
        limits: Limits {
            depth: 50,
            shapes: 100_000,
            ..Limits::default()
        },
        assets: assets(),
        ..Options::default()
    };
    derive(&code, code.start.unwrap(), start, &options)
}

pub fn tree(text: &str) -> Tree {
    derived(text, lot()).unwrap()
}

pub fn fault(text: &str) -> String {
    derived(text, lot()).unwrap_err().message
}

/// What `print` wrote.
pub fn said(text: &str) -> Vec<String> {
    tree(text).messages
}

/// The same with other options.
pub fn said_with(text: &str, options: &Options) -> Vec<String> {
    let code = code(text);
    derive(&code, code.start.unwrap(), lot(), options)
        .unwrap()
        .messages
}

/// The faces of all leaves of a name, in the world.
pub fn mesh_of(tree: &Tree, name: &str) -> Vec<Mesh> {
    tree.leaves()
        .filter(|leaf| leaf.name.as_ref() == name)
        .map(|leaf| leaf.state.form.world_mesh())
        .collect()
}

pub fn areas(tree: &Tree, name: &str) -> Vec<f64> {
    let rounded = |area: f64| (area * 1e6).round() / 1e6;
    let meshes = mesh_of(tree, name);
    meshes.iter().map(|mesh| rounded(mesh.area())).collect()
}

/// The one closed solid of a derivation, and its volume (m3).
pub fn solid(tree: &Tree) -> (Mesh, f64) {
    let mut all: Vec<Mesh> = tree
        .leaves()
        .map(|leaf| leaf.state.form.world_mesh())
        .collect();
    assert_eq!(all.len(), 1);
    let mesh = all.remove(0);
    assert!(mesh.is_closed());
    let volume = mesh.volume();
    (mesh, volume)
}
