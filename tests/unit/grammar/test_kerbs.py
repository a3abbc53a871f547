"""Carriageways, pavements and kerbs along roads: areas by hand, and which way faces look."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.grammar.demo import demo_lots
from veduta.grammar.kerbs import KerbParameters, streets_of
from veduta.grammar.lot import Lot
from veduta.grammar.outline import Road
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass


def lot(x: float, y: float, z: float = 0.0, size: float = 10.0) -> Lot:
    ring = np.array([[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]])
    return Lot(f"{x}/{y}", "lot", (ring,), (x, y, z))


def road(*points: tuple[float, float], width: float = 6.0, path: bool = False) -> Road:
    return Road(np.array([[x, y, 0.0] for x, y in points]), width, path)


def areas(mesh: Mesh) -> dict[str, NDArray[np.float64]]:
    """The sum of the area vectors of each surface."""
    a, b, c = (mesh.positions_m[mesh.triangles[:, k]].astype(np.float64) for k in range(3))
    vectors = np.cross(b - a, c - a) / 2
    rows = enumerate(mesh.features.name)
    return {name: vectors[mesh.triangle_feature == row].sum(axis=0) for row, name in rows}


def test_a_straight_road_before_a_house() -> None:
    # The road runs 4 m south of the house and 30 m beyond it at both ends: 70 m of it are laid.
    mesh = streets_of([lot(0, 0)], [road((-200, -4), (200, -4), width=6.0)])
    assert mesh is not None
    assert mesh.features.name == ("Carriageway", "Pavement", "Kerb")
    found = areas(mesh)
    assert found["Carriageway"] == pytest.approx([0.0, 0.0, 70 * 6.0], abs=1e-3)
    # To the north 3 m but where the house begins after 1 m.
    assert found["Pavement"][2] == pytest.approx(70 * 6.0 - 10 * 2.0, abs=1e-3)
    assert found["Kerb"] == pytest.approx([0.0, 0.0, 0.0], abs=1e-4)
    heights = mesh.positions_m[:, 2]
    assert np.unique(np.round(heights, 4)).tolist() == pytest.approx([0.01, 0.13])
    assert set(mesh.features.class_code) == {SemanticClass.GROUND.code}
    assert set(mesh.features.provenance_code) == {Provenance.INVENTED.code}


def test_kerbs_look_away_from_the_pavement() -> None:
    mesh = streets_of([lot(0, 0)], [road((-200, -4), (200, -4))])
    assert mesh is not None
    kerb = mesh.triangles[mesh.triangle_feature == 2]
    a, b, c = (mesh.positions_m[kerb[:, k]].astype(np.float64) for k in range(3))
    normals = np.cross(b - a, c - a)
    middle = (a + b + c) / 3
    south = np.abs(middle[:, 1] + 7.0) < 1e-3  # between the carriageway and the southern pavement
    assert south.any()
    assert (normals[south, 1] > 0).all()
    assert np.abs(normals[:, 2]).max() < 1e-9


def test_crossing_roads_are_one_carriageway() -> None:
    mesh = streets_of([lot(5, 5)], [road((-99, 0), (99, 0)), road((0, -99), (0, 99))])
    assert mesh is not None
    # 75 m of each in the box of 30 m around the house, and 6 x 6 m where they cross.
    reach = 30.0
    along = (15 + reach) - (5 - reach)
    assert areas(mesh)["Carriageway"][2] == pytest.approx(2 * 6 * along - 36, abs=1e-2)


def test_nothing_is_laid_without_roads_or_on_uneven_ground() -> None:
    way = road((-99, -4), (99, -4))
    assert streets_of([lot(0, 0)], []) is None
    assert streets_of([], [way]) is None
    assert streets_of([lot(0, 0)], [road((-99, -4), (99, -4), path=True)]) is None
    assert streets_of([lot(0, 0), lot(20, 0, 3.0)], [way]) is None
    assert streets_of([lot(0, 0)], [road((-99, -400), (99, -400))]) is None


def test_the_pavements_of_the_synthetic_street_reach_its_fronts() -> None:
    street = demo_lots(14, 3)
    mesh = streets_of(street.lots, street.roads, KerbParameters(reach_m=0.0))
    assert mesh is not None
    ends = mesh.positions_m[:, 1]
    assert (float(ends.min()), float(ends.max())) == pytest.approx((0.0, 15.0), abs=1e-4)
