"""Curved walls that are mostly window: bows before a straight wall.

What is solid of a bow, beside its window, is too short to be followed. So an arc is looked for
from one end of a broken wall to the other, along which lines or solid wall are drawn all the way:
the arc that is nearest to ink (chamfer matching, Barrow et al. 1977), as walls and all drawings of
windows have it: on the centre line, or on both faces, with nothing beside them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations, product

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.geometry.arcs import Arc
from veduta.plan.document import WallDrawing
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.curved import lies_in
from veduta.plan.walls.find import Found
from veduta.plan.walls.graph import Edge, Graph, wall_graph
from veduta.plan.walls.join import UPRIGHT_RAD, solid_share
from veduta.plan.walls.pieces import Piece

CHORD = (9.0, 50.0)
"""Bows are so many (thin) wall thicknesses wide."""

SLIDES = np.linspace(-0.5, 2.3, 11)
"""Where a bow begins is not seen: it is so many thicknesses inward from the end or corner."""

SHARE = 0.5
"""It is at least this part of the way between both as wide."""

DEEP = 0.6
"""And comes so many thicknesses before the wall: what does not is a straight wall."""

BEFORE = 0.75
LEAST_BEFORE = 0.4
"""This part of it is so many thicknesses before the wall."""

BULGES = np.geomspace(0.13, 1.0, 24)
PLACES = 24
CHOSEN = 60
"""So many of all arcs are looked at closely."""

CAP_PX = 4.0
FARTHEST_PX = 1.9
"""The nearest arc of many is not so far from ink on the average."""

NEAR_PX = 1.6
"""Ink so near to a place is drawn there."""

COVERED = 0.9
"""An arc is drawn if this part of it is."""

STRAIGHT = 0.6
"""No arc is looked for where this part of the straight line is."""

STRAY = 0.01
"""So much of what lies before a bow may be marks as thick as walls."""

PIER = 0.12
"""Of a bow's windows only what is longer, as a part of it, parts two."""

BESIDE_FACES = np.array([1.3, 1.5, 1.7, 1.9, 2.1])
"""In half thicknesses: there is paper beside a wall."""


@dataclass(frozen=True)
class Nearness:
    """`away` (h, w): how far pixels are from ink, at most CAP_PX; `drawn`: where there is some."""

    away: NDArray[np.float32]
    drawn: NDArray[np.bool_]
    solid: NDArray[np.bool_]


@dataclass(frozen=True)
class Broken:
    """Two ends of a broken wall, (2,) each, the way from the first to the second, and how thick.

    `side`: where it is outdoors, 1 to the right of the way, -1 to the left. `drawing`: of the wall.
    """

    first: NDArray[np.float64]
    second: NDArray[np.float64]
    way: NDArray[np.float64]
    thickness_px: float
    side: float
    drawing: WallDrawing


def with_bows(found: Found, ink: Nearness, broken: Sequence[Broken]) -> Found:
    """The walls with what is solid of bows between those that are broken; themselves without."""
    bows: list[Piece] = []
    for one in broken:
        if any(spans(one, bow) for bow in bows):
            continue
        bow = _bow(one, ink)
        if bow is not None:
            bows.append(bow)
    if not bows:
        return found
    stubs = [stub for bow in bows for stub in _stubs(bow, found)]
    pieces = [one for one in found.pieces if not any(lies_in(one, bow) for bow in bows)]
    curved = [one for one in found.curved if not any(_on(one, bow) for bow in bows)]
    return replace(found, pieces=pieces, curved=[*curved, *stubs])


def nearness(found: Found, faint: NDArray[np.bool_]) -> Nearness:
    """Of the walls and of the thin lines, (h, w), of a sheet."""
    drawn = faint | found.solid
    away = cv2.distanceTransform((~drawn).astype(np.uint8), cv2.DIST_L2, 5)
    return Nearness(np.minimum(away, np.float32(CAP_PX)), drawn, found.solid)


def broken_walls(found: Found) -> Iterator[Broken]:
    """Pairs of ends and corners of walls, opposite each other with nothing solid between them.

    The narrowest come first, and only where one sees out between them.
    """
    axes = [Axis(one, ()) for one in (*found.pieces, *found.curved)]
    graph = wall_graph(axes)
    at: dict[int, list[Edge]] = {}
    for edge in graph.edges:
        if not axes[edge.axis].line.bulge:
            at.setdefault(edge.first, []).append(edge)
            at.setdefault(edge.second, []).append(edge)
    low, high = CHORD[0] * found.thin_px, CHORD[1] * found.thin_px
    pairs = [
        (size, one, other)
        for one, other in combinations(sorted(at), 2)
        if low <= (size := float(np.hypot(*(graph.nodes[other] - graph.nodes[one])))) <= high
    ]
    for size, one, other in sorted(pairs):
        first, second = graph.nodes[one], graph.nodes[other]
        way = (second - first) / size
        if not all(_squares(way, node, at[node], graph) for node in (one, other)):
            continue
        if solid_share(found.solid, first + 0.25 * size * way, second - 0.25 * size * way) >= 0.1:
            continue
        thick = min(
            max(axes[edge.axis].line.thickness_px for edge in at[node]) for node in (one, other)
        )
        drawing = axes[at[one][0].axis].line.drawing
        for side in (1.0, -1.0):
            if _sees_out(first, second, side, found.solid):
                yield Broken(first, second, way, thick, side, drawing)


def _sees_out(
    first: NDArray[np.float64], second: NDArray[np.float64], side: float, solid: NDArray[np.bool_]
) -> bool:
    """Whether no wall lies before the middle of a break; side: 1 right, -1 left."""
    line = Arc(first, second)
    away = np.arange(2.0, sum(solid.shape), 2.0)
    # Beyond the sheet's farthest corner there is nothing to look at.
    height, width = solid.shape
    corners = np.array([(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)])
    seen = away[: np.searchsorted(away, float((side * line.place(corners)[1]).max()), "right")]
    middle = line.chord_px * np.linspace(0.33, 0.67, 9)
    if bool(look(solid, line.at(middle[:, None], side * seen[None, :]), 0.0).any()):
        return False
    # A door may lie before a window; beyond the bow nothing is built over all of its breadth.
    low = 0.6 * line.chord_px
    along = np.linspace(0.0, line.chord_px, 25)
    places = line.at(along[:, None], side * seen[seen > low][None, :])
    walls = float(look(solid, places, 0.0).sum())
    return walls < STRAY * len(along) * int((away > low).sum())


def _squares(way: NDArray[np.float64], node: int, edges: Sequence[Edge], graph: Graph) -> bool:
    """Whether a wall may go on from a node in this direction: its walls are in line or square."""
    for edge in edges:
        run = graph.nodes[edge.second] - graph.nodes[edge.first]
        run = run / max(float(np.hypot(*run)), 1e-9)
        if edge.second == node:
            run = -run
        if abs(float(run[0] * way[1] - run[1] * way[0])) <= np.sin(UPRIGHT_RAD):
            return True
        if abs(float(run @ way)) <= np.sin(UPRIGHT_RAD):
            return True
    return False


def _bow(one: Broken, ink: Nearness) -> Piece | None:
    """The arc that is drawn between two ends of a wall; None where there is none."""
    straight = Arc(one.first, one.second)
    level = covered(straight, one.thickness_px, ink)
    if level > STRAIGHT:
        return None
    arc = _likeliest(one, ink)
    if arc is None:
        return None
    arc = _refined(arc, one, ink)
    if arc.chord_px < SHARE * straight.chord_px:
        return None
    # Within the straight wall anything is drawn.
    along = np.arange(0.5, arc.length_px, 1.0)
    before = np.abs(straight.place(arc.at(along))[1]) > BEFORE * one.thickness_px
    near = _away(arc, along, one.thickness_px / 2, ink) <= NEAR_PX
    if before.mean() < LEAST_BEFORE or near[before].mean() < COVERED or near.mean() < COVERED:
        return None
    # Nor does solid wall, which is broad, say how it bends: lines in a window do.
    free = look(ink.solid, arc.at(along), 0.0) < 0.5
    edges = np.flatnonzero(np.diff(np.pad(free.astype(np.int8), 1)))
    low, high = max(zip(edges[::2], edges[1::2], strict=True), key=np.ptp, default=(0, 0))
    bend = (high - low) ** 2 / 8.0 / arc.radius_px
    if bend < 3 * NEAR_PX or near[low:high].mean() < COVERED:
        return None
    return Piece(arc.start, arc.end, one.thickness_px, one.drawing, arc.bulge)


def _likeliest(one: Broken, ink: Nearness) -> Arc | None:
    """The arc of least cost among many; None where no arc is near ink for the most part.

    All arcs of the same bulge are one, made larger and moved.
    """
    unit, right = _unit_arcs()
    slides = np.array(list(product(SLIDES, -SLIDES))) * one.thickness_px
    starts = one.first + slides[:, :1] * one.way
    chords = float((one.second - one.first) @ one.way) + slides[:, 1] - slides[:, 0]
    turn = np.stack([one.way, one.side * np.array([-one.way[1], one.way[0]])])
    half = one.thickness_px / 2
    # (slides, bulges, places, rows, 2)
    centre = starts[:, None, None] + chords[:, None, None, None] * (unit @ turn)
    across = half * np.array([-1.0, 0.0, 1.0])[:, None] * (right @ turn)[:, :, None]
    found = look(ink.away, centre[:, :, :, None] + across, CAP_PX)
    cost = np.minimum(found[..., 1], np.maximum(found[..., 0], found[..., 2])).mean(axis=2)
    cost[np.abs(BULGES) * chords[:, None] / 2 < DEEP * one.thickness_px] = CAP_PX
    cost[chords < SHARE * float((one.second - one.first) @ one.way)] = CAP_PX
    order = np.argsort(cost, axis=None)[:CHOSEN]
    if float(cost.flat[order[0]]) > FARTHEST_PX:
        return None
    arcs = []
    for place in order:
        row, column = np.unravel_index(int(place), cost.shape)
        end = starts[row] + chords[row] * one.way
        arcs.append(Arc(starts[row], end, one.side * float(BULGES[column])))
    return min(arcs, key=lambda arc: _cost(arc, one.thickness_px, ink, PLACES))


@lru_cache(maxsize=1)
def _unit_arcs() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points (bulges, places, 2) of arcs from (0, 0) to (1, 0), and the ways to their right."""
    shares = (np.arange(PLACES) + 0.5) / PLACES
    arcs = [Arc(np.zeros(2), np.array([1.0, 0.0]), float(bulge)) for bulge in BULGES]
    points = np.stack([arc.at(shares * arc.length_px) for arc in arcs])
    beside = np.stack([arc.at(shares * arc.length_px, 0.1) for arc in arcs])
    return points, (beside - points) / 0.1


def _refined(arc: Arc, one: Broken, ink: Nearness) -> Arc:
    """The arc nearby with the least cost: a search by steps that are halved."""
    count = max(PLACES, int(arc.length_px / 3))
    best = _cost(arc, one.thickness_px, ink, count)
    slide, bend = 0.17 * one.thickness_px, 0.05 * abs(arc.bulge)
    while slide > 0.2:
        better = False
        for first, second, more in (
            (slide, 0.0, 0.0), (-slide, 0.0, 0.0), (0.0, slide, 0.0), (0.0, -slide, 0.0),
            (0.0, 0.0, bend), (0.0, 0.0, -bend), (slide, -slide, 0.0), (-slide, slide, 0.0),
        ):  # fmt: skip
            tried = Arc(arc.start + first * one.way, arc.end + second * one.way, arc.bulge + more)
            cost = _cost(tried, one.thickness_px, ink, count)
            if cost < best and abs(tried.bulge) <= 1.0:
                best, arc, better = cost, tried, True
        if not better:
            slide, bend = slide / 2, bend / 2
    return arc


def _cost(arc: Arc, thickness_px: float, ink: Nearness, count: int) -> float:
    """How far ink is from where a wall or a window has it, and how much there is beside it."""
    along = (np.arange(count) + 0.5) / count * arc.length_px
    half = thickness_px / 2
    away = _away(arc, along, half, ink) / CAP_PX
    beside = np.concatenate([-BESIDE_FACES, BESIDE_FACES]) * half
    # Near its ends other walls are beside it.
    free = along[np.abs(along / arc.length_px - 0.5) < 0.3]
    stray = look(ink.drawn, arc.at(free[:, None], beside[None, :]), False)
    return float(away.mean() + stray.mean())


def _away(
    arc: Arc, along: NDArray[np.float64], half_px: float, ink: Nearness
) -> NDArray[np.float64]:
    """(n,) distances from ink on the centre line, or on that face where it is farther."""
    places = arc.at(along[:, None], np.array([-half_px, 0.0, half_px])[None, :])
    found = look(ink.away, places, CAP_PX)
    return np.asarray(np.minimum(found[:, 1], np.maximum(found[:, 0], found[:, 2])), np.float64)


def covered(arc: Arc, thickness_px: float, ink: Nearness) -> float:
    """The part of an arc along which ink is where a wall or a window has it."""
    along = np.arange(0.5, max(arc.length_px, 1.0), 1.0)
    return float((_away(arc, along, thickness_px / 2, ink) <= NEAR_PX).mean())


def look(
    grid: NDArray[np.float32] | NDArray[np.bool_], points: NDArray[np.float64], outside: float
) -> NDArray[np.float32]:
    """Values (...) of a grid (h, w) at points (..., 2) in pixels; `outside` beyond its border."""
    index = np.floor(points).astype(int)
    x, y = index[..., 0], index[..., 1]
    inside = (x >= 0) & (y >= 0) & (x < grid.shape[1]) & (y < grid.shape[0])
    values = grid[np.where(inside, y, 0), np.where(inside, x, 0)]
    return np.asarray(np.where(inside, values, outside), np.float32)


def filled_along(piece: Piece, solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) at each pixel along a piece, whether it is solid (h, w) over half of its thickness."""
    steps = np.arange(0.5, piece.length_px, 1.0)
    beside = np.linspace(-0.35, 0.35, 5) * piece.thickness_px
    places = piece.arc.at(steps[:, None], beside[None, :])
    return np.asarray(look(solid, places, 0.0).mean(axis=1) >= 0.5)


def _stubs(bow: Piece, found: Found) -> list[Piece]:
    """What is solid of a bow, from its ends on: all of it, or two pieces and more between them."""
    filled = filled_along(bow, found.solid)
    # At its ends the straight wall is beside it.
    reach = int(0.5 * bow.thickness_px)
    filled[:reach] = filled[len(filled) - reach :] = True
    edges = np.flatnonzero(np.diff(np.pad(filled.astype(np.int8), 1)))
    return [
        bow.part(float(low), float(high))
        for low, high in zip(edges[::2], edges[1::2], strict=True)
        if low == 0 or high == len(filled) or high - low >= PIER * len(filled)
    ]


def spans(one: Broken, bow: Piece) -> bool:
    """Whether a bow lies before a break: that was narrower, and is mended by it."""
    along, across = Arc(one.first, one.second).place((bow.start + bow.end) / 2)
    size = float(np.hypot(*(one.second - one.first)))
    return bool(0.0 < along < size and abs(across) < one.thickness_px)


def _on(piece: Piece, bow: Piece) -> bool:
    """Whether a curved piece is a part of a bow."""
    along, across = bow.arc.place(piece.arc.at(np.linspace(0.0, piece.length_px, 5)))
    inside = along.min() >= -bow.thickness_px
    inside &= along.max() <= bow.length_px + bow.thickness_px
    return bool(inside and np.abs(across).max() <= bow.thickness_px / 2)
