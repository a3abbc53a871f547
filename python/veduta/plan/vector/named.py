"""What layers, blocks and words beside them say of openings: a door on a layer of doors is none
that a reader of lines alone would take for a window.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from shapely import STRtree
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import DoorType
from veduta.plan.drawn import Drawn, DrawnOpening
from veduta.plan.rooms.close import wall_body
from veduta.plan.vector.entities import Entities, Stroke
from veduta.plan.vector.sheet import VectorSheet

_DOOR = re.compile(r"\bS\.?G\.?D\b|\bO\.?H\.? ?DOOR|\b(GARAGE|SLIDING|OVERHEAD) DOOR", re.I)
"""Sliding glass doors and overhead doors, as they are marked on American plans."""
_GARAGE = re.compile(r"O\.?H\.? ?DOOR|OVERHEAD|GARAGE", re.I)
_SHARE = 0.25
"""Lines in an opening count that are so long, as a part of its width."""
_SURE = 0.9


def named_openings(drawn: Drawn, found: Entities, sheet: VectorSheet) -> tuple[DrawnOpening, ...]:
    """The openings of `drawn`, with the kind that the layers of the lines in them tell."""
    strokes = [one for one in found.strokes if one.role in ("door", "window")]
    matrix = sheet.px_from_units
    lines = [LineString(one.points @ matrix[:2, :2].T + matrix[:2, 2]) for one in strokes]
    tree = STRtree(lines)
    named = []
    told = _told(drawn)
    for one, hole in _holes(drawn):
        lengths = {"door": 0.0, "window": 0.0}
        for index in tree.query(hole, predicate="intersects"):
            lengths[strokes[index].role] += lines[index].intersection(hole).length
        one = _renamed(one, lengths, _leaf(one, strokes, tree, hole))
        named.append(_by_word(one, told.get(one.id, "")))
    return tuple(named)


def _told(drawn: Drawn) -> dict[str, str]:
    """By openings, the words for doors that are nearest to them, within half of their width."""
    holes = list(_holes(drawn))
    told: dict[str, str] = {}
    for text in drawn.texts:
        if not holes or not _DOOR.search(text.text):
            continue
        box = Polygon(text.box_px)
        one, hole = min(holes, key=lambda pair: float(pair[1].distance(box)))
        if hole.distance(box) <= one.width_px / 2:
            told[one.id] = text.text
    return told


def _by_word(one: DrawnOpening, word: str) -> DrawnOpening:
    if not word or (one.kind == "door" and one.type != "unknown"):
        return one
    kind: DoorType = "garage" if _GARAGE.search(word) else "sliding"
    return replace(one, kind="door", type=kind, score=_SURE)


def _renamed(one: DrawnOpening, lengths: dict[str, float], leaf: bool) -> DrawnOpening:
    kind = max(lengths, key=lambda name: lengths[name])
    if lengths[kind] < _SHARE * one.width_px or kind == one.kind:
        return one
    if kind == "window":
        if leaf:  # the leaf of a door beside a pane
            return one
        return replace(one, kind="window", type="unknown", hinge="none", swing="none", score=_SURE)
    return replace(one, kind="door", type="unknown", score=_SURE)


def _leaf(one: DrawnOpening, strokes: list[Stroke], tree: STRtree, hole: BaseGeometry) -> bool:
    near = tree.query(hole.buffer(0.1 * one.width_px), predicate="intersects")
    return any(strokes[index].role == "door" and strokes[index].arc for index in near)


def _holes(drawn: Drawn) -> Iterator[tuple[DrawnOpening, Polygon]]:
    walls = {wall.id: wall for wall in drawn.walls}
    for one in drawn.openings:
        wall = walls[one.wall]
        start, end = drawn.wall_ends(wall)
        way = (end - start) / max(float(np.hypot(*(end - start))), 1e-9)
        low, high = start + one.along_px * way, start + (one.along_px + one.width_px) * way
        yield one, wall_body(low, high, wall.thickness_px, (0.0, 0.0))
