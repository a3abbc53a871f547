//! The private extension `veduta._core`: it registers one module per topic and does nothing else.

use pyo3::prelude::*;

mod assets;
#[cfg(feature = "gpu")]
mod cards;
mod carve;
mod chain;
mod city;
mod city_looks;
mod compress;
mod depth_maps;
mod derivation;
mod derived_lot;
mod derived_lots;
mod flat;
mod foreground;
mod given;
mod grammar;
mod interruptible;
mod limits;
mod linking;
mod localise;
mod lot_outcome;
mod occupancy;
mod pace;
mod polygons;
mod roofs;
mod rules;
mod standing;
mod stereo;
mod stereo_rules;
mod surface;
mod surroundings;
mod sweeping;
mod texture;
mod tile_buffers;
mod tiles;
mod two_views;
mod volumes;
mod walk;

#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    #[cfg(feature = "gpu")]
    cards::register(m)?;
    carve::register(m)?;
    sweeping::register(m)?;
    chain::register(m)?;
    compress::register(m)?;
    foreground::register(m)?;
    grammar::register(m)?;
    limits::register(m)?;
    localise::register(m)?;
    linking::register(m)?;
    occupancy::register(m)?;
    derivation::register(m)?;
    roofs::register(m)?;
    rules::register(m)?;
    derived_lots::register(m)?;
    depth_maps::register(m)?;
    stereo::register(m)?;
    stereo_rules::register(m)?;
    surface::register(m)?;
    surroundings::register(m)?;
    texture::register(m)?;
    tile_buffers::register(m)?;
    two_views::register(m)?;
    polygons::register(m)?;
    walk::register(m)
}
