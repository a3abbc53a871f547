"""Which way an animal goes, before a camera that stands, pans or moves aside."""

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.fauna.read.travel import travelled
from veduta.fauna.read.windows import middles_of

FRAMES, HIGH, WIDE = 12, 120, 200
FEET = 90


def _mottled(seed: int, wide: int, high: int) -> NDArray[np.uint8]:
    """(high, wide) blots of four pixels."""
    small = np.random.default_rng(seed).integers(40, 216, (high // 4 + 1, wide // 4 + 1))
    return np.kron(small, np.ones((4, 4))).astype(np.uint8)[:high, :wide]


def _filmed(
    animal_px: float, ground_px: float, far_px: float, *, plain: bool = False
) -> tuple[NDArray[np.bool_], NDArray[np.uint8]]:
    """Silhouettes of a block on legs and its pictures; all move by so much in a frame."""
    near, far = _mottled(1, 600, HIGH), _mottled(2, 600, HIGH)
    masks = np.zeros((FRAMES, HIGH, WIDE), dtype=np.bool_)
    pictures = np.zeros((FRAMES, HIGH, WIDE, 3), dtype=np.uint8)
    for frame in range(FRAMES):
        left = round(60 + frame * animal_px)
        masks[frame, 50:75, left : left + 60] = True
        for leg in (5, 45):
            masks[frame, 75 : FEET + 1, left + leg : left + leg + 8] = True
        at = [round(200 - frame * way) for way in (far_px, ground_px)]
        grey = np.full((HIGH, WIDE), 90, dtype=np.uint8)
        if not plain:
            grey[:70] = far[:70, at[0] : at[0] + WIDE]
            grey[70:] = near[70:, at[1] : at[1] + WIDE]
        grey[masks[frame]] = 20
        pictures[frame] = grey[..., None]
    return masks, pictures


@pytest.mark.parametrize(
    ("animal_px", "ground_px", "far_px", "widths"),
    [
        (3.0, 0.0, 0.0, 33 / 60),
        (0.0, -3.0, -3.0, 33 / 60),
        (0.0, 3.0, 3.0, -33 / 60),
        # The camera moves on with the animal, and far hills with it.
        (-1.0, -4.0, 1.0, 33 / 60),
    ],
)
def test_travel_is_over_the_ground_about_the_feet(
    animal_px: float, ground_px: float, far_px: float, widths: float
) -> None:
    masks, pictures = _filmed(animal_px, ground_px, far_px)
    assert travelled(masks, middles_of(masks), pictures) == pytest.approx(widths, abs=0.12)


def test_without_pictures_the_picture_stands_for_the_ground() -> None:
    masks, _ = _filmed(2.0, -3.0, -3.0)
    assert travelled(masks, middles_of(masks)) == pytest.approx(22 / 60, abs=0.06)


def test_ground_on_which_nothing_can_be_followed_stands() -> None:
    masks, pictures = _filmed(2.0, 0.0, 0.0, plain=True)
    assert travelled(masks, middles_of(masks), pictures) == pytest.approx(22 / 60, abs=0.06)
