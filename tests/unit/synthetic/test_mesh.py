"""A wall around holes covers exactly what is no hole."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from veduta.synthetic.mesh import MeshBuilder, wall_cells

grid = st.integers(0, 12)
Hole = tuple[float, float, float, float]


@st.composite
def holes(draw: st.DrawFn) -> list[Hole]:
    found = []
    for _ in range(draw(st.integers(0, 5))):
        x0, z0 = draw(grid), draw(grid)
        found.append((x0, z0, x0 + draw(st.integers(1, 5)), z0 + draw(st.integers(1, 5))))
    return found


@given(holes())
def test_cells_and_holes_make_up_the_wall(given_holes: list[Hole]) -> None:
    """On an integer grid every unit square is in one cell or in a hole (holes may overlap)."""
    painted = np.zeros((12, 12), int)
    for x0, z0, x1, z1 in wall_cells((0, 0, 12, 12), given_holes):
        painted[int(z0) : int(z1), int(x0) : int(x1)] += 1
    expected = np.ones((12, 12), int)
    for x0, z0, x1, z1 in given_holes:
        expected[int(z0) : int(z1), int(x0) : int(x1)] = 0
    np.testing.assert_array_equal(painted, expected)


def test_a_box_is_closed_and_looks_outwards() -> None:
    builder = MeshBuilder({})
    builder.box((0, 0, 0), (1, 2, 3), "plain", 0)
    mesh = builder.mesh()
    corners = mesh.positions.reshape(6, 4, 3)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
    outwards = corners.mean(axis=1) - [0.5, 1.0, 1.5]
    assert (np.sum(normals * outwards, axis=1) > 0).all()
    volume = np.sum(normals * corners.mean(axis=1)) / 3
    np.testing.assert_allclose(volume, 6.0)


def test_tiles_repeat_in_metres() -> None:
    builder = MeshBuilder({"brick": (2.0, 0.5)})
    builder.quad((0, 0, 0), (4, 0, 0), (0, 0, 3), "brick", 0)
    uv = builder.mesh().uv
    np.testing.assert_allclose(np.ptp(uv, axis=0), [2.0, 6.0])
