"""What is in a house beside its rooms: stairs and rails, lamps, furniture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.formats.cityjson_solids import CityDocument, CityFace, Rings
from veduta.grammar.assets.asset import Asset
from veduta.place.part import Part
from veduta.plan.city.marked import Mark, Marks, one_mark
from veduta.plan.city.matter import solid_of
from veduta.plan.city.surfaces import SurfaceTable, installed_kind
from veduta.plan.furnish.catalogue.entry import Size
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.shapes import asset_of
from veduta.plan.house.build import House
from veduta.plan.house.floors import FINISH_M
from veduta.plan.house.space import Space
from veduta.plan.house.stair_pieces import guard_rails, stair_pieces

PART_FROM_ASSET = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Row vectors of assets (y up) times this are those of parts (z up)."""


def storey_id(house: House, space: Space) -> str:
    """The id of a storey's object."""
    return f"{house.part.id}/{space.storey.name}".replace(" ", "-")


def not_closed(name: str, shape: Mapping[str, object]) -> list[str]:
    """A note where the geometry of an object is no closed solid."""
    if shape["type"] != "MultiSurface":
        return []
    return [f"{name} is no closed solid in house.city.json: its surfaces alone are there"]


def add_stairs(
    house: House, document: CityDocument, table: SurfaceTable, marks: Marks
) -> list[str]:
    """Stairs, columns of spirals and rails as installations of the rooms in which they begin.

    Returns which are no closed solids.
    """
    stairs = stair_pieces(house)
    pieces = [(one.space, one.name, "stairs", one.body) for one in stairs]
    single = [
        (one.space, name, kind, row)
        for one in stairs
        for kind, named in (("column", one.columns), ("rail", one.rails))
        for name, row in named.items()
    ]
    single += [(space, name, "rail", row) for space, name, row in guard_rails(house)]
    pieces += [(space, name, kind, (row,)) for space, name, kind, row in single]
    notes: list[str] = []
    for space, name, kind, features in pieces:
        shells = _shells(house.part, name, features, table, marks)
        shape = document.solid(shells, table.surfaces(shells))
        own = document.add(
            f"{house.part.id}/{name}".replace(" ", "-"),
            "BuildingInstallation",
            _room_of(document, house, space, features),
            {"class": kind, "name": name},
            [shape],
        )
        notes += not_closed(own, shape)
    return notes


def _shells(
    part: Part, name: str, features: Sequence[int], table: SurfaceTable, marks: Marks
) -> list[list[CityFace]]:
    """The faces of each body that features close, or else their polygons.

    A rail is as many bodies as it has corners: a shell must hang together (ISO 19107).
    """
    solid = solid_of(part, features)
    if solid is None:
        polygons = _polygons(part, features)
        return [[CityFace(rings, ("InteriorWallSurface", name)) for rings in polygons]]
    marked = marks.marked(solid, one_mark(Mark("slab", name)))
    return [table.faces(marks.faces(body), installed_kind) for body in marked.decompose()]


def _polygons(part: Part, features: Sequence[int]) -> list[Rings]:
    chosen = np.flatnonzero(np.isin(part.polygon_feature, features))
    points, ends = part.positions_m.astype(np.float64), part.ring_offsets
    return [
        [
            points[ends[ring] : ends[ring + 1]]
            for ring in range(*part.polygon_offsets[row : row + 2])
        ]
        for row in chosen.tolist()
    ]


def _room_of(document: CityDocument, house: House, space: Space, features: Sequence[int]) -> str:
    """The object of the room over whose floor the lowest of some features lies, or the storey's."""
    points = np.concatenate([ring for rings in _polygons(house.part, features) for ring in rings])
    lowest = points[points[:, 2] <= points[:, 2].min() + 0.01, :2].mean(axis=0)
    room = space.room_at(lowest)
    return _within(document, house, space, None if room is None else room.id)


def _within(document: CityDocument, house: House, space: Space, room: str | None) -> str:
    """The object of a room, or of its storey where it has none (it is outdoors)."""
    storey = storey_id(house, space)
    return f"{storey}/{room}" if f"{storey}/{room}" in document.objects else storey


def add_lamps(house: House, document: CityDocument) -> None:
    """Lamps that have a body of their own, each shape once."""
    row_of = {name: row for row, name in enumerate(house.part.features.name)}
    known: dict[bytes, int] = {}
    for space in house.spaces:
        for light in space.storey.lights or ():
            name = f"{space.storey.name} light {light.id}"
            if name not in row_of:
                continue
            faces = _polygons(house.part, [row_of[name]])
            at = np.array([*light.at_m, space.storey.elevation_m + light.above_m])
            own = [[(ring - at).round(3) + 0.0 for ring in rings] for rings in faces]
            key = np.concatenate([ring for rings in own for ring in rings]).tobytes()
            if key not in known:
                known[key] = document.template(own)
            parent = _within(document, house, space, light.room)
            document.add(
                f"{house.part.id}/{name}".replace(" ", "-"), "BuildingInstallation", parent,
                {"class": f"{light.kind} lamp", "lumen": light.lumen, "provenance": light.origin},
                [document.instance(known[key], at, np.eye(3))],
            )  # fmt: skip


def add_furniture(house: House, document: CityDocument, catalogue: Catalogue) -> None:
    """Furniture in its coarse shapes, each once for all that stand there."""
    known: dict[tuple[str, Size], int] = {}
    for space in house.spaces:
        for thing in space.storey.furniture or ():
            key = (thing.object, thing.size_m)
            entry = catalogue.entries[thing.object]
            if key not in known:
                asset = asset_of(entry, thing.size_m, catalogue, coarse=True)
                known[key] = document.template(_asset_faces(asset))
            c, s = np.cos(thing.turn_rad), np.sin(thing.turn_rad)
            turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
            floor = space.storey.elevation_m + FINISH_M
            at = np.array([*thing.at_m, floor + thing.above_m])
            name = f"{space.storey.name} {thing.object} {thing.id}"
            document.add(
                f"{house.part.id}/{name}".replace(" ", "-"), "BuildingFurniture",
                _within(document, house, space, thing.room),
                {"class": entry.kind, "function": entry.type, "name": thing.object,
                 "provenance": thing.origin},
                [document.instance(known[key], at, turn)],
            )  # fmt: skip


def _asset_faces(asset: Asset) -> list[Rings]:
    points: NDArray[np.float64] = asset.points_m @ PART_FROM_ASSET
    ends = asset.offsets.tolist()
    return [
        [points[asset.corners[first:last]]] for first, last in zip(ends, ends[1:], strict=False)
    ]
