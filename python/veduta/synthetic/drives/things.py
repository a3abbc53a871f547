"""What stands in a made street besides its houses: ground, cars, trees, lamps, a hedge, rooms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.drives.houses import MadeHouse
from veduta.synthetic.drives.street import Kind
from veduta.synthetic.drives.way import Way
from veduta.synthetic.looks import Look
from veduta.synthetic.mesh import MeshBuilder
from veduta.synthetic.street import PAVEMENT_M, Occluder, add_occluder, street_looks

if TYPE_CHECKING:
    from veduta.synthetic.drives.made_street import MadeStreetOptions

Floats = NDArray[np.float64]
_KERB_M = 7.4
"""From the path to the kerb."""
_ASIDE_M = 60.0
_STRIP_M = 2.0
_CAR_EVERY_M, _TREE_EVERY_M, _LAMP_EVERY_M = 6.0, 9.0, 25.0
_CAR_M, _TREE_M, _LAMP_M = 4.6, 7.2, 6.9
"""How far from the path they stand."""
_OWN_M: Mapping[Occluder, float] = {
    "car": PAVEMENT_M + 1.125, "tree": PAVEMENT_M - 0.6, "lamp": PAVEMENT_M - 0.4,
}  # fmt: skip
"""How far before its wall the generator puts one."""
_ROAD_M = 0.13
"""By which its road lies below its pavement."""
_PAINTS = 5
_LOWER_M, _LAND_M = 0.002, 0.007
"""By which the land around lies lower, so that it is not seen through what is on it."""
_HEDGE_M = (8.6, 9.2, 1.3)
_HEDGE_PIECE_M, _HEDGE_GAP_M = 5.6, 0.4


@dataclass(frozen=True, eq=False)
class Placed:
    """A part where it stands. world_from_part: (4, 4)."""

    part: Part
    world_from_part: Floats
    kind: Kind
    mirrors: Mapping[str, NDArray[np.uint8]] = field(default_factory=dict)


def parked(options: MadeStreetOptions, seed: int, random: np.random.Generator) -> list[Placed]:
    """Cars in a row of parking places, trees behind the kerb, and lamps."""
    found: list[Placed] = []
    rows: tuple[tuple[Occluder, float, float, float, float], ...] = (
        ("car", 4.0, _CAR_EVERY_M, options.cars, _CAR_M),
        ("tree", 5.0, _TREE_EVERY_M, options.trees, _TREE_M),
        ("lamp", 12.0, _LAMP_EVERY_M, options.lamps, _LAMP_M),
    )
    for kind, first, every, share, away in rows:
        for number, place in enumerate(np.arange(first, options.length_m - 3.0, every).tolist()):
            aside, along, larger = random.uniform(-0.25, 0.25), random.uniform(-0.6, 0.6), 1.0
            if random.uniform() >= share:
                continue
            if kind != "lamp":
                larger = float(random.uniform(0.9, 1.15))
            frame = _at(options.way, place + along, away + aside) @ np.diag([larger] * 3 + [1.0])
            found.append(_thing(kind, f"{kind} {number}", frame, seed + 31 * number))
    return found


@lru_cache
def _looks(seed: int) -> Mapping[str, Look]:
    """Making textures takes longer than all else of a street: a few of them are enough."""
    return street_looks(seed)


def _thing(kind: Occluder, name: str, frame: Floats, seed: int) -> Placed:
    looks = _looks(seed % _PAINTS)
    builder = MeshBuilder({key: look.tile_m for key, look in looks.items()})
    add_occluder(builder, kind, 0.0, seed, 0)
    moved = np.eye(4)
    moved[1:3, 3] = _OWN_M[kind], _ROAD_M if kind == "car" else 0.0
    mirrors = {
        f"{name} {key}": texels
        for key in builder.materials
        if (texels := looks[key].mirror) is not None
    }
    return Placed(_part(builder, name, looks), frame @ moved, Kind.OBJECT, mirrors)


def hedge_parts(options: MadeStreetOptions, seed: int) -> list[Placed]:
    """Pieces of a hedge all along, with narrow gaps."""
    looks = _looks(seed % _PAINTS)
    near, far, high = _HEDGE_M
    found = []
    every = _HEDGE_PIECE_M + _HEDGE_GAP_M
    for number, place in enumerate(np.arange(-10.0, options.length_m + 10.0, every).tolist()):
        builder = MeshBuilder({"leaves": (1.0, 1.0)})
        half = _HEDGE_PIECE_M / 2
        builder.box((-half, 0.0, 0.0), (half, far - near, high), "leaves", 0)
        frame = _at(options.way, place + half, near)
        found.append(Placed(_part(builder, f"hedge {number}", looks), frame, Kind.OBJECT))
    return found


def rooms_part(house: MadeHouse, world_from_part: Floats, random: np.random.Generator) -> Placed:
    """What one sees through a house's windows: a wall some metres in, floors, and partitions."""
    builder = MeshBuilder({})
    wide, high = house.width_m, float(house.part.positions_m[:, 2].max())
    deep = float(random.uniform(3.0, 4.5))
    # Farther in than arcades and loggias are deep.
    inner, thick = 2.3, 0.1
    top = 0.7 * high
    builder.box((0.3, deep, 0.0), (wide - 0.3, deep + thick, top), "wall", 0)
    for level in np.arange(3.0, top, 3.1).tolist():
        builder.box((0.3, inner, level), (wide - 0.3, deep, level + thick), "wall", 0)
    for share in (0.33, 0.67):
        at = share * wide
        builder.box((at, inner, 0.0), (at + thick, deep, top), "wall", 0)
    looks = {"wall": Look(np.full((2, 2, 3), 120, np.uint8))}
    part = _part(builder, f"rooms of {house.part.id}", looks)
    return Placed(part, world_from_part, Kind.BEHIND_GLASS)


def ground_part(way: Way, length_m: float, seed: int) -> Part:
    """Asphalt up to the kerb, paving beyond it, flat, in strips across the way: a little lower than
    z = 0, where houses have floors of their own.
    """
    looks = _looks(seed % _PAINTS)
    builder = PartBuilder("ground")
    feature = builder.feature(SemanticClass.GROUND, Provenance.MEASURED, "ground")
    materials = [
        builder.material(_material(key, looks[key].texture)) for key in ("asphalt", "paving")
    ]
    # Where bends are tighter than a band is wide, strips would cross each other: there it ends.
    aside = min(_ASIDE_M, 0.8 * way.radius_m)
    bands = ((-aside, _KERB_M, 0), (_KERB_M, aside, 1))
    ends = np.arange(-_ASIDE_M, length_m + _ASIDE_M + 1e-6, _STRIP_M)
    frames = way.frames(np.concatenate([ends, [length_m]]))[:-1]
    for first, second in pairwise(range(len(ends))):
        for near, far, which in bands:
            ring = [_beside(frames[first], near), _beside(frames[second], near),
                    _beside(frames[second], far), _beside(frames[first], far)]  # fmt: skip
            tile = looks["asphalt" if which == 0 else "paving"].tile_m[0]
            around = np.array([[ends[first], near], [ends[second], near],
                               [ends[second], far], [ends[first], far]]) / tile  # fmt: skip
            builder.polygon([ring], feature, materials[which], _known(around))
    low, high = frames[:, :2, 3].min(axis=0) - _ASIDE_M, frames[:, :2, 3].max(axis=0) + _ASIDE_M
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    builder.polygon([[(x, y, -_LAND_M) for x, y in corners]], feature, materials[1])
    return builder.build()


def _beside(frame: Floats, aside_m: float) -> Floats:
    return np.asarray(frame[:, 3] + aside_m * frame[:, 1] - [0.0, 0.0, _LOWER_M])


def _at(way: Way, along_m: float, aside_m: float) -> Floats:
    """(4, 4) world_from_thing: x along the way, y away from it to the left, z up."""
    frame = np.eye(4)
    frame[:3] = way.frames(np.array([along_m]))[0]
    frame[:2, 3] += aside_m * frame[:2, 1]
    return frame


def _part(builder: MeshBuilder, name: str, looks: Mapping[str, Look]) -> Part:
    mesh = builder.mesh()
    part = PartBuilder(name)
    feature = part.feature(SemanticClass.OTHER, Provenance.MEASURED, "thing")
    materials = [
        part.material(_material(f"{name} {key}", looks[key].texture)) for key in builder.materials
    ]
    for face, (first, last) in enumerate(pairwise(mesh.start.tolist())):
        ring, uv = mesh.positions[first:last], mesh.uv[first:last]
        part.polygon([ring], feature, materials[int(mesh.material[face])], _known(uv))
    return part.build()


def _known(uv: Floats) -> UvMap:
    return lambda points: uv


def _material(name: str, texture: NDArray[np.uint8]) -> Material:
    known = np.zeros(texture.shape[:2], np.bool_)
    return Material(name, roughness=0.9, texture=Texture(texture, known))
