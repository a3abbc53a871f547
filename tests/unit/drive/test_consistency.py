"""A filled wall in its place is agreed upon by all images; one that stands too far forth is not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.build.consistency import check_filled
from veduta.drive.build.fill import Background, Source
from veduta.drive.build.frame import ColumnFrame, column_frame
from veduta.drive.build.pictures_of import Seen
from veduta.drive.record import Shot

WALL_M = 10.0


def _frame() -> ColumnFrame:
    line = np.column_stack([np.zeros(60), np.arange(60) * 0.2, np.full(60, 2.0)])
    return column_frame(line, "left", np.deg2rad(np.arange(-10.0, 30.0)), np.zeros(60))


def _seen(y: float) -> Seen:
    """A camera at (0, y, 2) that looks at the wall x = -10, painted with random patches."""
    random = np.random.default_rng(3)
    patches = random.integers(0, 255, (60, 120, 3)).astype(np.uint8)
    turn = np.array([[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = turn, (0.0, y, 2.0)
    shot = Shot("a", Path("a"), 0.0, 320, 240, (200.0, 200.0), (160.0, 120.0), place)
    across, down = np.meshgrid(np.arange(320) + 0.5, np.arange(240) + 0.5)
    wall_y = y + (across - 160.0) / 200.0 * WALL_M
    wall_z = 2.0 - (down - 120.0) / 200.0 * WALL_M
    at = (
        np.clip(((wall_z + 10.0) / 0.5).astype(int), 0, 59),
        np.clip(((wall_y + 20.0) / 0.5).astype(int), 0, 119),
    )
    hidden = np.full((240, 320), np.inf, dtype=np.float32)
    none = np.zeros((240, 320), dtype=bool)
    fits = np.zeros((240, 320), dtype=np.float32)
    return Seen(shot, patches[at], hidden, none, none, fits)


def _background(filled_m: float) -> Background:
    shape = _frame().shape
    depth = np.full(shape, WALL_M, dtype=np.float32)
    source = np.full(shape, Source.MEASURED, dtype=np.uint8)
    hole = (slice(10, 25), slice(20, 40))
    depth[hole], source[hole] = filled_m, Source.FILLED
    wall: NDArray[np.bool_] = np.ones(shape, dtype=bool)
    return Background(depth, source, wall, np.full(60, WALL_M), np.zeros(60, dtype=np.int64))


@pytest.mark.parametrize(("filled_m", "low", "high"), [(10.0, 0.0, 0.1), (7.0, 0.4, 1.0)])
def test_only_a_wall_out_of_its_place_is_contradicted(
    filled_m: float, low: float, high: float
) -> None:
    seen = [_seen(y) for y in (3.0, 5.0, 7.0, 9.0)]
    found = check_filled(_background(filled_m), _frame(), seen)
    assert found.looked > 20
    assert low <= found.share <= high
    assert found.contradicted.any() == (found.share > 0.0)


def test_without_a_measured_wall_nothing_is_told() -> None:
    """How much colours differ on a true surface is then not known."""
    background = _background(7.0)
    background.source[background.source == Source.MEASURED] = Source.INFERRED
    found = check_filled(background, _frame(), [_seen(y) for y in (3.0, 5.0, 7.0, 9.0)])
    assert found.looked == 0
    assert not found.contradicted.any()


def test_without_enough_images_nothing_is_told() -> None:
    found = check_filled(_background(7.0), _frame(), [_seen(5.0)])
    assert found.looked == 0
    assert np.isnan(found.share)
