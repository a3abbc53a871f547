//! The time that hip roofs take over real buildings; nothing is asserted of times.
//!
//! `cargo test --release -p veduta-geometry roof_times -- --ignored --nocapture`

use crate::footprints;

use std::time::Instant;

use veduta_geometry::skeleton::{check, roof, Eaves};

const RUNS: usize = 21;

#[test]
#[ignore = "prints a table of times"]
fn hip_roofs_over_the_hard_footprints() {
    let Some(footprints) = footprints::hard_footprints() else {
        return;
    };
    let mut rows = Vec::new();
    for (name, rings) in &footprints {
        let mut times_ms = Vec::new();
        for _ in 0..RUNS {
            let start = Instant::now();
            std::hint::black_box(roof(&Eaves::even(rings).unwrap(), None).is_ok());
            times_ms.push(start.elapsed().as_secs_f64() * 1e3);
        }
        times_ms.sort_by(f64::total_cmp);
        rows.push((times_ms[RUNS / 2], name, Eaves::even(rings).unwrap()));
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!("       ms  edges  nodes  off plane m  area error  runs  footprint");
    for (time_ms, name, eaves) in &rows {
        let hip = roof(eaves, None).unwrap();
        let sound = check(eaves, &hip).unwrap();
        let area_error = (sound.covered_m2 / eaves.area_m2() - 1.0).abs();
        println!(
            "{time_ms:9.4}  {:5}  {:5}  {:11.1e}  {area_error:10.1e}  {:4}  {name}",
            eaves.len(),
            hip.nodes_m.len(),
            sound.off_plane_m,
            hip.attempts
        );
    }
    let (middle, most) = (rows[rows.len() / 2].0, rows[rows.len() - 1].0);
    println!("median {middle:.4} ms, most {most:.4} ms");
}
