"""Lots from GeoJSON: what is read, what is refused, and what a bad feature costs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from veduta.geometry.utm import utm
from veduta.grammar.lots import Lots, read_lots
from veduta.run.errors import InputError

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]
HOLE = [[2, 2], [4, 2], [4, 4], [2, 4], [2, 2]]


def feature(*rings: Any, kind: str = "Polygon", **more: Any) -> dict[str, Any]:
    shape = {"type": kind, "coordinates": list(rings)}
    return {"type": "Feature", "geometry": shape, "properties": {}} | more


def collection(*features: Any, crs: str | None = None) -> dict[str, Any]:
    found: dict[str, Any] = {"type": "FeatureCollection", "features": list(features)}
    if crs is not None:
        found["crs"] = {"type": "name", "properties": {"name": crs}}
    return found


def read(folder: Path, document: Any) -> Lots:
    path = folder / "lots.geojson"
    path.write_text(document if isinstance(document, str) else json.dumps(document))
    return read_lots(path)


def moved(ring: list[list[float]], east: float, north: float) -> list[list[float]]:
    return [[x + east, y + north] for x, y in ring]


def area(ring: np.ndarray) -> float:
    x, y = ring.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_a_polygon_with_a_hole(tmp_path: Path) -> None:
    found = read(tmp_path, collection(feature(SQUARE, HOLE, id="a", properties={"height": 12})))
    (lot,) = found.lots
    assert (lot.id, lot.attributes, found.crs) == ("a", {"height": 12.0}, None)
    assert [area(ring) for ring in lot.rings_m] == [100.0, -4.0]


def test_the_first_edge_stays_first_whichever_way_the_outline_runs(tmp_path: Path) -> None:
    (lot,) = read(tmp_path, collection(feature(SQUARE[::-1]))).lots
    assert area(lot.rings_m[0]) == 100.0
    first_edge = {tuple(point) for point in lot.rings_m[0][:2].tolist()}
    assert first_edge == {(0.0, 0.0), (0.0, 10.0)}


def test_each_polygon_of_several_is_a_lot(tmp_path: Path) -> None:
    both = feature([SQUARE], [moved(SQUARE, 20, 0)], kind="MultiPolygon", id="x/y")
    found = read(tmp_path, collection(both, feature(moved(SQUARE, 40, 0), id="X-y-1")))
    assert [lot.name for lot in found.lots] == ["x/y-1", "x/y-2", "X-y-1"]
    assert [lot.id for lot in found.lots] == ["x-y-1", "x-y-2", "X-y-1-2"]


@pytest.mark.parametrize("crs", ["EPSG:28992", "urn:ogc:def:crs:EPSG::28992"])
def test_large_coordinates_stay_exact(tmp_path: Path, crs: str) -> None:
    ring = moved(SQUARE, 84_321.123, 446_789.457)
    found = read(tmp_path, collection(feature(ring), crs=crs))
    (lot,) = found.lots
    assert (found.crs, found.origin_m) == ("EPSG:28992", (84_321.0, 446_789.0, 0.0))
    single = lot.rings_m[0].astype(np.float32).astype(np.float64)
    back = single + lot.anchor_m[:2] + np.array(found.origin_m[:2])
    assert np.abs(back - np.array(ring[:-1])).max() < 1e-5


def test_longitude_and_latitude_become_metres(tmp_path: Path) -> None:
    ring = [[2.35, 48.85], [2.3502, 48.85], [2.3502, 48.8501], [2.35, 48.8501], [2.35, 48.85]]
    for crs in (None, "urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326"):
        found = read(tmp_path, collection(feature(ring), crs=crs))
        assert found.crs == "EPSG:32631"
        back = found.lots[0].rings_m[0] + found.lots[0].anchor_m[:2] + found.origin_m[:2]
        assert np.allclose(back, utm(np.array(ring[:-1]), 31, south=False), atol=1e-6)
        assert any("EPSG:32631" in note for note in found.notes)


def test_small_local_metres_are_no_degrees(tmp_path: Path) -> None:
    assert read(tmp_path, collection(feature(SQUARE))).crs is None


def test_the_lowest_corner_is_the_ground(tmp_path: Path) -> None:
    ring = [[0, 0, 7.5], [10, 0, 8], [10, 10, 9], [0, 10, 8]]
    found = read(tmp_path, collection(feature(ring)))
    assert found.lots[0].anchor_m[2] + found.origin_m[2] == 7.5
    assert found.lots[0].anchor_m[2] == 0.0


BOW_TIE = [[0, 0], [10, 10], [10, 0], [0, 8], [0, 0]]
FAULTS = {
    "crosses itself": [BOW_TIE],
    "encloses nothing": [[[0, 0], [10, 10], [10, 0], [0, 10]]],
    "fewer than three": [[[0, 0], [1, 1], [0, 0]]],
    "encloses": [[[0, 0], [5, 0], [5, 0.01], [0, 0.01]]],
    "no list of two or three numbers": [[["1", "2"], ["3", "4"], ["5", "6"]]],
    "no list of two": [[[0, 0], [1], [2, 2]]],
    "no list of points": ["abc"],
    "wide": [[[0, 0], [20_000, 0], [20_000, 9], [0, 9]]],
    "a hole crosses": [SQUARE, moved(HOLE, 7, 0)],
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_bad_lot_costs_nothing_but_itself(tmp_path: Path, fault: str) -> None:
    bad = feature(*FAULTS[fault], properties={"name": "bad"})
    found = read(tmp_path, collection(feature(SQUARE), bad, feature(moved(SQUARE, 20, 0))))
    assert [lot.id for lot in found.lots] == ["lot-1", "lot-3"]
    (failure,) = found.failures
    assert "feature 2" in failure.subject
    assert fault in failure.reason


def test_what_is_no_polygon_is_told(tmp_path: Path) -> None:
    point = {"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}}
    found = read(tmp_path, collection(feature(SQUARE), point, {"geometry": None}))
    assert (len(found.lots), len(found.failures)) == (1, 0)
    assert found.notes == (
        "left out, for they are no polygons: 1 Point, 1 feature without geometry",
    )


REFUSED = {
    "is not JSON": "{",
    "NaN is not a number": '{"type": "FeatureCollection", "features": [NaN]}',
    "nested too deep": "[" * 200_000,
    "is no object": "[]",
    "no list of features": '{"type": "FeatureCollection"}',
    "its type is 'Topology'": '{"type": "Topology"}',
    "no lot that can be used": collection(),
    "crosses itself": collection(feature(BOW_TIE)),
    "crs that is not read": collection(feature(SQUARE), crs="EPSG:banana"),
    "no longitudes": collection(feature(moved(SQUARE, 500, 0)), crs="EPSG:4326"),
    "km apart": collection(feature(SQUARE), feature(moved(SQUARE, 1e6, 0))),
    "no metres on Earth": collection(feature(moved(SQUARE, 1e12, 0))),
}


@pytest.mark.parametrize("fault", REFUSED)
def test_a_bad_file_is_refused_with_its_fault(tmp_path: Path, fault: str) -> None:
    with pytest.raises(InputError, match=fault) as caught:
        read(tmp_path, REFUSED[fault])
    assert caught.value.subject == str(tmp_path / "lots.geojson")
    assert caught.value.remedy


ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=4), inner, max_size=3)
    ),
    max_leaves=12,
)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(ANYTHING, ANYTHING, st.sampled_from(["Polygon", "MultiPolygon", "Point"]))
def test_any_content_is_read_or_refused(
    tmp_path: Path, coordinates: Any, properties: Any, kind: str
) -> None:
    shape = {"type": kind, "coordinates": coordinates}
    whatever = {"type": "Feature", "geometry": shape, "properties": properties, "id": coordinates}
    try:
        found = read(tmp_path, collection(feature(SQUARE), whatever))
    except InputError as error:
        fault = error
    else:
        fault = None
        assert found.lots[0].id == "lot-1"
    assert fault is None or fault.remedy


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    st.lists(st.floats(0.0, 2 * np.pi), min_size=3, max_size=12, unique=True),
    st.floats(-1e6, 1e6),
    st.booleans(),
)
def test_areas_are_those_of_the_file(
    tmp_path: Path, angles: list[float], east: float, turned: bool
) -> None:
    """Corners on a circle: the shoelace sum of the file is the oracle."""
    ring = np.array([[30 * np.cos(a) + east, 30 * np.sin(a)] for a in sorted(angles)])
    expected = area(ring - ring[0])
    points = (ring[::-1] if turned else ring).tolist()
    try:
        found = read(tmp_path, collection(feature(points)))
    except InputError:
        assert expected < 1.0 or np.ptp(ring, axis=0).min() < 1e-2
        return
    assert area(found.lots[0].rings_m[0]) == pytest.approx(expected, abs=0.2)
