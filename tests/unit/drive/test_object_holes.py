"""Holes behind objects: planes of the ground, and structure from side to side, with a truth."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.build.frame import ColumnFrame, column_frame
from veduta.drive.build.object_holes import (
    HoleParameters,
    between,
    fill_structure,
    ground_planes,
    holes_of,
)

SCANNER_M = 3.6
Floats = NDArray[np.float64]


@pytest.fixture(scope="module")
def frame() -> ColumnFrame:
    y = np.arange(0.0, 12.0, 0.12)
    line = np.stack([np.zeros_like(y), y, np.full_like(y, SCANNER_M)], axis=1)
    angles = np.deg2rad(np.arange(-80.0, 40.0, 0.4))
    return column_frame(line, "left", angles, np.zeros(len(y)))


def tilted(frame: ColumnFrame, along: float, across: float) -> Floats:
    """(r, c) true depths at which beams meet the plane z = along y + across depth; NaN above."""
    fall = np.tan(frame.angles_rad)[:, None] - across
    depth = (along * frame.origins[None, :, 1] - SCANNER_M) / np.where(fall < -0.02, fall, np.nan)
    return np.where((depth > 1.0) & (depth < 14.0), depth, np.nan)


def test_the_ground_behind_each_object_is_the_plane_around_it(frame: ColumnFrame) -> None:
    """Two planes of other slopes, a car on each; a kerb's worth of points beside lies elsewhere."""
    random = np.random.default_rng(3)
    left, right = tilted(frame, 0.02, -0.03), tilted(frame, -0.01, 0.04)
    middle = frame.shape[1] // 2
    true = np.where(np.arange(frame.shape[1])[None] < middle, left, right)
    holes = np.zeros(frame.shape, dtype=np.int32)
    rows = slice(60, 130)
    holes[rows, 12:30], holes[rows, middle + 12 : middle + 30] = 1, 3
    ground = (true + random.normal(0.0, 0.03, true.shape)).astype(np.float32)
    ground[55:60, 12:20] *= 0.93  # points that lie 25 cm too high
    ground[holes > 0] = np.nan
    found = ground_planes(ground, holes, frame)
    hidden = (holes > 0) & np.isfinite(true)
    assert hidden.sum() > 1000
    assert np.isfinite(found[hidden]).all()
    high = np.abs(found - true)[hidden] * np.abs(np.tan(frame.angles_rad))[np.nonzero(hidden)[0]]
    assert np.sqrt((high**2).mean()) < 0.02
    assert np.isnan(found[holes == 0]).all()


def test_too_little_ground_around_gives_no_plane(frame: ColumnFrame) -> None:
    true = tilted(frame, 0.0, 0.0).astype(np.float32)
    holes = np.zeros(frame.shape, dtype=np.int32)
    holes[60:130, 12:30] = 1
    random = np.random.default_rng(1)
    off = random.uniform(0.6, 0.95, true.shape)
    scattered = np.where(random.uniform(size=true.shape) < 0.5, true, true * off)
    alone = np.full_like(true, np.nan)
    alone[58, 12:15] = true[58, 12:15]
    assert np.isnan(ground_planes(alone, holes, frame)).all()
    # Where half of the points are wrong, the other half still shows the plane.
    scattered[holes > 0] = np.nan
    found = ground_planes(scattered.astype(np.float32), holes, frame)
    inside = (holes > 0) & np.isfinite(true)
    np.testing.assert_allclose(found[inside], true[inside], rtol=0.02)


def test_a_wall_steeper_than_ground_is_no_plane(frame: ColumnFrame) -> None:
    steep = tilted(frame, 0.0, -0.4).astype(np.float32)
    holes = np.zeros(frame.shape, dtype=np.int32)
    holes[60:130, 12:30] = 1
    steep[holes > 0] = np.nan
    assert np.isnan(ground_planes(steep, holes, frame)).all()


def test_structure_goes_on_from_side_to_side() -> None:
    """Ledges run across behind the hole; at the end of a wall, from above and below."""
    true = np.full((20, 30), 10.0, dtype=np.float32)
    true[8:10] = 9.5
    wall, holes = true.copy(), np.zeros((20, 30), dtype=np.int32)
    holes[4:16, 10:20] = 2
    wall[holes > 0] = np.nan
    np.testing.assert_allclose(fill_structure(wall, holes), true, atol=1e-6)
    end = np.zeros_like(holes)
    end[4:16, 24:] = 1
    ended = np.where(end > 0, np.nan, true)
    np.testing.assert_allclose(fill_structure(ended, end)[end > 0], 10.0, atol=1e-6)
    # Other holes are left.
    assert np.isnan(fill_structure(ended, np.zeros_like(end))[end > 0]).all()
    # And so is what has nothing above.
    ended[16:, 24:] = np.nan
    assert np.isnan(fill_structure(ended, end)[:, 26:][4:16]).all()


def test_behind_a_crown_over_a_roof_there_is_no_wall() -> None:
    """A low house between two high ones; the crown hides its eaves and the sky above them."""
    wall = np.full((30, 60), np.nan, dtype=np.float32)
    wall[:25, :20] = wall[:25, 40:] = 10.0
    wall[:12, 20:40] = 10.0
    holes = np.zeros(wall.shape, dtype=np.int32)
    holes[8:20, 27:34] = 1
    hidden = np.where(holes > 0, np.nan, wall).astype(np.float32)
    found = fill_structure(hidden, holes)
    np.testing.assert_allclose(found[8:12, 27:34], 10.0)
    assert np.isnan(found[17:20, 27:34]).all()
    assert np.isnan(found[12:, 20:27]).all()


def test_between_is_linear_interpolation() -> None:
    random = np.random.default_rng(5)
    values = random.uniform(5.0, 9.0, (7, 40))
    values[random.uniform(size=values.shape) < 0.6] = np.nan
    found, gap, step = between(values, axis=1)
    for row, told in zip(values, found, strict=True):
        known = np.flatnonzero(np.isfinite(row))
        inside = np.isnan(row) & (np.arange(40) > known[0]) & (np.arange(40) < known[-1])
        expected = np.interp(np.flatnonzero(inside), known, row[known])
        np.testing.assert_allclose(told[inside], expected, rtol=1e-5)
        assert np.isnan(told[~inside]).all()
    upright = between(values.T, axis=0)
    np.testing.assert_array_equal(upright[0].T, found)
    filled = np.isfinite(found)
    np.testing.assert_array_equal(upright[1].T[filled], gap[filled])
    assert (step[filled] >= 0.0).all()


def test_empty_rows_between_beams_are_of_the_object() -> None:
    objects = np.zeros((20, 20), dtype=np.int32)
    objects[4:12:3, 5:9], objects[15, 14:18] = 1, 2
    holes = holes_of(objects, HoleParameters(reach_px=2))
    assert (holes[4:11, 5:9] == 1).all()
    assert (holes[15, 14:18] == 2).all()
    assert holes[4, 12] == 0
    assert not holes_of(np.zeros_like(objects)).any()
