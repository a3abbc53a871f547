"""Fronts that step back: the step is found in its column, and holes over it are no slopes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.fill import Source
from veduta.drive.build.frame import ColumnPoints
from veduta.drive.build.segment import Geometry, frame_of, reconstruct
from veduta.drive.build.steps import sharpened
from veduta.drive.options import DriveOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.synthetic.drives import Street, TruckOptions, scan_street, write_drive

FRONTS_M, STEP_M = (10.0, 10.7), 15.0
"""From the path; the step is at this place along it."""
SPACING_M = 0.2


def _points(cut: int, count: int, seed: int) -> ColumnPoints:
    random = np.random.default_rng(seed)
    column = np.repeat(np.arange(count), 20).astype(np.int32)
    depth = np.where(column < cut, *FRONTS_M) + random.normal(0.0, 0.035, len(column))
    height = np.tile(np.linspace(0.5, 6.0, 20), count)
    flat = np.column_stack([-depth, column * SPACING_M, height])
    far, high, angle = (
        one.astype(np.float32) for one in (depth, height, np.arctan2(height - 3.6, depth))
    )
    return ColumnPoints(flat, column, far, angle, high, np.arange(len(column)))


@pytest.mark.parametrize("told", [34, 40, 45])
def test_a_step_is_put_where_the_points_have_it(told: int) -> None:
    points = _points(40, 80, 1)
    main = np.where(np.arange(80) < told, *FRONTS_M).astype(np.float64)
    found = sharpened(main, points, points.height.astype(np.float32), SPACING_M)
    np.testing.assert_allclose(found, np.where(np.arange(80) < 40, *FRONTS_M), atol=1e-9)


def test_a_ramp_between_two_fronts_becomes_a_step() -> None:
    points = _points(40, 80, 2)
    main = np.interp(np.arange(80), [36, 44], FRONTS_M)
    found = sharpened(main, points, points.height.astype(np.float32), SPACING_M)
    off = np.abs(found - np.where(np.arange(80) < 40, *FRONTS_M))
    assert off.max() < 0.3
    assert off.mean() < np.abs(main - np.where(np.arange(80) < 40, *FRONTS_M)).mean()


def test_columns_without_a_wall_stay_without_beside_a_step() -> None:
    points = _points(40, 80, 4)
    main = np.where(np.arange(80) < 40, *FRONTS_M).astype(np.float64)
    unknown = [36, 37, 43]
    main[unknown] = np.nan
    found = sharpened(main, points, points.height.astype(np.float32), SPACING_M)
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(found)), unknown)


def test_one_front_stays_as_it_is() -> None:
    points = _points(80, 80, 3)
    main = 10.0 + 0.1 * np.sin(np.arange(80) / 5.0)
    found = sharpened(main, points, points.height.astype(np.float32), SPACING_M)
    np.testing.assert_array_equal(found, main)


@pytest.fixture(scope="module")
def stepped(tmp_path_factory: pytest.TempPathFactory) -> Geometry:
    """Two fronts, and a thing before the foot of both."""

    def box(x0: float, x1: float, y0: float, y1: float, top: float) -> list[list[float]]:
        return [[x0, y0, 0.0], [x1, y1, top]]

    none: NDArray[np.float64] = np.zeros((0, 2, 3))
    walls = [
        box(-FRONTS_M[0] - 0.3, -FRONTS_M[0], -5.0, STEP_M, 8.0),
        box(-FRONTS_M[1] - 0.3, -FRONTS_M[1], STEP_M, 35.0, 8.0),
    ]
    before = [box(-9.0, -8.5, STEP_M - 2.5, STEP_M + 2.5, 2.4)]
    street = Street(
        np.array(walls), np.array(before), np.zeros((0, 5)), np.zeros((0, 4)), none, none, 30.0
    )
    folder: Path = tmp_path_factory.mktemp("stepped")
    write_drive(scan_street(street, TruckOptions(), 5), folder)
    drive, options = read_own(folder), DriveOptions()
    spacing = column_spacing(drive, options)
    segment = next(
        one for one in cut_segments(driven_line(drive.path(), spacing, 0.0), spacing)
        if one.side == "left"
    )  # fmt: skip
    points = points_beside(drive, segment, options)
    return reconstruct(segment, frame_of(segment, options, drive.height_m), points, options)


def test_a_hole_over_a_step_is_filled_with_a_step(stepped: Geometry) -> None:
    background, frame = stepped.background, stepped.frame
    place = frame.vertices(background.depth)
    filled = background.wall & (background.source == Source.FILLED)
    filled &= np.abs(place[..., 1] - STEP_M) < 2.0
    assert filled.sum() > 50
    off = -place[filled][:, 0] - np.where(place[filled][:, 1] < STEP_M, *FRONTS_M)
    assert (np.abs(off) < 0.15).mean() > 0.9
