"""Silhouettes before plain backgrounds, against masks that are known."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.carve.read.background import masks_of_background

EDGE = 0.92
"""A hard edge is found up to a pixel too far out: of a disc of 30 pixels, that is 0.93."""


def _iou(found: NDArray[np.bool_], truth: NDArray[np.bool_]) -> float:
    return float((found & truth).sum() / (found | truth).sum())


def _photo(truth: NDArray[np.bool_], behind: tuple[int, int, int], seed: int) -> NDArray[np.uint8]:
    noise = np.random.default_rng(seed).normal(0.0, 2.0, (*truth.shape, 3))
    return (
        (np.where(truth[..., None], (190, 130, 60), behind) + noise).clip(0, 255).astype(np.uint8)
    )


@pytest.fixture
def truths() -> list[NDArray[np.bool_]]:
    y, x = np.mgrid[0:120, 0:160]
    return [np.hypot(x - 70 - 5 * n, y - 60) < 30 for n in range(4)]


@pytest.mark.parametrize("behind", [(85, 90, 180), (0, 0, 0), (250, 250, 250)])
def test_a_disc_before_any_plain_colour(
    truths: list[NDArray[np.bool_]], behind: tuple[int, int, int]
) -> None:
    photos = [_photo(truth, behind, n) for n, truth in enumerate(truths)]
    masks, _ = masks_of_background(photos)
    assert min(map(_iou, masks, truths)) > EDGE


def test_a_shadow_on_a_colourful_table_is_not_the_object(
    truths: list[NDArray[np.bool_]],
) -> None:
    photos = []
    for number, truth in enumerate(truths):
        photo = _photo(truth, (85, 90, 180), number)
        shade = np.roll(truth, 12, axis=0) & ~truth
        photo[shade] = (photo[shade] * 0.75).astype(np.uint8)
        photos.append(photo)
    masks, _ = masks_of_background(photos)
    assert min(map(_iou, masks, truths)) > EDGE


def test_a_black_frame_does_not_bite_into_dark_parts(truths: list[NDArray[np.bool_]]) -> None:
    photos = []
    for number, truth in enumerate(truths):
        photo = _photo(truth, (85, 90, 180), number)
        photo[55:65][truth[55:65]] = (12, 8, 6)
        photo[:, :8] = 0
        photos.append(photo)
    masks, _ = masks_of_background(photos)
    assert min(map(_iou, masks, truths)) > EDGE


def test_a_given_background(truths: list[NDArray[np.bool_]]) -> None:
    photos = [_photo(truth, (252, 252, 252), n) for n, truth in enumerate(truths)]
    masks, _ = masks_of_background(photos, ((255, 255, 255),))
    assert min(map(_iou, masks, truths)) > EDGE
