//! Properties of roofs over random outlines. That a roof is closed, planar, free of overlaps and as
//! large as its eaves is asserted by `check`, which `roof` runs on all it gives; here the heights
//! are compared with closed forms and with the same roof built otherwise.

use proptest::prelude::*;
use veduta_geometry::skeleton::{check, roof, Eaves, Roof, RoofFault, SkeletonError};

use crate::shapes;

use shapes::{convex, height_m, moved, rectilinear, regular, star, Rings};

/// Points within the bounding box, from fractions of it.
fn spots(rings: &Rings, shares: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let axis = |k: usize| {
        let values = rings[0].iter().map(|point| point[k]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        (low, values.fold(f64::NEG_INFINITY, f64::max) - low)
    };
    let ((x, width), (y, depth)) = (axis(0), axis(1));
    let spot = |share: &[f64; 2]| [x + share[0] * width, y + share[1] * depth];
    shares.iter().map(spot).collect()
}

fn shares() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(prop::array::uniform2(0.01..0.99f64), 30)
}

/// The time at which the first of all edges reaches a point: the lower envelope of the planes.
fn envelope(ring: &[[f64; 2]], speeds: &[f64], [x, y]: [f64; 2]) -> f64 {
    let time = |k: usize| {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        (dx * (y - a[1]) - dy * (x - a[0])) / dx.hypot(dy) / speeds[k]
    };
    (0..ring.len()).map(time).fold(f64::INFINITY, f64::min)
}

fn same_roof(
    one: &Roof,
    other: &Roof,
    spots: &[([f64; 2], [f64; 2])],
    scale: f64,
) -> Result<(), TestCaseError> {
    prop_assert_eq!(one.faces.len(), other.faces.len());
    for (here, there) in spots {
        if let (Some(a), Some(b)) = (height_m(one, *here), height_m(other, *there)) {
            prop_assert!((a * scale - b).abs() < 1e-6 * scale, "{a} and {b}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn over_convex_outlines_it_is_the_lower_envelope(
        rings in convex(),
        speeds in prop::collection::vec(0.3..3.0f64, 25),
        even in any::<bool>(),
        shares in shares(),
    ) {
        let count = rings[0].len();
        let speeds = if even { vec![1.0; count] } else { speeds[..count].to_vec() };
        let Ok(eaves) = Eaves::new(&rings, &speeds) else { return Ok(()) };
        let found = roof(&eaves, None).unwrap();
        for spot in spots(&rings, &shares) {
            let wanted = envelope(&rings[0], &speeds, spot);
            if let Some(height) = height_m(&found, spot).filter(|_| wanted > 0.0) {
                prop_assert!((height - wanted).abs() < 1e-7, "{height} for {wanted}");
            }
        }
    }

    #[test]
    fn stars_have_roofs_that_move_with_them(
        rings in star(),
        turn in 0.0..6.3f64,
        scale in 0.01..100.0f64,
        shift in prop::array::uniform2(-1e4..1e4f64),
        shares in shares(),
    ) {
        let found = roof(&Eaves::even(&rings).unwrap(), None).unwrap();
        let elsewhere = moved(&rings, turn, scale, shift);
        let other = roof(&Eaves::even(&elsewhere).unwrap(), None).unwrap();
        let here = spots(&rings, &shares);
        let there = moved(&vec![here.clone()], turn, scale, shift).remove(0);
        let pairs: Vec<_> = here.into_iter().zip(there).collect();
        same_roof(&found, &other, &pairs, scale)?;
    }

    #[test]
    fn rectilinear_outlines_have_roofs_that_move_with_them(
        rings in rectilinear(),
        turn in 0.0..6.3f64,
        shares in shares(),
    ) {
        let Some(rings) = rings else { return Ok(()) };
        let found = roof(&Eaves::even(&rings).unwrap(), None).unwrap();
        let elsewhere = moved(&rings, turn, 1.0, [100.0, -30.0]);
        let other = roof(&Eaves::even(&elsewhere).unwrap(), None).unwrap();
        let here = spots(&rings, &shares);
        let there = moved(&vec![here.clone()], turn, 1.0, [100.0, -30.0]).remove(0);
        let pairs: Vec<_> = here.into_iter().zip(there).collect();
        same_roof(&found, &other, &pairs, 1.0)?;
        prop_assert_eq!(found.nodes_m.len(), other.nodes_m.len());
    }

    #[test]
    fn any_speeds_above_zero_have_a_roof(
        star in star(),
        cells in rectilinear(),
        speeds in prop::collection::vec(0.3..3.0f64, 120),
        few in any::<bool>(),
    ) {
        for rings in cells.into_iter().chain([star]) {
            let count = rings.iter().map(Vec::len).sum();
            let speed = |k: usize| {
                let speed = speeds[k % speeds.len()];
                if few { speed.ceil() } else { speed }
            };
            let own: Vec<f64> = (0..count).map(speed).collect();
            roof(&Eaves::new(&rings, &own).unwrap(), None).unwrap();
        }
    }

    #[test]
    fn gables_have_a_roof_or_no_top(
        rings in rectilinear(),
        gables in prop::collection::vec(prop::bool::weighted(0.3), 120),
    ) {
        let Some(rings) = rings else { return Ok(()) };
        let count = rings.iter().map(Vec::len).sum();
        let speed = |k: usize| if gables[k % gables.len()] { 0.0 } else { 1.0 };
        let own: Vec<f64> = (0..count).map(speed).collect();
        let eaves = Eaves::new(&rings, &own).unwrap();
        match roof(&eaves, None) {
            Ok(_) => {}
            Err(SkeletonError::Unbounded { .. }) => {
                prop_assert!(!roof(&eaves, Some(50.0)).unwrap().rest.is_empty());
            }
            Err(why) => return Err(TestCaseError::fail(why.to_string())),
        }
    }

    /// Points on straight walls that are off them by less than outlines are measured to. (With
    /// different speeds and noise near 1e-10 m, some 4 of 10 000 are refused.)
    #[test]
    fn walls_need_not_be_straight(
        rings in rectilinear(),
        power in 3..16i32,
        noise in prop::collection::vec(-0.5..0.5f64, 200),
        speeds in prop::option::of(prop::collection::vec(1..3u8, 100)),
    ) {
        let Some(mut rings) = rings else { return Ok(()) };
        let count = rings.iter().map(Vec::len).sum();
        for (coordinate, off) in rings.iter_mut().flatten().flatten().zip(noise.iter().cycle()) {
            *coordinate += off * 10f64.powi(-power);
        }
        let speeds = speeds.filter(|_| power < 8);
        let speed = |k: usize| speeds.as_ref().map_or(1.0, |s| f64::from(s[k % s.len()]));
        let own: Vec<f64> = (0..count).map(speed).collect();
        roof(&Eaves::new(&rings, &own).unwrap(), None).unwrap();
    }

    #[test]
    fn below_a_stop_nothing_changes(
        star in star(),
        cells in rectilinear(),
        share in 0.0..1.0f64,
        shares in shares(),
    ) {
        for rings in cells.into_iter().chain([star]) {
            let eaves = Eaves::even(&rings).unwrap();
            let whole = roof(&eaves, None).unwrap();
            let heights: Vec<f64> = whole.nodes_m[eaves.len()..].iter().map(|node| node[2]).collect();
            // A height of a node is where cutting is hardest.
            let stop_m = heights[(share * heights.len() as f64) as usize];
            let cut = roof(&eaves, Some(stop_m)).unwrap();
            for spot in spots(&rings, &shares) {
                let height = height_m(&whole, spot);
                match height_m(&cut, spot) {
                    Some(below) => {
                        prop_assert!(below <= stop_m + 1e-9);
                        prop_assert!(height.is_none_or(|height| (height - below).abs() < 1e-7));
                    }
                    None => prop_assert!(height.is_none_or(|height| height > stop_m - 1e-7)),
                }
            }
        }
    }
}

#[test]
fn regular_polygons_are_cones() {
    for corners in 3..400 {
        let rings = moved(
            &regular(corners, 10.0),
            0.1 * corners as f64,
            1.0,
            [3.0, 4.0],
        );
        let found = roof(&Eaves::even(&rings).unwrap(), None).unwrap();
        let height = 10.0 * (std::f64::consts::PI / corners as f64).cos();
        for node in &found.nodes_m[corners..] {
            let off = (node[0] - 3.0)
                .hypot(node[1] - 4.0)
                .max((node[2] - height).abs());
            assert!(off < 1e-7, "{corners} corners: {node:?}");
        }
        assert!(
            corners > 200 || found.nodes_m.len() == corners + 1,
            "{corners} corners"
        );
    }
}

#[test]
fn the_same_input_gives_the_same_roof() {
    let rings = regular(17, 5.0);
    let built = || roof(&Eaves::even(&rings).unwrap(), Some(2.0)).unwrap();
    assert_eq!(built(), built());
}

#[test]
fn a_spoilt_roof_is_found_out() {
    let house = vec![vec![[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]]];
    let eaves = Eaves::even(&house).unwrap();
    let sound = roof(&eaves, None).unwrap();
    let spoilt = |spoil: fn(&mut Roof)| {
        let mut roof = sound.clone();
        spoil(&mut roof);
        check(&eaves, &roof).unwrap_err()
    };
    let raised = spoilt(|roof| roof.nodes_m[4][2] += 1e-6);
    assert!(matches!(raised, RoofFault::NotPlanar { .. }), "{raised}");
    let sunk = spoilt(|roof| roof.nodes_m[4][2] = -1.0);
    assert!(matches!(sunk, RoofFault::Below { node: 4, .. }), "{sunk}");
    let open = spoilt(|roof| drop(roof.faces.pop()));
    assert!(matches!(open, RoofFault::Open { .. }), "{open}");
    let turned = spoilt(|roof| roof.faces[0].rings[0].reverse());
    assert!(matches!(turned, RoofFault::Open { .. }), "{turned}");
    let mut other = house.clone();
    other[0][2] = [13.0, 8.0];
    let elsewhere = check(&Eaves::even(&other).unwrap(), &sound);
    assert!(elsewhere.is_err());
}
