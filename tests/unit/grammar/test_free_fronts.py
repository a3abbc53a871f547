"""Where no road says it, a lot begins at an edge that no other lot stands against."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.grammar.free_fronts import FreeFronts
from veduta.grammar.lots import Lots, read_lots

X, Y = 650_000.0, 6_860_000.0


def box(x: float, y: float, wide: float, deep: float, first: int = 0) -> NDArray[np.float64]:
    """A rectangle that begins at its south (0), east, north or west (3) side."""
    corners = [[x, y], [x + wide, y], [x + wide, y + deep], [x, y + deep]]
    return np.roll(np.array(corners), -first, axis=0)


def read(folder: Path, *rings: NDArray[np.float64], **more: Any) -> Lots:
    features = [
        {
            "type": "Feature",
            "properties": {"name": f"lot-{row}"} | more.get("of", {}).get(row, {}),
            "geometry": {
                "type": "Polygon",
                "coordinates": [[[X + x, Y + y] for x, y in [*ring.tolist(), ring[0].tolist()]]],
            },
        }
        for row, ring in enumerate(rings)
    ]
    features += more.get("others", [])
    crs = {"type": "name", "properties": {"name": "EPSG:2154"}}
    path = folder / "lots.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    return read_lots(path)


def looks(lots: Lots, row: int) -> list[float]:
    """Where the first edge of a lot looks: (0, -1) is south."""
    along = lots.lots[row].rings_m[0][1] - lots.lots[row].rings_m[0][0]
    return (np.array([along[1], -along[0]]) / np.linalg.norm(along)).round(6).tolist()


def test_an_edge_between_neighbours_is_no_front(tmp_path: Path) -> None:
    """Three in a row whose files begin at party walls, the row behind 12 m to the south."""
    row = [box(0, 0, 8, 12, 1), box(8, 0, 8, 12, 1), box(16, 0, 8, 12, 3)]
    lots = read(tmp_path, *row, box(-10, -24, 50, 12, 2))
    assert [looks(lots, each) for each in range(3)] == [[-1, 0], [0, 1], [1, 0]], "30 m north"
    assert any("3 lots begin at another edge" in note for note in lots.notes)


def test_of_two_free_edges_it_is_the_one_with_more_before_it(tmp_path: Path) -> None:
    court = box(-10, 18, 50, 12)
    lots = read(tmp_path, box(0, 0, 8, 12, 1), box(8, 0, 8, 12), box(-8, 0, 8, 12), court)
    assert looks(lots, 0) == [0, -1], "6 m of court behind, the open before it"


@pytest.mark.parametrize("first", range(4))
def test_a_free_first_edge_stays_the_first(tmp_path: Path, first: int) -> None:
    """As files say it that were made so: also where another is longer or has more before it."""
    lots = read(tmp_path, box(0, 0, 8, 20, first), box(-40, 30, 90, 5), box(20, 0, 8, 20))
    assert looks(lots, 0) == [[0, -1], [1, 0], [0, 1], [-1, 0]][first]
    assert not any("edge" in note for note in lots.notes)


def test_a_lot_that_is_free_nowhere_keeps_its_first_edge(tmp_path: Path) -> None:
    around = [box(-9, -9, 28, 8), box(-9, 11, 28, 8), box(-9, -1, 8, 12), box(11, -1, 8, 12)]
    lots = read(tmp_path, box(0, 0, 10, 10, 2), *around)
    assert looks(lots, 0) == [0, 1]


def test_roads_and_edges_of_the_file_come_first(tmp_path: Path) -> None:
    line = {"type": "LineString", "coordinates": [[X - 20, Y + 20], [X + 40, Y + 20]]}
    road = {"type": "Feature", "properties": {"highway": "residential"}, "geometry": line}
    pair = [box(0, 0, 8, 12, 1), box(8, 0, 8, 12, 3)]
    assert looks(read(tmp_path, *pair, others=[road]), 0) == [0, 1]
    told = {0: {"/edgeattr/streetWidth": [5, 0, 0, 0]}}
    lots = read(tmp_path, *pair, of=told)
    assert looks(lots, 0) == [1, 0]
    assert looks(lots, 1) == [1, 0]


def test_outlines_that_cannot_be_placed_stand_before_nothing() -> None:
    crossed = np.array([[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]])
    square = box(10, 0, 5, 5, 3)
    assert FreeFronts([[crossed], [square], []]).edge_of(square) == 0
    assert FreeFronts([]).edge_of(square) == 0
    wall = box(9, -1, 0.9, 7)
    fronts = FreeFronts([[wall], [square]])
    assert fronts.edge_of(square) != 0
    assert fronts.count == 1


def test_a_turned_row_does_as_it_did() -> None:
    turn = np.array([[0.8, 0.6], [-0.6, 0.8]])
    row = [box(8.0 * x, 0, 8, 12, 1) @ turn + 5e5 for x in range(4)]
    fronts = FreeFronts([[ring] for ring in row])
    assert [fronts.edge_of(ring) for ring in row] == [2, 3, 3, 0], "those between look one way"
