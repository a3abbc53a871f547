"""The coarse model of a street as files, read by other readers than wrote them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from veduta.grammar.lots import read_lots
from veduta.synthetic.streets.gps import degrees_of, gps_places
from veduta.synthetic.streets.model_files import city_json, outlines_geojson
from veduta.synthetic.streets.plan import plan_street


def test_geojson_outlines_are_read_as_lots(tmp_path: Path) -> None:
    """The reader of lots finds the outlines, in the same CRS, where they are."""
    street = plan_street(1)
    path = tmp_path / "outlines.geojson"
    path.write_text(json.dumps(outlines_geojson(street, street.houses)))
    lots = read_lots(path)
    assert lots.crs == "EPSG:32632"
    assert [lot.id for lot in lots.lots] == [house.id for house in street.houses]
    for lot, house in zip(lots.lots, street.houses, strict=True):
        shift = np.add(lots.origin_m, lot.anchor_m) - street.origin_m
        found = np.sort(lot.rings_m[0] + shift[:2], axis=0)
        assert np.allclose(found, np.sort(house.outline_m, axis=0), atol=2e-3)


def test_city_json_solids_are_closed_and_as_large_as_the_houses() -> None:
    """Each edge is met twice, in opposite directions; the volume is that of a box."""
    street = plan_street(2)
    model = city_json(street, street.houses)
    vertices = np.array(model["vertices"]) * model["transform"]["scale"]
    for house in street.houses:
        (solid,) = model["CityObjects"][house.id]["geometry"]
        (shell,) = solid["boundaries"]
        assert len(solid["semantics"]["values"][0]) == len(shell)
        edges = set()
        volume = 0.0
        for (ring,) in shell:
            for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
                assert (a, b) not in edges
                edges.add((a, b))
            p, *rest = vertices[ring]
            for q, r in zip(rest, rest[1:], strict=False):
                volume += float(np.dot(p, np.cross(q, r))) / 6
        assert all((b, a) in edges for a, b in edges)
        height = house.top_m - house.base_m
        assert np.isclose(volume, house.width_m * house.depth_m * height, rtol=1e-3)


def test_gps_errs_as_much_as_it_is_told_to() -> None:
    """Over many seeds the error in plan is 5 m, half of its square common to all photos."""
    places = np.zeros((40, 3))
    errors = np.stack([gps_places(places, seed) for seed in range(300)])
    plan = np.hypot(errors[..., 0], errors[..., 1])
    assert 4.5 < float(np.sqrt(np.mean(plan**2))) < 5.5
    common = errors.mean(axis=1)[:, :2]
    assert 3.1 < float(np.sqrt(np.mean(np.sum(common**2, axis=1)))) < 4.1


def test_degrees_lie_where_the_crs_says() -> None:
    """A step of 100 m north is 100 m / 111.2 km of a degree of latitude, but for UTM's turn."""
    street = plan_street(0)
    degrees = degrees_of(street, np.array([[0.0, 0.0, 0.0], [0.0, 100.0, 3.0]]))
    assert np.isclose(degrees[1, 0] - degrees[0, 0], 100 / 111_200, rtol=2e-3)
    assert degrees[1, 2] == street.origin_m[2] + 3.0
