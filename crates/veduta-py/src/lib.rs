//! The private extension `veduta._core`: it registers one module per topic and does nothing else.

use pyo3::prelude::*;

mod chain;
mod city;
mod compress;
mod derived_lots;
mod grammar;
mod polygons;
mod rules;
mod tiles;

#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    chain::register(m)?;
    grammar::register(m)?;
    rules::register(m)?;
    compress::register(m)?;
    derived_lots::register(m)?;
    tiles::register(m)?;
    polygons::register(m)
}
