//! Every type of roof over 120 real buildings that other roof software fails on. What is asserted
//! is measured here anew.
//!
//! Each type takes every fourth building, beginning with another one; all of them take
//! `cargo test --release -p veduta-geometry roof_types -- --ignored`, and in Python
//! `tests/regression/test_roofs.py` goes over all.

#![allow(clippy::unwrap_used)] // helpers of tests

use veduta_geometry::skeleton::SkeletonError;
use veduta_geometry::solid::{roofed_over, Overhang, RoofKind};

use crate::footprints;

use crate::roof_kinds;

use footprints::hard_footprints;
use roof_kinds::{fault, kinds, sheet};

#[test]
fn types_of_roof_over_every_fourth_footprint() {
    check(4);
}

#[test]
#[ignore = "takes long without optimization"]
fn types_of_roof_over_every_footprint() {
    check(1);
}

/// Asserts that no type fails over one footprint in `step`; each type begins with another one.
fn check(step: usize) {
    let footprints = hard_footprints().unwrap_or_default();
    let mut all = 0;
    let mut faults = Vec::new();
    for (number, (kind_name, kind)) in kinds().into_iter().enumerate() {
        let mut failed = 0;
        for (name, rings) in footprints.iter().skip(number % step).step_by(step) {
            for overhang in [0.0, 0.4] {
                let out = Overhang {
                    eaves: overhang,
                    gables: 0.5 * overhang,
                };
                let wrong = match roofed_over(&sheet(rings), &kind, 0.9, out) {
                    Ok(solid) => {
                        // With an overhang what looks up is as large as the floor.
                        let floor = || -> f64 {
                            let down = solid.faces().map(|face| face.area_vector().z);
                            -down.filter(|z| *z < 0.0).sum::<f64>()
                        };
                        let outline = (overhang > 0.0).then(floor);
                        fault(&solid, rings, outline)
                    }
                    Err(SkeletonError::NoApex) if kind == RoofKind::Pyramid => continue,
                    Err(SkeletonError::FoldedGable) if kind_name == "even gable" => continue,
                    Err(error) => Some(error.to_string()),
                };
                if let Some(wrong) = wrong {
                    failed += usize::from(overhang == 0.0);
                    faults.push(format!("{kind_name} {overhang} {name}: {wrong}"));
                }
            }
        }
        all += usize::from(failed == 0);
    }
    assert!(faults.is_empty() && all >= 12, "{}", faults.join("\n"));
}
