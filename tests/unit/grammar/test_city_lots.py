"""Lots from CityJSON: the ground of prisms with and without a bottom, holes, fronts, faults."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.grammar.lots import Lots, read_lots
from veduta.run.errors import InputError

OUTLINE = [[0, 0], [12, 0], [12, 8], [0, 8]]
COURT = [[4, 3], [4, 5], [8, 5], [8, 3]]


class City:
    """Grows a CityJSON file in centimetres."""

    def __init__(self) -> None:
        self.vertices: list[list[int]] = []
        self.objects: dict[str, Any] = {}

    def ring(self, points: list[list[float]], z: float) -> list[int]:
        first = len(self.vertices)
        self.vertices += [[round(100 * x), round(100 * y), round(100 * z)] for x, y in points]
        return list(range(first, len(self.vertices)))

    def building(self, name: str, faces: list[Any], **geometry: Any) -> None:
        shape = {"type": "Solid", "lod": "1", "boundaries": [faces]} | geometry
        self.objects[name] = {
            "type": "Building",
            "attributes": {"use": "house"},
            "geometry": [shape],
        }

    def read(self, folder: Path) -> Lots:
        document = {
            "type": "CityJSON",
            "version": "2.0",
            "transform": {"scale": [0.01] * 3, "translate": [85_000.0, 446_000.0, 0.0]},
            "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
            "CityObjects": self.objects,
            "vertices": self.vertices,
        }
        path = folder / "city.json"
        path.write_text(json.dumps(document))
        return read_lots(path)


def prism(city: City, *, bottom: bool, triangles: bool = False) -> list[Any]:
    low, high = city.ring(OUTLINE, 1.0), city.ring(OUTLINE, 7.5)
    sides = [[low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]] for k in range(4)]
    if triangles:
        a, b, c, d = high
        tops = [[[a, b, c]], [[a, c, d]]]
    else:
        tops = [[high]]
    return [[side] for side in sides] + tops + ([[low[::-1]]] if bottom else [])


def area(ring: np.ndarray) -> float:
    x, y = ring.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


@pytest.mark.parametrize("bottom", [True, False])
@pytest.mark.parametrize("triangles", [True, False])
def test_a_prism_stands_on_its_outline(tmp_path: Path, bottom: bool, triangles: bool) -> None:
    city = City()
    city.building("house", prism(city, bottom=bottom, triangles=triangles))
    found = city.read(tmp_path)
    (lot,) = found.lots
    assert (found.crs, found.origin_m) == ("EPSG:7415", (85_000.0, 446_000.0, 1.0))
    assert area(lot.rings_m[0]) == pytest.approx(96.0)
    corners = {tuple(np.round(point, 6)) for point in lot.rings_m[0].tolist()}
    assert corners == {(0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0)}
    assert lot.attributes == {"use": "house", "height": 6.5}


def test_a_courtyard_stays_open_and_semantics_decide(tmp_path: Path) -> None:
    city = City()
    ground = [city.ring(OUTLINE, 0.0)[::-1], city.ring(COURT, 0.0)[::-1]]
    roof = [city.ring(OUTLINE, 4.0)]
    city.building(
        "house",
        [roof, ground],
        type="MultiSurface",
        boundaries=[roof, ground],
        semantics={
            "surfaces": [{"type": "RoofSurface"}, {"type": "GroundSurface"}],
            "values": [0, 1],
        },
    )
    (lot,) = city.read(tmp_path).lots
    assert [area(ring) for ring in lot.rings_m] == pytest.approx([96.0, -8.0])


def test_two_grounds_are_two_lots(tmp_path: Path) -> None:
    city = City()
    east = [[x + 30, y] for x, y in OUTLINE]
    city.building("pair", [[city.ring(OUTLINE, 0)[::-1]], [city.ring(east, 0)[::-1]]])
    assert [lot.name for lot in city.read(tmp_path).lots] == ["pair-1", "pair-2"]


@pytest.mark.parametrize("side", ["north", "west"])
def test_the_front_is_at_the_road(tmp_path: Path, side: str) -> None:
    city = City()
    city.building("house", prism(city, bottom=True))
    at = {"north": [[4, 14], [8, 14], [6, 16]], "west": [[-9, 3], [-9, 5], [-11, 4]]}[side]
    boundaries = [[city.ring(at, 0)]]
    shape = {"type": "MultiSurface", "lod": "1", "boundaries": boundaries}
    city.objects["road"] = {"type": "Road", "geometry": [shape]}
    (lot,) = city.read(tmp_path).lots
    first = {tuple(np.round(point, 6)) for point in lot.rings_m[0][:2].tolist()}
    north, west = {(0.0, 8.0), (12.0, 8.0)}, {(0.0, 0.0), (0.0, 8.0)}
    assert first == (north if side == "north" else west)


BROKEN: dict[str, Any] = {
    "a vertex that is not there": [[[0, 1, 99]]],
    "is no list of numbers": [[[0, 1, "2"]]],
    "no list of three vertices": [[[0, 1]]],
    "a surface has no rings": [[]],
    "has no surfaces": [],
    "no surface that it stands on": [[[0, 1, 5, 4]]],
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_bad_building_costs_nothing_but_itself(tmp_path: Path, fault: str) -> None:
    city = City()
    city.building("house", prism(city, bottom=True))
    city.building("bad", BROKEN[fault])
    found = city.read(tmp_path)
    assert [lot.name for lot in found.lots] == ["house"]
    (failure,) = found.failures
    assert failure.subject.endswith(": bad")
    assert fault in failure.reason


@pytest.mark.parametrize(
    "vertices", [None, [], [[1, 2]], [["1", "2", "3"]], [[1, 2, 10**400]], "abc"]
)
def test_bad_vertices_are_refused(tmp_path: Path, vertices: Any) -> None:
    city = City()
    city.building("house", prism(city, bottom=True))
    city.vertices = vertices
    with pytest.raises(InputError, match=r"has no vertices|not finite"):
        city.read(tmp_path)
