"""The walls that the points of a structure speak for (section 2.6.1 of the thesis).

Lines are found one after the other in the view from above; each is grown, parted where it steps
or bends, fitted, and split into spans. All lengths follow from the structure: its scale is not
known.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.options import WallOptions
from veduta.photos.structure import Structure
from veduta.photos.walls.ends import dense_range, with_closed_corners, without_overshoot
from veduta.photos.walls.lines import Line, best_line, fitted
from veduta.photos.walls.plan_view import TURNED, PlanView, plan_view
from veduta.photos.walls.point_quality import NEIGHBOURS, point_quality, typical_reach
from veduta.photos.walls.sight import (
    SURE_PLACES,
    Sights,
    places_of,
    share_hidden,
    share_seen_through,
    sights_of,
)
from veduta.photos.walls.spans import Bounds, filled_height, spans
from veduta.photos.walls.steps import parting
from veduta.photos.walls.wall import Wall

SMALLEST = 0.1
"""Least width and height of a wall, as a part of the typical distance of points from photos."""
NARROWEST_GAP = 0.05
"""Gaps under this part of that distance never part a wall: a blank strip shows no points."""
ALLEY = 0.02
"""Gap at the end of a wall, as a part of that distance, beyond which a short clump of points is
another's."""
BARREN = 25
"""Lines in a row without a wall after which no more are looked for."""
RELIEF = 0.04
"""A wall that lies before or behind a larger one by less than this part of that distance is its
relief: window panes, pilasters, a ledge."""
AT_CORNER = 0.5
"""Least cosine between a wall and a neighbourhood at its corner: 60 degrees."""
ALIGNED = np.deg2rad(5.0)
"""Largest angle between two walls that may be one."""
EXPLAINED = 0.9
"""Share of the points of two walls that must lie on the line of both for them to be one."""
FOLLOWED = 12
"""Times that a line is fitted anew to the points on it, and so gets longer, at most."""
CORNER = 0.03
"""How far an end may be moved to meet another wall's, as a part of that distance."""
COVERED = 0.5
"""Share of a wall's rectangle that the larger one has to cover for that."""
FACES = 0.906
"""Least cosine, in the middle of a wall's points, between their neighbourhoods and it: 25 degrees.
A line askew through many things has points on each, that face elsewhere."""
SEEN_THROUGH = 0.3
"""Share of the lines of sight that may pass a wall and end behind it."""
HIDDEN, SURE = 0.5, 0.5
"""Share of the lines of sight to a wall's points that may go through walls with more points, unless
so many of its points are seen from enough places."""
FILLED = 0.3
"""Least share of a wall's height that its points fill in the middle one of stretches along it."""


@dataclass(frozen=True)
class _Candidate:
    """A span of a line with its points (rows of the view)."""

    line: Line
    members: NDArray[np.int64]


def relief_depth(structure: Structure) -> float:
    """How far before or behind a wall something may lie and still belong to it."""
    return RELIEF * typical_reach(structure)


def find_walls(structure: Structure, options: WallOptions, seed: int) -> tuple[Wall, ...]:
    """The walls of a structure with z up, that with most points first; the same for the same seed.

    Too few points, or none that line up, give no walls: that is no error.
    """
    if len(structure.points) < max(NEIGHBOURS, options.wall_points):
        return ()
    view = plan_view(structure.points, point_quality(structure))
    rng = np.random.default_rng(seed)
    bounds = Bounds(
        options.wall_points,
        SMALLEST * view.reach,
        SMALLEST * view.reach,
        NARROWEST_GAP * view.reach,
    )
    places = places_of(structure, typical_reach(structure))
    candidates = _candidates(view, bounds, sights_of(structure, places, rng), rng)
    candidates = _completed(view, _merged(view, candidates, bounds), bounds)
    walls = [_wall(view, candidate) for candidate in candidates]
    walls.sort(key=lambda wall: -len(wall.point_rows))
    walls = _without_relief(walls, RELIEF * view.reach)
    walls = _without_hidden(walls, structure, places, RELIEF * view.reach)
    walls = with_closed_corners(walls, CORNER * view.reach)
    return _numbered(without_overshoot(walls, CORNER * view.reach))


def _candidates(
    view: PlanView, bounds: Bounds, sights: Sights, rng: np.random.Generator
) -> list[_Candidate]:
    """Walls one after the other, each from the points that the earlier ones left."""
    free = np.ones(len(view), dtype=bool)
    found: list[_Candidate] = []
    barren = 0
    while barren < BARREN:
        left = np.flatnonzero(free)
        if len(left) < bounds.points:
            break
        line = best_line(view.only(left), rng)
        if line is None:
            break
        grown = _grown(view, left, line, bounds, sights)
        if not grown:
            barren += 1
            free[_near_seed(view, left, line)] = False
            continue
        barren = 0
        for candidate in grown:
            free[candidate.members] = False
            free[_relief_of(view, candidate)] = False
        found += grown
    return found


def _merged(view: PlanView, candidates: list[_Candidate], bounds: Bounds) -> list[_Candidate]:
    """The candidates, those joined that one line explains as well as two, and no gap parts."""
    waiting = sorted(candidates, key=lambda item: -len(item.members))
    found: list[_Candidate] = []
    while waiting:
        one = waiting.pop(0)
        for two in waiting:
            joined = _joined(view, one, two, bounds)
            if joined is not None:
                waiting = [joined, *(item for item in waiting if item is not two)]
                break
        else:
            found.append(one)
    return found


def _completed(view: PlanView, candidates: list[_Candidate], bounds: Bounds) -> list[_Candidate]:
    """The candidates with the points on them that none has.

    Where a line was parted a little beside the place, and at corners, where neighbourhoods face
    both ways, points of a wall were left over.
    """
    free = np.ones(len(view), dtype=bool)
    for candidate in candidates:
        free[candidate.members] = False
    found = []
    for candidate in sorted(candidates, key=lambda item: -len(item.members)):
        line = candidate.line
        rows = free & view.on_line(line.normal, line.offset, turned=AT_CORNER)
        rows[candidate.members] = True
        members = np.flatnonzero(rows)
        own = view.only(members)
        runs = spans(own.xy @ line.along, own.z, bounds)
        had = np.isin(members, candidate.members)
        best = max(runs, key=lambda run: int(had[run].sum()), default=np.flatnonzero(had))
        free[members[best]] = False
        found.append(_Candidate(fitted(own.only(best), line), members[best]))
    return found


def _joined(view: PlanView, one: _Candidate, two: _Candidate, bounds: Bounds) -> _Candidate | None:
    """Both as one wall; None where something parts them."""
    if float(one.line.normal @ two.line.normal) < np.cos(ALIGNED):
        return None
    off = view.xy[two.members].mean(axis=0) @ one.line.normal - one.line.offset
    if abs(float(off)) > RELIEF * view.reach:
        return None
    members = np.sort(np.concatenate([one.members, two.members]))
    own = view.only(members)
    line = fitted(own, one.line)
    if float(own.on_line(line.normal, line.offset).mean()) < EXPLAINED:
        return None
    whole = len(spans(own.xy @ line.along, own.z, bounds)) == 1
    return _Candidate(line, members) if whole and _cut(own, line, bounds) is None else None


def _cut(own: PlanView, line: Line, bounds: Bounds) -> float | None:
    """Where along a line two should take its part."""
    off = own.xy @ line.normal - line.offset
    return parting(own.xy @ line.along, off, own.sigma(line.normal), bounds.points, bounds.width)


def _near_seed(view: PlanView, left: NDArray[np.int64], line: Line) -> NDArray[np.int64]:
    """The points of a line that came to nothing, so that others get their turn."""
    own = view.only(left)
    near = np.linalg.norm(own.xy - line.seed, axis=1) <= view.reach
    found: NDArray[np.int64] = left[own.on_line(line.normal, line.offset) & near]
    return found


def _grown(
    view: PlanView, left: NDArray[np.int64], line: Line, bounds: Bounds, sights: Sights
) -> list[_Candidate]:
    """The walls on a line: its points gathered anew and fitted, parted, and split into spans."""
    own = view.only(left)
    found: list[_Candidate] = []
    waiting = [(line, np.ones(len(own), dtype=bool), 0)]
    while waiting:
        line, allowed, depth = waiting.pop()
        line, members = _followed(own, line, allowed)
        if len(members) < bounds.points:
            continue
        part = own.only(members)
        along = part.xy @ line.along
        cut = _cut(part, line, bounds)
        if cut is not None and depth < 6:
            side = own.xy @ line.along < cut
            waiting += [
                (fitted(own.only(members[along < cut]), line), allowed & side, depth + 1),
                (fitted(own.only(members[along >= cut]), line), allowed & ~side, depth + 1),
            ]
            continue
        for rows in spans(along, part.z, bounds):
            candidate = _Candidate(fitted(part.only(rows), line), left[members[rows]])
            if _is_wall(view, candidate, sights):
                found.append(candidate)
    return found


def _followed(
    own: PlanView, line: Line, allowed: NDArray[np.bool_]
) -> tuple[Line, NDArray[np.int64]]:
    """A line fitted to the points on it around its seed, and on along it as long as there are more.

    The line and the rows of its points.
    """
    members = np.zeros(0, dtype=np.int64)
    for _ in range(FOLLOWED):
        along = own.xy @ line.along
        if len(members):
            low, high = along[members].min(), along[members].max()
        else:
            low = high = float(line.seed @ line.along)
        near = (along >= low - 0.5 * own.reach) & (along <= high + 0.5 * own.reach)
        now = np.flatnonzero(allowed & near & own.on_line(line.normal, line.offset))
        if len(now) < 3 or np.array_equal(now, members):
            break
        members, line = now, fitted(own.only(now), line)
    return line, members


def _inside(view: PlanView, rows: NDArray[np.int64], wall: _Candidate) -> NDArray[np.int64]:
    """Those of the rows that lie before or behind a wall's rectangle, however far."""
    members, own = view.only(wall.members), view.only(rows)
    span, along = members.xy @ wall.line.along, own.xy @ wall.line.along
    across = (along >= span.min()) & (along <= span.max())
    found: NDArray[np.int64] = rows[
        across & (own.z >= members.z.min()) & (own.z <= members.z.max())
    ]
    return found


def _relief_of(view: PlanView, wall: _Candidate) -> NDArray[np.int64]:
    """The points that lie a little before or behind a wall, and face as it does."""
    rows = _inside(view, np.arange(len(view)), wall)
    own = view.only(rows)
    near = np.abs(own.xy @ wall.line.normal - wall.line.offset) <= RELIEF * view.reach
    found: NDArray[np.int64] = rows[near & (own.facing @ wall.line.normal >= TURNED)]
    return found


def _is_wall(view: PlanView, candidate: _Candidate, sights: Sights) -> bool:
    """Whether its points face as it does and fill it, and the photos do not see through it."""
    own = view.only(candidate.members)
    if float(np.median(own.facing @ candidate.line.normal)) < FACES:
        return False
    if filled_height(own.xy @ candidate.line.along, own.z) < FILLED:
        return False
    wall = _wall(view, candidate)
    return share_seen_through(wall, sights, RELIEF * view.reach) <= SEEN_THROUGH


def _wall(view: PlanView, candidate: _Candidate) -> Wall:
    """The rectangle around the points of a candidate."""
    line, own = candidate.line, view.only(candidate.members)
    along = own.xy @ line.along
    foot = line.offset * line.normal
    off = own.xy @ line.normal - line.offset
    left, right = dense_range(along, ALLEY * view.reach)
    bottom, top = dense_range(own.z)
    return Wall(
        id="",
        start=foot + left * line.along,
        end=foot + right * line.along,
        bottom=bottom,
        top=top,
        point_rows=np.sort(own.rows),
        rms=float(np.sqrt(np.mean(off**2))),
    )


def _without_relief(walls: list[Wall], deepest: float) -> list[Wall]:
    """Without walls that are the relief of a larger one: over it, and nearly in its plane."""
    kept: list[Wall] = []
    for wall in walls:
        if not any(_is_relief(wall, other, deepest) for other in kept):
            kept.append(wall)
    return kept


def _without_hidden(
    walls: list[Wall], structure: Structure, places: NDArray[np.int64], thickness: float
) -> list[Wall]:
    """Without what was taken for a wall behind a larger one, whose equal windows were taken for one
    another.
    """
    kept: list[Wall] = []
    for wall in walls:
        sure = float((places[wall.point_rows] >= SURE_PLACES).mean())
        if sure >= SURE or share_hidden(wall, kept, structure, thickness) <= HIDDEN:
            kept.append(wall)
    return kept


def _is_relief(wall: Wall, other: Wall, deepest: float) -> bool:
    ends = np.stack([wall.start, wall.end]) - other.start
    off = np.abs(ends @ other.outward)
    if float(wall.outward @ other.outward) < 0.0 or float(off.max()) > deepest:
        return False
    low, high = np.sort(ends @ other.along)
    across = max(0.0, min(high, other.width) - max(low, 0.0))
    up = max(0.0, min(wall.top, other.top) - max(wall.bottom, other.bottom))
    return bool(across * up >= COVERED * (high - low) * wall.height)


def _numbered(walls: list[Wall]) -> tuple[Wall, ...]:
    return tuple(
        Wall(
            id=f"w{number:03d}",
            start=wall.start,
            end=wall.end,
            bottom=wall.bottom,
            top=wall.top,
            point_rows=wall.point_rows,
            rms=wall.rms,
        )
        for number, wall in enumerate(walls)
    )
