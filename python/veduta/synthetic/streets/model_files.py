"""The coarse model of a street as files that others publish: CityJSON 2.0 and GeoJSON outlines.

https://www.cityjson.org/specs/2.0.1/ and RFC 7946, but for the older member `crs` of GeoJSON,
which programs still read: outlines of cadastres come in the projected system of their country.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from veduta.synthetic.streets.house import House, Street

GRID_M = 1e-3


def city_json(street: Street, houses: Sequence[House]) -> dict[str, Any]:
    """Each building as a Solid of level of detail 1.2, in the street's CRS, metres."""
    vertices: list[list[int]] = []
    objects: dict[str, Any] = {}
    for house in houses:
        first = len(vertices)
        for height in (house.base_m, house.top_m):
            steps = np.rint(np.column_stack([house.outline_m, np.full(4, height)]) / GRID_M)
            vertices += steps.astype(int).tolist()
        objects[house.id] = {
            "type": "Building",
            "attributes": {"measuredHeight": round(house.top_m - house.base_m, 3)},
            "geometry": [_solid(first, len(house.outline_m))],
        }
    code = street.crs.removeprefix("EPSG:")
    return {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": {"referenceSystem": f"https://www.opengis.net/def/crs/EPSG/0/{code}"},
        "transform": {"scale": [GRID_M] * 3, "translate": list(street.origin_m)},
        "CityObjects": objects,
        "vertices": vertices,
    }


def _solid(first: int, corners: int) -> dict[str, Any]:
    """Walls in the order of the outline's edges, then the lid and the floor."""
    low = [first + number for number in range(corners)]
    high = [number + corners for number in low]
    following = [(number + 1) % corners for number in range(corners)]
    walls = [[[low[a], low[b], high[b], high[a]]] for a, b in enumerate(following)]
    kinds = ("WallSurface", "RoofSurface", "GroundSurface")
    return {
        "type": "Solid",
        "lod": "1.2",
        "boundaries": [[*walls, [high], [low[::-1]]]],
        "semantics": {
            "surfaces": [{"type": kind} for kind in kinds],
            "values": [[*([0] * corners), 1, 2]],
        },
    }


def outlines_geojson(street: Street, houses: Sequence[House]) -> dict[str, Any]:
    """Outlines in the street's CRS, with the height and the ground's height above the sea (m)."""
    east, north, up = street.origin_m
    features = []
    for house in houses:
        ring = (house.outline_m + np.array([east, north])).round(3).tolist()
        features.append(
            {
                "type": "Feature",
                "id": house.id,
                "properties": {
                    "height": round(house.top_m - house.base_m, 3),
                    "ground_elevation": round(up + house.base_m, 3),
                },
                "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
            }
        )
    code = street.crs.removeprefix("EPSG:")
    return {
        "type": "FeatureCollection",
        "crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{code}"}},
        "features": features,
    }
