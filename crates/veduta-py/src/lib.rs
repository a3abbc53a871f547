//! The private extension `veduta._core`: it registers one module per topic and does nothing else.

use pyo3::prelude::*;

mod chain;
mod derivation;
mod derived_lot;
mod given;
mod grammar;
mod polygons;
mod roofs;
mod rules;

#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    chain::register(m)?;
    grammar::register(m)?;
    derivation::register(m)?;
    roofs::register(m)?;
    rules::register(m)?;
    polygons::register(m)
}
