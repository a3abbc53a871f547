//! A card that vanishes says so at the next call, and nothing panics.

use veduta_carve::{Projection, Root, View};
use veduta_gpu::carve::Carver;
use veduta_gpu::GpuError;

use crate::card;

#[test]
fn a_card_that_vanishes_is_told() {
    let Some(card) = card() else { return };
    let buffer = card.given(&[1.0_f32; 64]).unwrap();
    assert_eq!(card.read::<f32>(&buffer, 64).unwrap(), vec![1.0; 64]);
    let carver = Carver::new(&card);
    card.destroy();
    let gone = card.read::<f32>(&buffer, 64);
    assert!(matches!(gone, Err(GpuError::Lost(_))), "{gone:?}");
    let field = [1.0_f32; 16];
    let view = View {
        projection: Projection {
            rows: [
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 3.0],
            ],
            focal_px: 1.0,
            centre_m: [0.0; 3],
        },
        corner_px: [0.0; 2],
        width: 4,
        height: 4,
        distances_px: &field,
    };
    let root = Root {
        low_m: [0.0; 3],
        side_m: 1.0,
        levels: 5,
    };
    let carved = carver.carve(&card, &[view], root);
    assert!(matches!(carved, Err(GpuError::Lost(_))));
}

#[test]
fn more_than_the_card_takes_is_told() {
    let Some(card) = card() else { return };
    let most = card.most_bytes() as usize;
    let large = card.empty(most / 4 + 1);
    assert!(matches!(large, Err(GpuError::TooLarge { .. })));
}
