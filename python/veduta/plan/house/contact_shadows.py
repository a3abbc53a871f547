"""Soft dark edges on the floor where furniture meets it: without them things seem to float.

A viewer's lamps and its sun leave no shade where a foot touches the floor. Layers of one dark
colour, each a little larger and thinly seen through, lie on each other: what stands on the floor
has all of them around its feet, what hangs low over it few, and wide ones, be it a part of what
stands or fixed to a wall. Invented, as all furniture, and drawn only (`place.semantics`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.affinity import rotate, translate
from shapely.geometry import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Furniture, Room
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.shapes import asset_of
from veduta.plan.house.floors import FINISH_M
from veduta.plan.house.frame import Sculptor, Surface, level
from veduta.plan.house.furniture import footprint
from veduta.plan.house.space import Space, pieces_of

LOOK = "contact shadow"
LAYERS_M = (0.12, 0.09, 0.066, 0.046, 0.03, 0.017, 0.006)
"""How far each layer reaches beyond what touches the floor, the lowest and widest first."""
FLAT_M = 0.03
"""What is no higher is a rug: others cast their shade on it."""
_OVER: tuple[tuple[float, float, int], ...] = ((0.06, 0.05, 6), (0.2, 0.10, 5), (0.45, 0.15, 4))
"""Undersides from so high on, to the next: how far their shade blurs, and in how many layers."""
_HIGHEST_M = 0.85
_ROUND_M = 0.03
"""Corners of layers that reach no farther are cut once, others are rounder."""
_RISE_M, _STEP_M = 0.0008, 0.0003
_LEAST_M2 = 4e-4


@dataclass(frozen=True)
class Shade:
    """What an object does to the floor, in its own frame: what touches it, and what hangs low.

    over: the regions under its undersides, one for each of `_OVER`.
    """

    touching: BaseGeometry
    over: tuple[BaseGeometry, ...]


def add_contact_shadows(space: Space, catalogue: Catalogue, sculptor: Sculptor) -> None:
    """The shadows of a storey's furniture, one feature for each room."""
    for room, region in space.floors:
        if room is None:
            continue
        own = [one for one in space.storey.furniture or () if one.room == room.id]
        layers = _layers([_placed(one, catalogue) for one in own if _shades(one)], region)
        if all(layer.is_empty for layer in layers):
            continue
        feature = sculptor.builder.feature(
            SemanticClass.SHADOW, Provenance.INVENTED, shadows_of(space, room),
            shell=sculptor.builder.new_shell(),
        )  # fmt: skip
        rugs = [one for one in own if one.above_m < FLAT_M >= one.size_m[2]]
        for number, layer in enumerate(layers):
            rise = FINISH_M + _RISE_M + number * _STEP_M
            for piece, height in _laid(layer, rugs):
                _lay(piece, rise + height, space, sculptor, Surface(feature, LOOK))


def shadows_of(space: Space, room: Room) -> str:
    """What the feature of a room's shadows is called."""
    return f"{space.name_of(room)} contact shadows"


def _shades(one: Furniture) -> bool:
    """Whether a thing shades the floor: no rug, nothing that stands on another thing."""
    return one.on is None and one.above_m < _HIGHEST_M and one.above_m + one.size_m[2] > FLAT_M


def _lay(
    region: BaseGeometry, height_m: float, space: Space, sculptor: Sculptor, surface: Surface
) -> None:
    """Sheets, as prisms would be six times as large in a file."""
    frame = level(space.storey.elevation_m)
    for piece in map(orient, pieces_of(region)):
        rings = [np.array(ring.coords)[:-1] for ring in (piece.exterior, *piece.interiors)]
        sculptor.face(
            [np.column_stack([ring, np.full(len(ring), height_m)]) for ring in rings],
            frame, surface,
        )  # fmt: skip


def _placed(thing: Furniture, catalogue: Catalogue) -> Shade:
    entry = catalogue.entries[thing.object]
    asset = asset_of(entry, thing.size_m, catalogue, coarse=True)
    hung = asset.points_m + np.array([0.0, thing.above_m, 0.0])
    shade = _shade(_Triangles(hung[asset.corners[asset.triangles[0]]]))

    def moved(shape: BaseGeometry) -> BaseGeometry:
        turned = rotate(shape, thing.turn_rad, origin=(0.0, 0.0), use_radians=True)
        return translate(turned, *thing.at_m)

    return Shade(moved(shade.touching), tuple(moved(one) for one in shade.over))


class _Triangles:
    """(n, 3, 3) corners of an asset (y up from the floor), known by their bytes."""

    def __init__(self, corners_m: NDArray[np.float64]) -> None:
        self.corners_m = corners_m
        self._key = corners_m.tobytes()

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Triangles) and self._key == other._key


@lru_cache(maxsize=256)
def _shade(triangles: _Triangles) -> Shade:
    """What of an object touches the floor, seen from above, and what is open below."""
    corners = triangles.corners_m
    lowest = corners[:, :, 1].min(axis=1)
    flat = np.stack([corners[:, :, 0], -corners[:, :, 2]], axis=2)
    down = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    looks_down = down[:, 1] < -0.5 * np.linalg.norm(down, axis=1)
    starts = [start for start, _, _ in _OVER]
    ends = [*starts[1:], _HIGHEST_M]
    over = tuple(
        _seen_from_above(flat[looks_down & (lowest >= start) & (lowest < end)])
        for start, end in zip(starts, ends, strict=True)
    )
    return Shade(_seen_from_above(flat[lowest < starts[0]]), over)


def _seen_from_above(triangles: NDArray[np.float64]) -> BaseGeometry:
    """The outline of (n, 3, 2) triangles, without holes: what stands around nothing is hollow."""
    shapes = shapely.polygons(np.concatenate([triangles, triangles[:, :1]], axis=1))
    grown = unary_union(shapely.buffer(shapes, 0.003, quad_segs=1))
    filled = [Polygon(piece.exterior) for piece in pieces_of(grown)]
    return unary_union(filled).simplify(0.005) if filled else MultiPolygon()


def _layers(shades: Sequence[Shade], floor: BaseGeometry) -> list[BaseGeometry]:
    """The layers of a room, the widest first."""
    found = []
    for number, reach in enumerate(LAYERS_M):
        shapes = [
            one.touching.buffer(reach, quad_segs=3 if reach > _ROUND_M else 1) for one in shades
        ]
        for index, (_, blur, count) in enumerate(_OVER):
            if number < count:
                out = blur * (1.0 - 2.0 * number / (count - 1))
                shapes += [one.over[index].buffer(out, quad_segs=4) for one in shades]
        region = unary_union(shapes).intersection(floor).simplify(0.002 + 0.04 * reach)
        found.append(_clean(region))
    return found


def _laid(layer: BaseGeometry, rugs: Sequence[Furniture]) -> list[tuple[BaseGeometry, float]]:
    """A layer in pieces by what it lies on: the floor, or the top of a rug; heights in metres."""
    found = []
    for rug in rugs:
        own = footprint(rug)
        found.append((_clean(layer.intersection(own)), rug.size_m[2] + 0.002))
        layer = layer.difference(own)
    return [*found, (_clean(layer), 0.0)]


def _clean(region: BaseGeometry) -> BaseGeometry:
    """The polygons of a region, without slivers."""
    kept = [piece for piece in pieces_of(region) if piece.area > _LEAST_M2]
    return MultiPolygon(kept) if kept else MultiPolygon()
