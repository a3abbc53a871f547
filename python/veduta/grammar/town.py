"""The tiles of a block of lots: what is seen from near, from along the street and from afar."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from veduta import _core
from veduta.formats.boxes_glb import PlainBox, boxes_glb
from veduta.formats.cityjson_text import CLASSES
from veduta.formats.tile_glb import BuildingRow, tile_glb
from veduta.formats.tiles import Box, Tile, union, write_tileset
from veduta.grammar.edge_values import EdgeList
from veduta.grammar.levels import (
    BOXES_ERROR_M,
    ERROR_M,
    FULL,
    PLAIN,
    PRISM,
    PRISM_NAME,
    VOLUME,
    prism_attributes,
)
from veduta.grammar.lot import Lot
from veduta.grammar.outline import Attribute
from veduta.grammar.tile_pictures import TilePicture
from veduta.place.semantics import Provenance
from veduta.run.atomic import write_bytes

PROVENANCES = [provenance.value for provenance in Provenance]
MAPPED = (FULL, PLAIN)
"""Levels that show pictures; the others have their mean colours."""
TO_OUT = "../../.."
"""From the folder of a block's tiles."""
Vector = tuple[float, float, float]
TILESET, BOXES = "tileset.json", "boxes.glb"
"""The tree of a block, and what stands for the block where it is seen from afar."""


@dataclass(frozen=True)
class Built:
    """A lot with a building: where its anchor is in the block, and what came of it (m, z up).

    low, high: the building's box about the anchor.
    """

    lot: Lot
    place_m: Vector
    low: Vector
    high: Vector
    polygons: int
    walls: Vector | None
    roofs: Vector | None


@dataclass
class Town:
    """What is known of a block's tiles while they are written.

    pictures: those that rules may name. shown: the names of those that a tile has. dropped: how
    many surfaces of each rule are too thin to show.
    """

    folder: Path
    pictures: Sequence[TilePicture] = ()
    built: list[Built] = field(default_factory=list)
    tiles: list[Tile] = field(default_factory=list)
    leaves: list[tuple[str, int, Box]] = field(default_factory=list)
    classes: Counter[str] = field(default_factory=Counter)
    polygons: int = 0
    triangles: int = 0
    dropped: Counter[str] = field(default_factory=Counter)
    shown: set[str] = field(default_factory=set)

    def leaf(
        self, name: str, built: Sequence[Built], full: Derived, plain: Derived | None
    ) -> Tile | None:
        """Write the near levels of some lots; None where nothing is to be seen."""
        near = self._content(f"{name}-full.glb", built, full, FULL)
        if near is None:
            return None
        self.leaves.append((near.content or "", len(built), near.box))
        if plain is None:
            return near
        return self._above(f"{name}-plain.glb", built, plain, PLAIN, [near]) or near

    def node(
        self, name: str, built: Sequence[Built], volume: Derived, leaves: Sequence[Tile]
    ) -> None:
        """Write the volumes of some lots, above their near levels."""
        tile = self._above(f"{name}-volume.glb", built, volume, VOLUME, leaves)
        self.tiles += [tile] if tile else leaves

    def finish(self) -> Tile | None:
        """Write the boxes and the block's own tileset; the tile that stands for the block."""
        if not self.tiles:
            return None
        rows = [BuildingRow(one.lot.id, one.lot.name) for one in self.built]
        boxes = [_plain_box(one) for one in self.built]
        write_bytes(self.folder / BOXES, boxes_glb(boxes, rows, _mean_colour(self.built)))
        box = union([*(tile.box for tile in self.tiles), _box_of(boxes)])
        root = Tile(box, BOXES_ERROR_M, None, tuple(self.tiles))
        write_tileset(root, self.folder / TILESET)
        return root

    def _above(
        self,
        name: str,
        built: Sequence[Built],
        derived: Derived,
        level: float,
        children: Sequence[Tile],
    ) -> Tile | None:
        tile = self._content(name, built, derived, level)
        if tile is None:
            return None
        box = union([tile.box, *(child.box for child in children)])
        return Tile(box, tile.error_m, tile.content, tuple(children))

    def _content(
        self, name: str, built: Sequence[Built], derived: Derived, level: float
    ) -> Tile | None:
        """The content of a level, from the lots that have something at this level."""
        lots, rows = derived
        chosen = [
            (row, one) for row, one in zip(rows, built, strict=True) if lots.extent(row) is not None
        ]
        if not chosen:
            return None
        buffers = lots.tile(
            [row for row, _ in chosen],
            [one.place_m for _, one in chosen],
            CLASSES,
            PROVENANCES,
            [picture.named for picture in self.pictures],
            mapped=level in MAPPED,
            whole=level != FULL,
        )
        if buffers.bounds is None:
            return None
        names = [BuildingRow(one.lot.id, one.lot.name) for _, one in chosen]
        uris = [f"{TO_OUT}/{picture.file}" for picture in self.pictures]
        cut = {number for number, picture in enumerate(self.pictures) if picture.cut}
        write_bytes(self.folder / name, tile_glb(buffers, names, uris, cut))
        numbers = {picture for *_, picture in buffers.materials if picture is not None}
        self.shown |= {self.pictures[number].name for number in numbers}
        if level == FULL:
            self.triangles += buffers.triangles
            self.dropped.update(buffers.dropped)
            for counts in buffers.counts:
                told = zip(CLASSES, counts, strict=True)
                self.classes.update({name: count for name, count in told if count})
        return Tile(buffers.bounds, ERROR_M[level], name)


Derived = tuple[_core.DerivedLots, list[int]]
"""Derived lots, and which of them are meant."""


def built_of(
    derived: _core.DerivedLots,
    row: int,
    lot: Lot,
    origin_m: Vector,
    pictures: Sequence[TilePicture] = (),
) -> Built | None:
    """What a lot's derivation is, seen from the block's origin; None where nothing is left."""
    extent = derived.extent(row)
    if extent is None:
        return None
    low, high, polygons = extent
    place = (
        lot.anchor_m[0] - origin_m[0],
        lot.anchor_m[1] - origin_m[1],
        lot.anchor_m[2] - origin_m[2],
    )
    named = [picture.named for picture in pictures]
    walls, roofs = derived.colour(row, "wall", named), derived.colour(row, "roof", named)
    return Built(lot, place, low, high, polygons, walls, roofs)


@functools.cache
def _prism_rules() -> _core.GrammarRules:
    return _core.GrammarRules([(PRISM_NAME, PRISM)])


def prisms(built: Sequence[Built], rings: Sequence[list[list[Vector]]]) -> _core.DerivedLots:
    """The lots as prisms of the height of their buildings."""
    given: list[dict[str, Attribute | EdgeList]] = [
        {**prism_attributes(one.high[2], one.walls, one.roofs)} for one in built
    ]
    edits: list[list[Any]] = [[] for _ in built]
    return _core.derive_lots(
        _prism_rules(), list(rings), [0] * len(built), attributes=given, edits=edits
    )


def _plain_box(one: Built) -> PlainBox:
    """The smallest rectangle around the lot, as high as the building."""
    outline = one.lot.rings_m[0]
    middle = outline.mean(axis=0)
    (x, y), (width, depth), angle = cv2.minAreaRect((outline - middle).astype(np.float32))
    base = (
        float(middle[0] + x) + one.place_m[0],
        float(middle[1] + y) + one.place_m[1],
        one.place_m[2],
    )
    half = (max(width / 2, 0.1), max(depth / 2, 0.1))
    return PlainBox(base, half, max(one.high[2], 0.1), float(np.radians(angle)))


def _box_of(boxes: Sequence[PlainBox]) -> Box:
    base = np.array([box.base_m for box in boxes])
    reach = np.array([np.hypot(*box.half_m) for box in boxes])
    low, high = base.copy(), base.copy()
    low[:, :2] -= reach[:, None]
    high[:, :2] += reach[:, None]
    high[:, 2] += [box.height_m for box in boxes]
    return union([(tuple(low.min(axis=0).tolist()), tuple(high.max(axis=0).tolist()))])


def _mean_colour(built: Sequence[Built]) -> Vector:
    known = [one.walls for one in built if one.walls is not None]
    red, green, blue = np.mean(known, axis=0).tolist() if known else (0.82, 0.8, 0.76)
    return (red, green, blue)
