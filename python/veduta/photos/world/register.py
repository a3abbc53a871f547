"""Laying a component into a city model by its walls (section 2.6.2 of the thesis).

Hypotheses from pairs of walls, weighed by all walls, the best refined in space and held against
what may not be; then it is decided whether the best is believed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.facades import facades_of
from veduta.photos.city.model import CityModel
from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall
from veduta.photos.world.believed import Standing, believed
from veduta.photos.world.columns import Placements, WallColumns, wall_columns
from veduta.photos.world.corners import wall_corners
from veduta.photos.world.evidence import FacadeIndex, Matches, match_walls
from veduta.photos.world.eye_height import eye_height_nats
from veduta.photos.world.free_space import SightLines, Violations, sight_lines, violations
from veduta.photos.world.gauss_newton import UP_SD_RAD
from veduta.photos.world.georeference import Fit, Georeference, Residual
from veduta.photos.world.prior import PlacementPrior, log_cells
from veduta.photos.world.refine import PLANE, Refined, refine
from veduta.photos.world.refine_points import refine_by_points
from veduta.photos.world.search import hypotheses

REFINED = 30
"""Placements that are refined and held against free space."""
LOOKED_AT, ALIKE = 2000, 4
"""They are chosen among so many, no more than so many that are nearly one."""
APART_M, APART_RAD, APART_SCALE = 2.0, np.deg2rad(3.0), 0.05
"""Placements that differ by less are one."""
BLOCKED_WALL = 0.4
"""Share of a wall's lines that buildings block, beyond which the wall cannot be there."""
NO_WALL_NATS = -4.0
"""Evidence of a wall that cannot be seen where it is laid."""
INSIDE_NATS, MOST_INSIDE_NATS = -3.0, -30.0
"""Of each camera inside of a building, and of all together: they err together."""
FEWEST_WALLS = 3
_RAN_AWAY = (
    "what single points say leads away from the walls' placement: it is that of the walls alone,"
    " less exact"
)


@dataclass(frozen=True)
class _Found:
    """A refined placement and all that speaks for and against it."""

    refined: Refined
    matches: Matches
    against: Violations
    score: float


def register(
    structure: Structure,
    walls: Sequence[Wall],
    model: CityModel,
    prior: PlacementPrior | None,
    seed: int,
    up_sd_rad: float = UP_SD_RAD,
) -> Georeference:
    """Where the walls of an upright structure stand in the model, and whether that is believed.

    up_sd_rad: how well it is known that the structure's z is up.
    """
    facades = facades_of(model)
    if len(walls) < FEWEST_WALLS:
        return _refused(
            model, f"only {len(walls)} walls were found, of {FEWEST_WALLS} that it takes"
        )
    if len(facades) == 0:
        return _refused(model, "the model has no walls")
    columns = wall_columns(walls)
    index = FacadeIndex(facades)
    centres = structure.centres()
    middle = centres.mean(axis=0)
    flat = complex(middle[0], middle[1])
    placements = hypotheses(columns, facades)
    if prior is not None:
        placements = placements.taken(prior.allows(placements, flat))
    if len(placements) == 0:
        near = "" if prior is None else f" within {prior.reach_m:.0f} m of where GPS says"
        return _refused(model, f"no two walls have the shapes of two facades of the model{near}")
    score = match_walls(columns, index, placements).score
    best = _spread(placements, score, flat)
    corners = wall_corners(walls, structure.points)
    lines = sight_lines(structure, seed)
    wall_of = _wall_of_lines(walls, lines, len(structure.points))
    found: list[_Found] = []
    for row in best:
        placement = placements.taken(np.array([row]))
        refined = refine(columns, corners, index, placement, middle, up_sd_rad)
        if prior is None or prior.allows(refined.level, flat)[0]:
            found.append(_weighed(refined, columns, index, lines, wall_of))
    if not found:
        return _refused(model, "no placement stays near where GPS says")
    found.sort(key=lambda one: -one.score)
    closer = refine_by_points(
        found[0].refined, columns, corners, index, structure.points, middle, up_sd_rad
    )
    first = _weighed(closer, columns, index, lines, wall_of)
    ran_away = _differ(first, found[0], middle)
    if ran_away:
        first = found[0]
    second = next((one for one in found[1:] if _differ(first, one, middle)), None)
    standing = Standing(
        evidence=first.score,
        second=None if second is None else second.score,
        chance=log_cells(facades, prior),
        walls=int((first.matches.evidence[0] > 0.0).sum()),
        explained=_explained(columns, first.matches),
        blocked=first.against.blocked_share,
        inside=first.against.inside_share,
        covariance=first.refined.covariance,
    )
    accepted, why = believed(standing)
    return Georeference(
        method="model",
        accepted=accepted,
        why=why,
        crs=model.crs,
        origin_m=model.origin_m,
        best=_fit(first, walls, index),
        second=None if second is None else _fit(second, walls, index),
        notes=(_RAN_AWAY,) if ran_away else (),
    )


def _spread(placements: Placements, score: NDArray[np.float64], middle: complex) -> list[int]:
    """Rows of the best placements, of those that are nearly one no more than `ALIKE`: else the
    second best could be crowded out.
    """
    chosen: list[int] = []
    there = placements.turn * middle + placements.shift
    for row in np.argsort(-score, kind="stable")[:LOOKED_AT].tolist():
        near = np.abs(there[chosen] - there[row]) < APART_M
        near &= np.abs(np.angle(placements.turn[chosen] / placements.turn[row])) < APART_RAD
        if near.sum() < ALIKE:
            chosen.append(row)
        if len(chosen) == REFINED:
            break
    return chosen


def _refused(model: CityModel, why: str) -> Georeference:
    return Georeference("model", False, why, model.crs, model.origin_m, None)


def _wall_of_lines(walls: Sequence[Wall], lines: SightLines, points: int) -> NDArray[np.int64]:
    """(n,) the wall that each line ends on; -1 where it ends on none."""
    wall_of = np.full(points, -1, dtype=np.int64)
    for number, wall in enumerate(walls):
        wall_of[wall.point_rows] = number
    found: NDArray[np.int64] = wall_of[lines.point_of]
    return found


def _weighed(
    refined: Refined,
    walls: WallColumns,
    index: FacadeIndex,
    lines: SightLines,
    wall_of: NDArray[np.int64],
) -> _Found:
    """The evidence of all walls that can be seen where they are laid, and of the cameras."""
    matches = match_walls(walls, index, refined.level)
    against = violations(lines, index.facades, refined.world_from_model)
    own = wall_of >= 0
    count = np.bincount(wall_of[own], minlength=len(walls))
    blocked = np.bincount(wall_of[own], weights=against.blocked[own], minlength=len(walls))
    hidden = blocked > BLOCKED_WALL * np.maximum(count, 1)
    evidence = np.where(hidden, NO_WALL_NATS, matches.evidence[0])
    inside = max(MOST_INSIDE_NATS, INSIDE_NATS * float(against.inside.sum()))
    eyes = eye_height_nats(refined.world_from_model.moved(lines.centres), index.feet)
    return _Found(refined, matches, against, float(evidence.sum()) + inside + eyes)


def _differ(one: _Found, other: _Found, middle: NDArray[np.float64]) -> bool:
    first, second = one.refined.world_from_model, other.refined.world_from_model
    apart = float(np.linalg.norm(first.moved(middle[None]) - second.moved(middle[None])))
    ratio = other.refined.level.turn[0] / one.refined.level.turn[0]
    turned, grown = abs(np.angle(ratio)), abs(np.log(abs(ratio)))
    return bool(apart > APART_M or turned > APART_RAD or grown > APART_SCALE)


def _explained(walls: WallColumns, matches: Matches) -> float:
    """Share of the walls' widths that facades explain."""
    on = matches.evidence[0] > 0.0
    return float(walls.width[on].sum() / walls.width.sum())


def _fit(found: _Found, walls: Sequence[Wall], index: FacadeIndex) -> Fit:
    refined = found.refined
    plane = refined.kind == PLANE
    counted = plane & (refined.weight > 0.0)
    rms = float(np.sqrt(np.mean(refined.left_m[counted] ** 2))) if counted.any() else float("nan")
    sd = np.sqrt(np.diag(refined.covariance))
    return Fit(
        world_from_model=refined.world_from_model,
        scale_sd=float(sd[0]),
        rotation_sd_rad=sd[1:4],
        shift_sd_m=sd[4:],
        rms_m=rms,
        score=found.score,
        residuals=residuals_of(refined, found.matches, walls, index.facades.names),
    )


def residuals_of(
    refined: Refined, matches: Matches, walls: Sequence[Wall], facades: Sequence[str]
) -> tuple[Residual, ...]:
    """What is left between each wall and the plane of its facade.

    A wall that the last step has moved out of its facade's reach is named alone.
    """
    residuals = []
    plane = refined.kind == PLANE
    for row in np.unique(refined.wall[plane]).tolist():
        own = plane & (refined.wall == row)
        at = [int(facade) for facade in matches.facade[0, row, [1, 0, 2]] if facade >= 0]
        name = f"{walls[row].id} at {facades[at[0]]}" if at else f"{walls[row].id} at no facade"
        distance = float(np.sqrt(np.mean(refined.left_m[own] ** 2)))
        residuals.append(Residual(name, distance))
    return tuple(residuals)
