//! Lots a few at a time, so that Ctrl-C is heard between them.

use pyo3::prelude::*;
use rayon::prelude::*;
use veduta_grammar::engine::Options;

use crate::grammar::Rings;

/// Lots that are derived before Ctrl-C is heard.
const AT_ONCE: usize = 4;

/// What `derive` makes of each lot, the GIL released.
pub fn of_each_lot<T: Send>(
    py: Python<'_>,
    lots: &[Rings],
    options: &[Options],
    derive: impl Fn(&Rings, &Options) -> T + Sync,
) -> PyResult<Vec<T>> {
    let mut found = Vec::with_capacity(lots.len());
    for (lots, options) in lots.chunks(AT_ONCE).zip(options.chunks(AT_ONCE)) {
        found.extend(py.detach(|| {
            let each = lots.par_iter().zip(options);
            each.map(|(lot, options)| derive(lot, options))
                .collect::<Vec<T>>()
        }));
        py.check_signals()?;
    }
    Ok(found)
}
