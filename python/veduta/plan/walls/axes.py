"""Axes of walls: pieces in one line joined over their openings, as long as the wall goes on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Origin
from veduta.plan.openings.classify import Judged
from veduta.plan.walls.join import SAME_THICKNESS, merged
from veduta.plan.walls.pieces import Piece

SAME = 0.5
"""Openings are the same one if so much of the smaller lies in the other."""


@dataclass(frozen=True)
class OnAxis:
    """An opening on an axis, from `first` to `last` pixels from its start.

    `along`: whether the gap runs in the axis's direction.
    """

    judged: Judged
    first: float
    last: float
    along: bool


@dataclass(frozen=True)
class Axis:
    """A wall's whole centre line with its openings, before it is parted at junctions.

    `closing`: it was put where a wall is broken. Its origin is `inferred` where nothing is drawn
    there that shows it. `outline`: a single thin line is all that is drawn of it.
    """

    line: Piece
    openings: tuple[OnAxis, ...]
    origin: Origin = "measured"
    closing: bool = False
    outline: bool = False


def axes_of(pieces: Sequence[Piece], judged: Sequence[Judged]) -> list[Axis]:
    """Pieces joined over their openings; one that ends at a crossing wall prolongs its own.

    Gaps tell their pieces by the index in `pieces`.
    """
    parent = list(range(len(pieces)))
    for one in judged:
        if not one.gap.to_side and _alike(pieces[one.gap.piece], pieces[one.gap.target]):
            parent[_root(parent, one.gap.piece)] = _root(parent, one.gap.target)
    groups: dict[int, list[int]] = {}
    for index in range(len(pieces)):
        groups.setdefault(_root(parent, index), []).append(index)
    axes = []
    for members in groups.values():
        inside = set(members)
        lines = sorted((pieces[index] for index in members), key=lambda one: -one.length_px)
        line = reduce(_on_circle if lines[0].bulge else merged, lines)
        mine = [one for one in judged if one.gap.piece in inside]
        for one in mine:
            line = _prolonged(line, one.gap.start, one.gap.far)
        axes.append(Axis(line, _distinct([_placed(line, one) for one in mine])))
    return axes


def _root(parent: list[int], index: int) -> int:
    while parent[index] != index:
        parent[index] = parent[parent[index]]
        index = parent[index]
    return index


def _alike(first: Piece, second: Piece) -> bool:
    thick = max(first.thickness_px, second.thickness_px)
    return thick <= SAME_THICKNESS * min(first.thickness_px, second.thickness_px) + 2


def _prolonged(line: Piece, *points: NDArray[np.float64]) -> Piece:
    along = line.arc.place(np.stack(points))[0]
    low, high = min(0.0, float(along.min())), max(line.length_px, float(along.max()))
    return line.part(low, high)


def _on_circle(first: Piece, second: Piece) -> Piece:
    """One piece over both, on the circle of the first."""
    return _prolonged(first, second.start, second.end)


def _distinct(placed: Sequence[OnAxis]) -> tuple[OnAxis, ...]:
    """The openings without those that lie in a surer one: of a bay's side each end leads to it."""
    kept: list[OnAxis] = []
    for one in sorted(placed, key=lambda one: (-one.judged.score, one.first - one.last)):
        common = (min(one.last, two.last) - max(one.first, two.first) for two in kept)
        sizes = (min(one.last - one.first, two.last - two.first) for two in kept)
        if not any(part > SAME * size for part, size in zip(common, sizes, strict=True)):
            kept.append(one)
    return tuple(one for one in placed if one in kept)


def _placed(line: Piece, judged: Judged) -> OnAxis:
    first, last = line.arc.place(np.stack([judged.gap.start, judged.gap.end]))[0].tolist()
    return OnAxis(judged, min(first, last), max(first, last), along=first <= last)
