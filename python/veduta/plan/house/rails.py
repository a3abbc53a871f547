"""What rails of stairs are made of."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from shapely.geometry import LineString, box
from shapely.geometry.base import BaseGeometry

from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.frame import Frame, Sculptor, Surface

RAIL_M = 0.9
RAIL_SIDE_M = 0.045
_BAR_M = 0.014
_FREE = 0.35
"""A side gets a rail if so much of it has no wall beside it."""
_FREE_ROUND = 0.1
_ROUND = 5
"""Corners of a line that bends."""
_BESIDE_M = 0.15
_SMOOTH = math.cos(math.radians(50.0))

Edge = tuple[tuple[float, float], tuple[float, float]]


def rail_surface(sculptor: Sculptor, name: str) -> Surface:
    """A rail of that name, in a shell of its own."""
    feature = sculptor.builder.feature(
        SemanticClass.OTHER, Provenance.INVENTED, name, shell=sculptor.builder.new_shell()
    )
    return Surface(feature, "leaf")


def add_bar(
    at: float,
    span_m: tuple[float, float],
    middle: float,
    frame: Frame,
    surface: Surface,
    sculptor: Sculptor,
) -> None:
    """An upright bar: where along the frame's first axis and its third, from where to where."""
    half = _BAR_M / 2
    shape = box(at - half, span_m[0], at + half, span_m[1] + 0.01)
    sculptor.prism(shape, middle - half, middle + half, frame, surface)


def smooth_runs(edges: Sequence[Edge]) -> list[list[int]]:
    """Edges that follow each other without a sharp corner, by their numbers: each gets one rail."""
    ways = [np.subtract(there, here) / math.dist(here, there) for here, there in edges]
    starts = {here: number for number, (here, _) in enumerate(edges)}
    after: dict[int, int] = {}
    for number, (_, there) in enumerate(edges):
        follower = starts.get(there)
        if follower is not None and float(ways[number] @ ways[follower]) > _SMOOTH:
            after[number] = follower
    firsts = [number for number in range(len(edges)) if number not in set(after.values())]
    runs, used = [], set[int]()
    # What is left after those that begin somewhere goes round.
    for first in [*firsts, *range(len(edges))]:
        run: list[int] = []
        here: int | None = first
        while here is not None and here not in used:
            used.add(here)
            run.append(here)
            here = after.get(here)
        if run:
            runs.append(run)
    return runs


def is_free(edge: LineString, walls: BaseGeometry) -> bool:
    """Whether so much of an edge has no wall beside it that one could fall over it.

    A round one touches walls here and there, and is open between.
    """
    share = _FREE if len(edge.coords) < _ROUND else _FREE_ROUND
    beside = edge.buffer(_BESIDE_M, cap_style="flat")
    covered = edge.intersection(walls.buffer(_BESIDE_M)).length if beside.intersects(walls) else 0.0
    return bool(edge.length - covered > share * edge.length)
