//! How fast rules are derived, with nothing kept. For benchmarks.

use pyo3::prelude::*;
use rayon::prelude::*;
use veduta_grammar::engine::{derive, lot_form, pack, Options, State};

use crate::grammar::{GrammarFault, GrammarRules, Rings};

/// Derives and packs the lots on so many cores: how many leaves and polygons there were, and the
/// seconds that it took.
pub fn pace(
    rules: &GrammarRules,
    py: Python<'_>,
    lots: &[Rings],
    seeds: &[u64],
    cores: usize,
    start: Option<&str>,
) -> PyResult<(usize, usize, f64)> {
    let (rule, assets) = (rules.start_rule(start)?, rules.known_assets());
    let textures = rules.known_textures();
    let one = |(lot, &seed): (&Rings, &u64)| {
        let form = lot_form(lot).ok_or("the lot encloses nothing")?;
        let options = Options {
            seed,
            assets: assets.clone(),
            textures: textures.clone(),
            ..Options::default()
        };
        let state = State::new(form, (seed & 0xffff_ffff) as u32);
        let tree = derive(&rules.code, rule, state, &options).map_err(|fault| fault.message)?;
        let packed = pack(&tree);
        let leaves = packed.feature_node.len();
        Ok::<_, String>((leaves, packed.polygon_feature.len()))
    };
    let measured: Result<_, String> = py.detach(|| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores).build();
        let pool = pool.map_err(|why| why.to_string())?;
        let began = std::time::Instant::now();
        let sum = |a: (usize, usize), b: (usize, usize)| Ok((a.0 + b.0, a.1 + b.1));
        let work = || {
            lots.par_iter()
                .zip(seeds)
                .map(one)
                .try_reduce(|| (0, 0), sum)
        };
        let (leaves, polygons) = pool.install(work)?;
        Ok((leaves, polygons, began.elapsed().as_secs_f64()))
    });
    measured.map_err(GrammarFault::new_err)
}
