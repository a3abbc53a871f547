//! A ball in silhouettes that are drawn too large: the shader's sweeps carve what the loops carve.

use veduta_carve::sweep::{sweep, SweepRule, Swept};
use veduta_carve::{hull, Projection};
use veduta_gpu::sweep::Sweeper;

use crate::ball::{distances, photo, photos, ring, root, views};
use crate::card;

const LEVELS: u32 = 6;

fn rule(sweeps: usize, rim_voxels: f64) -> SweepRule {
    SweepRule {
        spread: 25.0,
        least_views: 3,
        most_views: 6,
        least_cosine: 0.3,
        rim_voxels,
        sweeps,
    }
}

/// By the processor and by the card, and how many voxels there were.
fn both(rule: &SweepRule) -> Option<(Swept, Swept, usize)> {
    let card = card()?;
    let (field, cameras) = (distances(0.7), ring());
    let pixels: Vec<Vec<u8>> = cameras.iter().map(|one| photo(one, 0.5)).collect();
    let (photos, views) = (photos(&cameras, &pixels), views(&cameras, &field));
    let volume = hull::carve(&views, root(LEVELS)).unwrap();
    let solid = volume.solid();
    let full = solid.iter().filter(|one| **one).count();
    let wanted = sweep(&photos, &views, &volume.root, solid.clone(), rule).unwrap();
    let swept = Sweeper::new(&card).sweep(&card, &photos, &views, &volume.root, solid, rule);
    Some((wanted, swept.unwrap(), full))
}

fn differing(one: &[bool], other: &[bool]) -> usize {
    let each = one.iter().zip(other);
    each.filter(|(one, other)| one != other).count()
}

#[test]
fn spreads_are_the_same() {
    let Some((wanted, found, _)) = both(&rule(0, 1.5)) else {
        return;
    };
    let count = wanted.hull_spreads.len();
    assert!(count > 2_000, "{count} voxels are seen");
    assert_eq!(found.hull_spreads.len(), count);
    let pairs = wanted.hull_spreads.iter().zip(&found.hull_spreads);
    let off = pairs.filter(|(one, other)| (*one - *other).abs() > 0.05);
    // Single precision may turn the order of two views, or put a pixel on the other side of a rim.
    let off = off.count();
    assert!(off * 200 <= count, "{off} of {count} spreads differ");
}

#[test]
fn sweeps_leave_the_same() {
    let Some((wanted, found, full)) = both(&rule(20, 0.0)) else {
        return;
    };
    let left = wanted.solid.iter().filter(|one| **one).count();
    assert!(10 * left < 8 * full, "the loops carve: {left} of {full}");
    let turned = differing(&wanted.solid, &found.solid);
    assert!(
        turned * 100 <= full - left,
        "{turned} voxels, {left} of {full} left"
    );
}

#[test]
fn what_holds_an_outline_stays() {
    let Some((wanted, found, full)) = both(&rule(4, 1.5)) else {
        return;
    };
    let gone = full - wanted.solid.iter().filter(|one| **one).count();
    let held = rule(4, 0.0);
    let Some((unheld, ..)) = both(&held) else {
        return;
    };
    assert!(differing(&wanted.solid, &unheld.solid) > 50, "some hold");
    let turned = differing(&wanted.solid, &found.solid);
    assert!(turned * 100 <= gone, "{turned} voxels of {gone} carved");
}

#[test]
fn photos_that_do_not_fit_into_one_buffer_are_looked_at_in_turn() {
    let Some(card) = card() else { return };
    let (field, cameras) = (distances(0.7), ring());
    let pixels: Vec<Vec<u8>> = cameras.iter().map(|one| photo(one, 0.5)).collect();
    let (photos, views) = (photos(&cameras, &pixels), views(&cameras, &field));
    let volume = hull::carve(&views, root(LEVELS)).unwrap();
    let swept = |values: usize| {
        let sweeper = Sweeper::holding(&card, values);
        let made = sweeper.sweep(
            &card,
            &photos,
            &views,
            &volume.root,
            volume.solid(),
            &rule(3, 0.0),
        );
        made.unwrap()
    };
    let each = field.len();
    assert_eq!(swept(5 * each), swept(100 * each));
}

#[test]
fn a_card_that_vanishes_in_between_is_told() {
    let Some(card) = card() else { return };
    let (field, cameras): (Vec<f32>, Vec<Projection>) = (distances(0.7), ring());
    let pixels: Vec<Vec<u8>> = cameras.iter().map(|one| photo(one, 0.5)).collect();
    let (photos, views) = (photos(&cameras, &pixels), views(&cameras, &field));
    let volume = hull::carve(&views, root(LEVELS)).unwrap();
    let sweeper = Sweeper::new(&card);
    card.destroy();
    let rule = rule(3, 0.0);
    let swept = sweeper.sweep(&card, &photos, &views, &volume.root, volume.solid(), &rule);
    assert!(matches!(swept, Err(veduta_gpu::GpuError::Lost(_))));
}
