//! Roofs worked out by hand: where every ridge, hip and valley meets.

use veduta_geometry::skeleton::{roof, Eaves, FaceOrigin, Roof, SkeletonError};

fn built(
    rings: &[Vec<[f64; 2]>],
    speeds: Option<&[f64]>,
    stop_m: Option<f64>,
) -> Result<Roof, SkeletonError> {
    let even = vec![1.0; rings.iter().map(Vec::len).sum()];
    let eaves = Eaves::new(rings, speeds.unwrap_or(&even))?;
    roof(&eaves, stop_m)
}

/// The inner nodes are these, in any order, within 1e-9 m.
fn assert_nodes((roof, vertices): &(Roof, usize), wanted: &[[f64; 3]]) {
    let inner = &roof.nodes_m[*vertices..];
    assert_eq!(inner.len(), wanted.len(), "{inner:?}");
    for node in wanted {
        let near = |other: &[f64; 3]| (0..3).all(|k| (other[k] - node[k]).abs() < 1e-9);
        assert!(inner.iter().any(near), "{node:?} is not in {inner:?}");
    }
}

fn hip(outline: Vec<[f64; 2]>) -> Result<(Roof, usize), SkeletonError> {
    let vertices = outline.len();
    Ok((built(&[outline], None, None)?, vertices))
}

fn house() -> Vec<[f64; 2]> {
    vec![[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]]
}

#[test]
fn a_rectangle_has_a_ridge_and_a_square_a_point() {
    assert_nodes(&hip(house()).unwrap(), &[[4.0, 4.0, 4.0], [8.0, 4.0, 4.0]]);
    let square = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
    assert_nodes(&hip(square).unwrap(), &[[3.0, 3.0, 3.0]]);
}

#[test]
fn an_l_has_a_valley() {
    let outline = vec![
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 4.0],
        [4.0, 4.0],
        [4.0, 10.0],
        [0.0, 10.0],
    ];
    assert_nodes(
        &hip(outline).unwrap(),
        &[[2.0, 2.0, 2.0], [8.0, 2.0, 2.0], [2.0, 8.0, 2.0]],
    );
}

#[test]
fn a_t_of_one_width_meets_in_one_node() {
    let outline = vec![
        [0.0, 0.0],
        [12.0, 0.0],
        [12.0, 4.0],
        [8.0, 4.0],
        [8.0, 10.0],
        [4.0, 10.0],
        [4.0, 4.0],
        [0.0, 4.0],
    ];
    assert_nodes(
        &hip(outline).unwrap(),
        &[
            [2.0, 2.0, 2.0],
            [10.0, 2.0, 2.0],
            [6.0, 2.0, 2.0],
            [6.0, 8.0, 2.0],
        ],
    );
}

#[test]
fn above_a_narrow_bay_two_walls_in_one_line_grow_together() {
    let outline = vec![
        [0.0, 0.0],
        [12.0, 0.0],
        [12.0, 6.0],
        [7.0, 6.0],
        [7.0, 10.0],
        [5.0, 10.0],
        [5.0, 6.0],
        [0.0, 6.0],
    ];
    let wanted = [
        [6.0, 9.0, 1.0],
        [6.0, 5.0, 1.0],
        [6.0, 3.0, 3.0],
        [3.0, 3.0, 3.0],
        [9.0, 3.0, 3.0],
    ];
    assert_nodes(&hip(outline).unwrap(), &wanted);
}

#[test]
fn a_u_has_three_ridges() {
    let outline = vec![
        [0.0, 0.0],
        [12.0, 0.0],
        [12.0, 10.0],
        [8.0, 10.0],
        [8.0, 4.0],
        [4.0, 4.0],
        [4.0, 10.0],
        [0.0, 10.0],
    ];
    assert_nodes(
        &hip(outline).unwrap(),
        &[
            [2.0, 2.0, 2.0],
            [10.0, 2.0, 2.0],
            [2.0, 8.0, 2.0],
            [10.0, 8.0, 2.0],
        ],
    );
}

#[test]
fn a_cross_has_a_middle() {
    let outline = vec![
        [2.0, 0.0],
        [4.0, 0.0],
        [4.0, 2.0],
        [6.0, 2.0],
        [6.0, 4.0],
        [4.0, 4.0],
        [4.0, 6.0],
        [2.0, 6.0],
        [2.0, 4.0],
        [0.0, 4.0],
        [0.0, 2.0],
        [2.0, 2.0],
    ];
    let wanted = [
        [3.0, 3.0, 1.0],
        [3.0, 1.0, 1.0],
        [3.0, 5.0, 1.0],
        [1.0, 3.0, 1.0],
        [5.0, 3.0, 1.0],
    ];
    assert_nodes(&hip(outline).unwrap(), &wanted);
}

#[test]
fn a_courtyard_has_a_ridge_all_around() {
    let rings = [
        vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]],
        vec![[4.0, 4.0], [4.0, 6.0], [6.0, 6.0], [6.0, 4.0]],
    ];
    let found = built(&rings, None, None).unwrap();
    assert_nodes(
        &(found.clone(), 8),
        &[
            [2.0, 2.0, 2.0],
            [8.0, 2.0, 2.0],
            [8.0, 8.0, 2.0],
            [2.0, 8.0, 2.0],
        ],
    );
    assert_eq!(found.faces.len(), 8);
}

#[test]
fn a_comb_has_twelve_nodes() {
    let outline = vec![
        [0.0, 0.0],
        [14.0, 0.0],
        [14.0, 8.0],
        [12.0, 8.0],
        [12.0, 4.0],
        [10.0, 4.0],
        [10.0, 8.0],
        [8.0, 8.0],
        [8.0, 4.0],
        [6.0, 4.0],
        [6.0, 8.0],
        [4.0, 8.0],
        [4.0, 4.0],
        [2.0, 4.0],
        [2.0, 8.0],
        [0.0, 8.0],
    ];
    let mut wanted = vec![
        [2.0, 2.0, 2.0],
        [5.0, 2.0, 2.0],
        [9.0, 2.0, 2.0],
        [12.0, 2.0, 2.0],
    ];
    for x in [1.0, 5.0, 9.0, 13.0] {
        wanted.extend([[x, 7.0, 1.0], [x, 3.0, 1.0]]);
    }
    assert_nodes(&hip(outline).unwrap(), &wanted);
}

#[test]
fn gables_stand_and_slopes_follow_speeds() {
    let gables = built(&[house()], Some(&[1.0, 0.0, 1.0, 0.0]), None).unwrap();
    assert_nodes(&(gables.clone(), 4), &[[0.0, 4.0, 4.0], [12.0, 4.0, 4.0]]);
    let uneven = built(&[house()], Some(&[3.0, 0.0, 1.0, 0.0]), None).unwrap();
    assert_nodes(&(uneven.clone(), 4), &[[0.0, 6.0, 2.0], [12.0, 6.0, 2.0]]);
    let lean_to = built(&[house()], Some(&[1.0, 0.0, 0.0, 0.0]), None).unwrap();
    assert_nodes(&(lean_to.clone(), 4), &[[0.0, 8.0, 8.0], [12.0, 8.0, 8.0]]);
}

#[test]
fn a_stop_leaves_a_flat_top() {
    let flat = built(&[house()], None, Some(1.0)).unwrap();
    let top = [
        [1.0, 1.0, 1.0],
        [11.0, 1.0, 1.0],
        [11.0, 7.0, 1.0],
        [1.0, 7.0, 1.0],
    ];
    assert_nodes(&(flat.clone(), 4), &top);
    assert_eq!((flat.faces.len(), flat.rest.len()), (4, 1));
    // At the height of the ridge, and above it, there is nothing to cut off.
    for height_m in [4.0, 4.0 + 1e-15, 100.0] {
        let whole = built(&[house()], None, Some(height_m)).unwrap();
        assert_nodes(&(whole.clone(), 4), &[[4.0, 4.0, 4.0], [8.0, 4.0, 4.0]]);
        assert!(whole.rest.is_empty());
    }
}

#[test]
fn a_stop_may_leave_several_tops_and_holes() {
    let dumbbell = vec![
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 3.0],
        [12.0, 3.0],
        [12.0, 0.0],
        [20.0, 0.0],
        [20.0, 8.0],
        [12.0, 8.0],
        [12.0, 5.0],
        [8.0, 5.0],
        [8.0, 8.0],
        [0.0, 8.0],
    ];
    assert_eq!(built(&[dumbbell], None, Some(2.0)).unwrap().rest.len(), 2);
    let court = [
        vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]],
        vec![[4.0, 4.0], [4.0, 6.0], [6.0, 6.0], [6.0, 4.0]],
    ];
    let cut = built(&court, None, Some(1.5)).unwrap();
    assert_eq!((cut.rest.len(), cut.rest[0].rings.len()), (1, 2));
}

#[test]
fn a_wall_in_two_speeds_gets_a_standing_step() {
    let outline = vec![[0.0, 0.0], [6.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]];
    let found = built(
        std::slice::from_ref(&outline),
        Some(&[1.0, 2.0, 1.0, 1.0, 1.0]),
        None,
    )
    .unwrap();
    let is_step = |origin| {
        matches!(
            origin,
            FaceOrigin::Step {
                before: 0,
                after: 1
            }
        )
    };
    assert_eq!(
        found
            .faces
            .iter()
            .filter(|face| is_step(face.origin))
            .count(),
        1
    );
    let same = built(&[outline], None, None).unwrap();
    assert_eq!(same.faces.len(), 5);
    assert_nodes(
        &(same.clone(), 5),
        &[[4.0, 4.0, 4.0], [6.0, 4.0, 4.0], [8.0, 4.0, 4.0]],
    );
}

#[test]
fn the_faster_of_two_parallel_walls_takes_over() {
    let outline = vec![
        [0.0, 0.0],
        [6.0, 0.0],
        [6.0, 2.0],
        [12.0, 2.0],
        [12.0, 20.0],
        [0.0, 20.0],
    ];
    let found = built(&[outline], Some(&[2.0, 1.0, 1.0, 1.0, 1.0, 1.0]), None).unwrap();
    let has = |wanted: [f64; 3]| {
        let near = |node: &[f64; 3]| (0..3).all(|k| (node[k] - wanted[k]).abs() < 1e-9);
        found.nodes_m.iter().any(near)
    };
    assert!(
        has([4.0, 4.0, 2.0]) && has([10.0, 4.0, 2.0]),
        "{:?}",
        found.nodes_m
    );
    assert_eq!(found.faces.len(), 6);
}

#[test]
fn what_has_no_top_is_an_error_unless_it_is_cut() {
    let eaves = Eaves::new(&[house()], &[0.0; 4]).unwrap();
    let error = roof(&eaves, None).unwrap_err();
    assert!(matches!(error, SkeletonError::Unbounded { .. }), "{error}");
    let shaft = roof(&eaves, Some(3.0)).unwrap();
    assert_eq!((shaft.faces.len(), shaft.rest.len()), (4, 1));
    let error = roof(&eaves, Some(-1.0)).unwrap_err();
    assert!(matches!(error, SkeletonError::BadHeight { .. }), "{error}");
}

#[test]
fn what_is_no_polygon_is_refused() {
    let refused = |rings: &[Vec<[f64; 2]>]| Eaves::even(rings).unwrap_err();
    let mut clockwise = house();
    clockwise.reverse();
    assert!(matches!(
        refused(&[clockwise]),
        SkeletonError::WrongWinding { ring: 0, .. }
    ));
    let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
    assert!(matches!(refused(&[bow]), SkeletonError::Crossing { .. }));
    let spike = vec![[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 4.0]];
    assert!(matches!(refused(&[spike]), SkeletonError::Spike { .. }));
    let outside = vec![[20.0, 4.0], [20.0, 6.0], [22.0, 6.0]];
    assert!(matches!(
        refused(&[house(), outside]),
        SkeletonError::HoleOutside { ring: 1 }
    ));
    let touching = vec![[0.0, 4.0], [3.0, 5.0], [3.0, 3.0]];
    assert!(matches!(
        refused(&[house(), touching]),
        SkeletonError::Crossing { .. }
    ));
    let wild = vec![[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0]];
    assert!(matches!(
        refused(&[wild]),
        SkeletonError::NotFinite { vertex: 1 }
    ));
    let speeds = Eaves::new(&[house()], &[1.0, -1.0, 1.0, 1.0]).unwrap_err();
    assert!(matches!(speeds, SkeletonError::BadSpeed { edge: 1, .. }));
}
