//! Deriving: a rule file and a start shape to a tree of shapes.
//!
//! [`lower`] makes [`Code`] of checked files once; [`derive()`] runs it for one start shape, and may
//! be called from many threads. Frame of rule files: metres, right-handed, y up.

mod arrays;
mod asset_info;
mod asset_names;
mod clock;
mod code;
mod colours;
mod converting;
mod draws;
mod edges;
mod evaluate;
mod fault;
mod files;
mod frame;
mod functions;
mod geographic;
mod globals;
mod indexing;
mod instances;
mod laid;
mod limits;
mod lists;
mod lot;
mod lower;
mod lower_body;
mod lower_expression;
mod marks;
mod material_files;
mod materials;
mod measures;
mod nested;
mod occluders;
mod operations;
mod operators;
mod overrides;
mod pack;
mod pieces;
mod queries;
mod random;
mod rederive;
mod regexes;
mod run;
mod selection;
mod separate;
mod shape_attributes;
mod sorting;
mod state;
mod steps;
mod strings;
mod surfaces;
mod texture_map;
mod tree;
mod value;

pub use asset_names::{asset_names, AssetNames};
pub use code::{Code, Expr, ExprKind};
pub use draws::Taken;
pub use edges::PREFIX as EDGES;
pub use fault::Fault;
pub use files::{FileFunction, Files};
pub use geographic::ON_EARTH;
pub use limits::{Limit, Limits};
pub use lot::lot_form;
pub use lower::{lower, lower_in_style, Lowered};
pub use occluders::{Neighbour, Occluder};
pub use operations::names as operation_names;
pub use overrides::{Edit, Edited, Overrides};
pub use pack::{from_place, pack, to_place, Packed};
pub use pieces::pieces;
pub use random::Stream;
pub use rederive::rederive;
pub use run::{derive, occluders, Options};
pub use state::{Extra, Look, Place, State};
pub use surfaces::{surfaces, Surfaces};
pub use texture_map::TextureMap;
pub use tree::{Known, Node, Told, Tree};
pub use value::{Array, Value};

/// The names of all functions that derive.
pub fn function_names() -> impl Iterator<Item = &'static str> {
    functions::Function::names()
        .chain(measures::Measure::names())
        .chain(queries::Query::names())
        .chain(sorting::Sorting::names())
        .chain(files::TABLE.iter().map(|entry| entry.0))
        .chain(["comp"])
}

/// The names of all shape attributes that derive.
pub fn attribute_names() -> impl Iterator<Item = &'static str> {
    shape_attributes::ShapeAttribute::names()
}
