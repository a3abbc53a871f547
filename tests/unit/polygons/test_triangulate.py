"""The triangulation as Python sees it, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta import _core

SQUARE = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 3.0, 0.0), (0.0, 3.0, 0.0)]


def triangulate(
    *rings: list[tuple[float, float, float]],
) -> tuple[NDArray[np.uint32], NDArray[np.uint32], NDArray[np.float64], NDArray[np.float64]]:
    positions = np.array([point for ring in rings for point in ring], dtype=np.float64)
    offsets = np.cumsum([0, *(len(ring) for ring in rings)]).astype(np.int64)
    return _core.triangulate_polygons(
        positions, offsets, np.array([0, len(rings)], dtype=np.int64), 1e-6
    )


def test_square_with_a_hole() -> None:
    hole = [(1.0, 1.0, 0.0), (1.0, 2.0, 0.0), (2.0, 2.0, 0.0), (2.0, 1.0, 0.0)]
    triangles, polygon, normals, areas = triangulate(SQUARE, hole)
    assert triangles.dtype == np.uint32
    assert triangles.shape == (8, 3)
    assert polygon.tolist() == [0] * 8
    assert normals.tolist() == [[0.0, 0.0, 1.0]]
    assert areas.tolist() == [11.0]


def test_no_polygons_give_no_triangles() -> None:
    empty = np.zeros(1, dtype=np.int64)
    triangles, polygon, normals, areas = _core.triangulate_polygons(
        np.zeros((0, 3)), empty, empty, 1e-6
    )
    assert (len(triangles), len(polygon), len(normals), len(areas)) == (0, 0, 0, 0)


@pytest.mark.parametrize(
    ("ring", "error", "text"),
    [
        ([*SQUARE[:2]], _core.RingTooShortError, "2 vertices"),
        ([SQUARE[0], SQUARE[0], *SQUARE[1:]], _core.RepeatedVertexError, "vertex 0"),
        ([*SQUARE[:3], (0.0, 3.0, 1.0)], _core.NotPlanarError, "leaves its plane"),
        ([*SQUARE[:3], (0.0, np.inf, 0.0)], _core.NotFiniteError, "vertex 3"),
        ([(0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (2.0, 2.0, 2.0)], _core.NoAreaError, "no area"),
        (
            [SQUARE[0], SQUARE[1], SQUARE[3], (5.0, 3.0, 0.0)],
            _core.SelfCrossingError,
            "crosses itself",
        ),
    ],
)
def test_each_fault_is_an_exception_of_its_own(
    ring: list[tuple[float, float, float]], error: type[_core.PolygonFault], text: str
) -> None:
    with pytest.raises(error, match=text) as caught:
        triangulate(ring)
    assert isinstance(caught.value, _core.PolygonFault)
    assert isinstance(caught.value, ValueError)


def test_offsets_that_do_not_fit_are_refused() -> None:
    positions = np.array(SQUARE)
    with pytest.raises(_core.BadOffsetsError, match="end at 4"):
        _core.triangulate_polygons(
            positions, np.array([0, 7], dtype=np.int64), np.array([0, 1], dtype=np.int64), 1e-6
        )


def test_positions_need_three_columns() -> None:
    offsets = np.array([0, 1], dtype=np.int64)
    with pytest.raises(ValueError, match="3 columns"):
        _core.triangulate_polygons(np.zeros((4, 2)), offsets, offsets, 1e-6)
