"""The buildings that no photo shows: a plain colour, and many of them in a file.

They stand around the textured ones, and they hide what is behind them; but a city has many, and
there is nothing to tell of each but where the model has it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.texture.part import PLAIN
from veduta.place.material import Material
from veduta.place.part import NO_PARENT, Features, Part
from veduta.place.semantics import Provenance

MOST_BUILDINGS = 2000
"""In a part: few files of a few megabytes each."""
WIDEST_M = 4000.0
"""A part is in single precision about its own origin."""
NAME = "surroundings"


@dataclass(frozen=True)
class Surroundings:
    """Buildings (rows of the city model) as one part about `offset_m`."""

    buildings: tuple[int, ...]
    part: Part
    offset_m: tuple[float, float, float]


def surroundings_of(city: CityModel, buildings: Sequence[int]) -> list[Surroundings]:
    """These buildings in parts of neighbours; no part is called as a building is."""
    taken = {building.id for building in city.buildings}
    found: list[Surroundings] = []
    for own in _neighbours(city, np.array(buildings, dtype=np.int64)):
        number = len(found) + 1
        name = f"{NAME}-{number}"
        while name in taken:
            name = f"{name}-plain"
        found.append(_joined(name, city, own.tolist()))
    return found


def _neighbours(city: CityModel, rows: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Halved along the longer side until each group is small."""
    if not len(rows):
        return []
    places = np.array([city.buildings[row].offset_m[:2] for row in rows.tolist()])
    extent = np.ptp(places, axis=0)
    if len(rows) <= MOST_BUILDINGS and extent.max() <= WIDEST_M:
        return [rows]
    if len(rows) == 1 or extent.max() <= 0.0:
        return [rows[k : k + MOST_BUILDINGS] for k in range(0, len(rows), MOST_BUILDINGS)]
    order = rows[np.argsort(places[:, int(extent.argmax())], kind="stable")]
    half = len(order) // 2
    return [*_neighbours(city, order[:half]), *_neighbours(city, order[half:])]


def _joined(name: str, city: CityModel, rows: Sequence[int]) -> Surroundings:
    """One part of many; the names of surfaces begin with those of their buildings."""
    own = [city.buildings[row] for row in rows]
    offset = np.min([building.offset_m for building in own], axis=0)
    parts = [building.part for building in own]
    vertices, rings, polygons, features = (
        np.cumsum([0, *counts])
        for counts in (
            [len(part.positions_m) for part in parts],
            [len(part.ring_offsets) - 1 for part in parts],
            [len(part.polygon_feature) for part in parts],
            [len(part.features) for part in parts],
        )
    )
    joined = Part(
        id=name,
        positions_m=np.concatenate([_about(building, offset) for building in own]),
        uv=np.zeros((int(vertices[-1]), 2), dtype=np.float32),
        ring_offsets=_offsets([part.ring_offsets for part in parts], vertices),
        polygon_offsets=_offsets([part.polygon_offsets for part in parts], rings),
        polygon_feature=np.concatenate(
            [part.polygon_feature + first for part, first in zip(parts, features, strict=False)]
        ).astype(np.int32),
        polygon_material=np.zeros(int(polygons[-1]), dtype=np.int32),
        features=_features(parts, features),
        materials=(Material("unseen", colour=PLAIN),),
    )
    x, y, z = offset.tolist()
    return Surroundings(tuple(rows), joined, (x, y, z))


def _about(building: CityBuilding, offset: NDArray[np.float64]) -> NDArray[np.float32]:
    moved = building.part.positions_m.astype(np.float64) + building.offset_m - offset
    return np.asarray(moved, dtype=np.float32)


def _offsets(each: Sequence[NDArray[np.int64]], firsts: NDArray[np.int64]) -> NDArray[np.int64]:
    begun = [own[:-1] + first for own, first in zip(each, firsts, strict=False)]
    return np.concatenate([*begun, firsts[-1:]]).astype(np.int64)


def _features(parts: Sequence[Part], firsts: NDArray[np.int64]) -> Features:
    """All features; nothing but the model speaks for any of them."""
    columns = {
        column.name: np.concatenate([getattr(part.features, column.name) for part in parts])
        for column in fields(Features)
        if column.name not in ("id", "name", "parent")
    }
    parents = [
        np.where(part.features.parent == NO_PARENT, NO_PARENT, part.features.parent + first)
        for part, first in zip(parts, firsts, strict=False)
    ]
    joined = Features(
        id=tuple(f"{part.id}/{one}" for part in parts for one in part.features.id),
        name=tuple(f"{part.id}: {one}" for part in parts for one in part.features.name),
        parent=np.concatenate(parents).astype(np.int32),
        **columns,
    )
    inferred = np.full(len(joined), Provenance.INFERRED.code, dtype=np.uint8)
    return replace(joined, provenance_code=inferred)
