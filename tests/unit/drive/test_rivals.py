"""How much better a path fits than its rivals: one house corner has none, a comb of walls has."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.read.rivals import Margin, margin_of, sharpness_of
from veduta.drive.read.surface_model import SurfaceModel

CELL_M = 0.5


def _model(edge: NDArray[np.bool_]) -> SurfaceModel:
    distance = ndimage.distance_transform_edt(~edge) * CELL_M
    return SurfaceModel(
        distance.astype(np.float32), (-40.0, -40.0), CELL_M, None, 1, None, float(edge.mean())
    )


def _lines(every_m: float | None) -> NDArray[np.bool_]:
    """A wall along x at y = 10: it ends and has two piers, or goes on with one every so often."""
    edge = np.zeros((160, 160), dtype=bool)
    edge[100, : 110 if every_m is None else None] = True
    piers = [0.0, 7.0] if every_m is None else list(np.arange(-40.0, 39.0, every_m))
    for x in piers:
        edge[100:112, int((x + 40.0) / CELL_M)] = True
    return edge


def _scans(edge: NDArray[np.bool_]) -> tuple[NDArray[np.float64], list[NDArray[np.float64]]]:
    """Six scans along y = 0, of what lies within 15 m along x."""
    rows, columns = np.random.default_rng(4).permutation(np.argwhere(edge)).T
    places = np.stack([columns, rows], axis=1) * CELL_M - 40.0 + CELL_M / 2
    poses = np.column_stack([np.linspace(-4.0, 4.0, 6), np.zeros(6), np.full(6, 0.1)])
    scans = []
    for x, y, heading in poses.tolist():
        about = places[np.abs(places[:, 0] - x) < 15.0] - [x, y]
        turn = np.array([[np.cos(heading), -np.sin(heading)], [np.sin(heading), np.cos(heading)]])
        scans.append(about @ turn)
    return poses, scans


def test_what_stands_once_has_a_margin() -> None:
    edge = _lines(None)
    margin = margin_of(*_scans(edge), _model(edge))
    assert margin.own == pytest.approx(1.0, abs=0.03)
    assert margin.share > 0.1


def test_what_repeats_has_none() -> None:
    edge = _lines(6.0)
    margin = margin_of(*_scans(edge), _model(edge))
    assert margin.share < 0.05
    # The piers are 6 m apart along x.
    assert abs(margin.away[1]) < 0.6
    assert abs(margin.away[0]) % 6.0 == pytest.approx(0.0, abs=0.5)


def test_points_on_edges_are_sharp_and_strewn_ones_are_not() -> None:
    edge = _lines(6.0)
    poses, scans = _scans(edge)
    assert sharpness_of(poses, scans, _model(edge)) == pytest.approx(1.0, abs=0.03)
    wall = np.zeros_like(edge)
    wall[100] = True
    random = np.random.default_rng(7)
    strewn = [random.uniform([-15.0, 5.0], [15.0, 15.0], (400, 2)) for _ in poses]
    level = np.column_stack([poses[:, :2], np.zeros(len(poses))])
    assert sharpness_of(level, strewn, _model(wall)) == pytest.approx(1 / 3, abs=0.04)
    away = poses + np.array([500.0, 0.0, 0.0])
    assert sharpness_of(away, scans, _model(edge)) == 0.0


def test_off_the_map_nothing_fits() -> None:
    edge = _lines(None)
    poses, scans = _scans(edge)
    away = margin_of(poses + np.array([500.0, 0.0, 0.0]), scans, _model(edge))
    assert away.own == 0.0
    assert away.rival == 0.0
    assert away.share == 0.0


@pytest.mark.parametrize(
    ("own", "rival", "share"),
    [
        (0.8, 0.2, 0.75),
        (0.4, 0.8, -1.0),
        (0.5, -0.1, 1.2),
        (-0.2, -0.1, 0.0),
        (-0.2, 0.3, 0.0),
        (0.0, 0.0, 0.0),
        (float("nan"), 0.1, 0.0),
        (0.5, float("nan"), 0.0),
    ],
)
def test_a_path_that_fits_nowhere_has_no_share(own: float, rival: float, share: float) -> None:
    """Beams through what stands make a fit less than 0: no margin, however bad its rivals are."""
    assert Margin(own, rival, (8.0, 0.0)).share == pytest.approx(share)


def test_fine_cells_ask_for_no_better_path() -> None:
    """A wall in its own model, the path 0.2 m beside itself: right, whatever the cells are."""
    points = np.column_stack([np.linspace(-4.0, 4.0, 200), np.full(200, 0.2)])
    for cell_m in (0.05, 0.1, 0.5):
        side = int(10.0 / cell_m)
        distance = np.abs((np.arange(side) + 0.5) * cell_m - 5.0)[:, None].repeat(side, axis=1)
        model = SurfaceModel(distance.astype(np.float32), (-5.0, -5.0), cell_m, None, 1, None, 0.1)
        assert sharpness_of(np.zeros((1, 3)), [points], model) > 0.45
