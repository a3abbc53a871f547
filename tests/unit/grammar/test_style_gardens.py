"""Gardens of detached houses: ways from the street to door and garage, fences, what grows."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from test_styles import Ring, derive, ring

from veduta.place.instances import placed
from veduta.place.part import Part
from veduta.place.semantics import Provenance

STYLE = "suburban-house"
# The front of each is its first edge, or its first edges; it looks to -y. The wedge is as narrow at
# the street as a house with its garage, so that the largest rectangle in it lies behind.
LOTS: dict[str, list[Ring]] = {
    "rectangle": [ring((0, 0), (24, 0), (24, 34), (0, 34))],
    "large": [ring((0, 0), (34, 0), (34, 50), (0, 50))],
    "wedge": [ring((0, 0), (15, 0), (24, 40), (-9, 40))],
    "curved": [ring((0, 3), (10, -1), (20, 0), (28, 4), (26, 38), (0, 40))],
}


def named(part: Part, name: str) -> list[int]:
    """The features that a rule of this name made."""
    told = part.features.name
    return [row for row in range(len(part.features)) if told[row].split(" ")[0] == name]


def points_of(part: Part, rows: list[int]) -> NDArray[np.float64]:
    """(n, 3) the corners of some features (m), those of repeated assets too."""
    chosen = np.isin(part.polygon_feature[part.triangles.polygon], rows)
    found = [part.positions_m[part.triangles.indices[chosen]].reshape(-1, 3).astype(np.float64)]
    assert part.instances is not None
    for group in part.instances.groups:
        corners = part.instances.meshes[group.mesh].positions_m.astype(np.float64)
        places = group.part_from_mesh[np.isin(group.feature, rows)]
        found.append(placed(places, corners).reshape(-1, 3))
    return np.concatenate(found)


def ways_of(part: Part) -> list[shapely.Geometry]:
    """What is paved on the map: the paths, the drive and the terrace."""
    points = [points_of(part, [row]) for row in named(part, "Drive")]
    return [shapely.MultiPoint(one[:, :2]).convex_hull for one in points]


@pytest.mark.parametrize("name", LOTS)
def test_ways_lead_from_the_street_to_door_and_garage(name: str) -> None:
    (part,) = derive(STYLE, [LOTS[name]], withGarage=True, porch="none", LOD=2.0)
    lot = shapely.Polygon(np.array(LOTS[name][0])[:, :2])
    ways = ways_of(part)
    assert all(lot.buffer(0.05).contains(way) for way in ways)
    for rule in ("DoorPanelled", "DoorGarage"):
        found = points_of(part, named(part, rule))
        if rule == "DoorGarage" and name == "curved":  # its rectangle is too narrow for a garage
            assert len(found) == 0
            continue
        door = shapely.MultiPoint(found[:, :2]).convex_hull.centroid
        (way,) = (way for way in ways if way.distance(door) < 0.5)
        far = max(door.distance(shapely.Point(corner)) for corner in way.exterior.coords)
        assert way.distance(lot.exterior) < 0.05
        assert far > 5.0


@pytest.mark.parametrize("name", LOTS)
def test_fences_stand_on_the_edge_but_across_no_way(name: str) -> None:
    (part,) = derive(STYLE, [LOTS[name]], withGarage=True, LOD=2.0)
    lot = shapely.Polygon(np.array(LOTS[name][0])[:, :2])
    boards, pickets = (points_of(part, named(part, one)) for one in ("FenceBoards", "FencePickets"))
    fence = shapely.points(np.concatenate([boards, pickets])[:, :2])
    assert len(boards) > 0
    assert len(pickets) > 0
    assert shapely.distance(fence, lot.exterior).max() < 0.15
    paved = shapely.union_all(ways_of(part))
    assert not shapely.contains(paved.buffer(-0.1), fence).any()
    pales = shapely.union_all(shapely.buffer(shapely.points(pickets[:, :2]), 0.2))
    panels = shapely.MultiPoint(boards[:, :2]).buffer(0.2)
    ends = [edge for edge in edges_of(LOTS[name]) if panels.covers(edge.boundary)]
    bare = lot.exterior.difference(pales).difference(paved.buffer(0.4))
    assert bare.difference(shapely.union_all(ends).buffer(0.01)).length < 0.5


def edges_of(lot: list[Ring]) -> list[shapely.LineString]:
    """The edges of an outline on the map."""
    outline = np.array(lot[0])[:, :2]
    ends = zip(outline, np.roll(outline, -1, axis=0), strict=True)
    return [shapely.LineString(edge) for edge in ends]


def test_nothing_that_is_small_grows_where_all_is_seen_from_afar() -> None:
    afar, near = (derive(STYLE, [LOTS["large"]], LOD=level)[0] for level in (1.0, 2.0))
    assert named(near, "Tree")
    assert not named(afar, "Tree")
    assert not named(afar, "FenceBoards")
    assert named(afar, "Drive")  # the ways are drawn, which one sees


def test_what_grows_lies_in_the_lot_and_is_invented() -> None:
    (part,) = derive(STYLE, [LOTS["large"]], LOD=2.0)
    low, high = part.bounds_m
    assert low[0] > -0.2
    assert max(high[0] - 34.0, high[1] - 50.0) < 0.2
    assert set(part.features.provenance_code) == {Provenance.INVENTED.code}
    trees = points_of(part, named(part, "Tree"))
    house = points_of(part, named(part, "Flank") + named(part, "Back"))
    assert trees[:, 1].max() > house[:, 1].max()


def test_without_fences_there_are_none() -> None:
    (part,) = derive(STYLE, [LOTS["large"]], withFences=False, LOD=2.0)
    assert not named(part, "FenceBoards")
    assert not named(part, "FencePickets")
    assert named(part, "Tree")
