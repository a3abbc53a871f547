"""Which edge of a lot looks at a street: against a search along rays, and through the reader."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.grammar.lots import read_lots
from veduta.grammar.options import LotOptions
from veduta.grammar.outline import Road
from veduta.grammar.roads import Roads, lines_of, road_of
from veduta.run.errors import InputError

SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 8.0], [0.0, 8.0]])
X, Y = 650_000.0, 6_860_000.0


def line(*points: tuple[float, float], width: float = 6.0, path: bool = False) -> Road:
    return Road(np.array([[x, y, 0.0] for x, y in points]), width, path)


def marched(ring: NDArray[np.float64], roads: list[Road]) -> int:
    """The edge from whose middle a walker straight ahead comes to a carriageway first."""
    along = np.roll(ring, -1, axis=0) - ring
    outward = np.column_stack([along[:, 1], -along[:, 0]])
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    middle = ring + along / 2
    for step in np.arange(0.0, 60.0, 0.05):
        for edge in range(len(ring)):
            here = middle[edge] + step * outward[edge]
            for road in roads:
                ends = road.points[:, :2]
                share = np.linspace(0.0, 1.0, 400)[:, None]
                dense = np.concatenate(
                    [a + share * (b - a) for a, b in zip(ends, ends[1:], strict=False)]
                )
                if np.linalg.norm(dense - here, axis=1).min() <= road.width_m / 2:
                    return edge
    return -1


@pytest.mark.parametrize("side", range(4))
def test_the_front_looks_at_the_road(side: int) -> None:
    roads = [
        line((-20.0, -9.0), (40.0, -9.0)),
        line((19.0, -30.0), (19.0, 40.0)),
        line((-20.0, 17.0), (40.0, 17.0)),
        line((-9.0, -30.0), (-9.0, 40.0)),
    ]
    front = Roads([roads[side]]).front_of(SQUARE)
    assert front is not None
    assert front.edge == side == marched(SQUARE, [roads[side]])
    assert front.width_m == 6.0
    assert front.gap_m == pytest.approx(6.0)
    assert not front.corner


def test_turned_outlines_find_what_a_search_over_points_finds() -> None:
    generator = np.random.default_rng(7)
    for _ in range(40):
        turn = generator.uniform(0.0, 2.0 * np.pi)
        c, s = np.cos(turn), np.sin(turn)
        ring = SQUARE @ np.array([[c, s], [-s, c]]) + 3.0
        ends = np.array([[-60.0, 22.0], [60.0, 22.0 + generator.uniform(-9.0, 9.0)]])
        front = Roads([line(*map(tuple, ends.tolist()))]).front_of(ring)
        dense = ends[0] + np.linspace(0.0, 1.0, 20_001)[:, None] * (ends[1] - ends[0])
        counted: list[float] = []
        for edge in range(4):
            along = ring[(edge + 1) % 4] - ring[edge]
            length = np.linalg.norm(along)
            off = dense - (ring[edge] + along / 2)
            nearest = off[np.argmin(np.linalg.norm(off, axis=1))]
            far = np.linalg.norm(nearest)
            ahead = nearest @ np.array([along[1], -along[0]]) / length
            counted.append(float(far - 3.0 - 0.1 * length) if ahead >= 0.5 * far else np.inf)
        assert front is not None
        assert front.edge == int(np.argmin(counted))


def test_a_corner_has_streets_on_two_sides_and_a_path_is_no_street() -> None:
    south, east = line((-20.0, -9.0), (40.0, -9.0)), line((19.0, -30.0), (19.0, 40.0))
    front = Roads([south, east]).front_of(SQUARE)
    assert front is not None
    assert front.edge == 0
    assert front.corner
    path = line((-20.0, 10.0), (40.0, 10.0), width=2.0, path=True)
    front = Roads([south, path]).front_of(SQUARE)
    assert front is not None
    assert front.edge == 0
    alone = Roads([path]).front_of(SQUARE)
    assert alone is not None
    assert alone.edge == 2


def test_what_is_far_or_behind_is_no_street() -> None:
    assert Roads([]).front_of(SQUARE) is None
    assert Roads([line((-500.0, -90.0), (500.0, -90.0))]).front_of(SQUARE) is None


@pytest.mark.parametrize(
    ("properties", "width"),
    [
        ({"highway": "primary"}, 11.0),
        ({"highway": "primary_link"}, 11.0),
        ({"highway": "residential", "width": "7,5 m"}, 7.5),
        ({"highway": "residential", "lanes": "4"}, 12.4),
        ({"name": "Rue des Halles"}, 6.0),
        (None, 6.0),
    ],
)
def test_widths(properties: Any, width: float) -> None:
    road = road_of(properties, SQUARE)
    assert road is not None
    assert road.width_m == pytest.approx(width)


@pytest.mark.parametrize(
    "properties", [{"waterway": "river"}, {"barrier": "fence"}, {"highway": "proposed"}]
)
def test_other_lines_are_no_roads(properties: dict[str, str]) -> None:
    assert road_of(properties, SQUARE) is None


@pytest.mark.parametrize("coordinates", [None, [[0, 0]], [["a", 0], [1, 1]], [[0, 0], [1]], 3])
def test_lines_that_cannot_be_read_are_none(coordinates: Any) -> None:
    found = list(lines_of({"type": "LineString", "coordinates": coordinates}))
    assert all(road_of({}, line) is None for line in found)


def collection(*features: dict[str, Any]) -> dict[str, Any]:
    crs = {"type": "name", "properties": {"name": "EPSG:2154"}}
    return {"type": "FeatureCollection", "crs": crs, "features": list(features)}


def feature(kind: str, coordinates: Any, **properties: Any) -> dict[str, Any]:
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def lot_feature() -> dict[str, Any]:
    ring = [[X + x, Y + y] for x, y in [*SQUARE.tolist(), SQUARE[0].tolist()]]
    return feature("Polygon", [ring], name="house")


def north_of_it() -> dict[str, Any]:
    return feature("LineString", [[X - 20, Y + 20], [X + 40, Y + 20]], highway="tertiary")


def test_a_lot_begins_at_its_street(tmp_path: Path) -> None:
    path = tmp_path / "lots.geojson"
    path.write_text(json.dumps(collection(lot_feature(), north_of_it())))
    lots = read_lots(path)
    (lot,) = lots.lots
    first, second = lot.rings_m[0][:2]
    assert np.allclose(second - first, [-10.0, 0.0])
    assert lot.attributes["streetWidth"] == 8.0
    assert lot.attributes["streetDistance"] == pytest.approx(8.0)
    assert lot.attributes["streetCorner"] is False
    assert any("road line" in note for note in lots.notes)


def test_roads_of_a_file_of_their_own_in_another_crs(tmp_path: Path) -> None:
    lots, roads = tmp_path / "lots.geojson", tmp_path / "roads.geojsonl"
    lots.write_text(json.dumps(collection(lot_feature())))
    # The same line in longitude and latitude, as GeoJSON by line has it.
    from veduta.geometry.crs import moved

    ends = moved(np.array([[X - 20, Y + 20], [X + 40, Y + 20]]), 2154, 4326)
    roads.write_text(json.dumps(feature("LineString", ends.tolist(), highway="service")) + "\n")
    (lot,) = read_lots(lots, LotOptions(roads=roads)).lots
    first, second = lot.rings_m[0][:2]
    assert np.allclose(second - first, [-10.0, 0.0])
    assert lot.attributes["streetWidth"] == 4.0
    assert lot.attributes["streetDistance"] == pytest.approx(10.0, abs=0.02)


def test_files_without_roads_are_refused(tmp_path: Path) -> None:
    lots, roads = tmp_path / "lots.geojson", tmp_path / "roads.geojsonl"
    lots.write_text(json.dumps(collection(lot_feature())))
    with pytest.raises(InputError, match="does not exist"):
        read_lots(lots, LotOptions(roads=roads))
    roads.write_text(json.dumps(feature("LineString", [[0, 0], [1, 1]], waterway="river")) + "\n")
    with pytest.raises(InputError, match="no lines that are roads"):
        read_lots(lots, LotOptions(roads=roads))
