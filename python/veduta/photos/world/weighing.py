"""What speaks for and against a placement of walls in a model, however it was come by."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.model import CityModel
from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall
from veduta.photos.world.columns import Placements, WallColumns, wall_columns
from veduta.photos.world.corners import wall_corners
from veduta.photos.world.cut_ends import cut_ends
from veduta.photos.world.evidence import FacadeIndex, Matches, match_walls
from veduta.photos.world.eye_height import eye_height_nats
from veduta.photos.world.free_space import SightLines, Violations, sight_lines, violations
from veduta.photos.world.georeference import Fit, Georeference, Residual
from veduta.photos.world.refine import PLANE, Refined

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


@dataclass(frozen=True)
class Scene:
    """What is laid into a model, and the model's facades.

    middle: (3,) of the photos. up_sd_rad: how well it is known that the structure's z is up.
    wall_of: the wall that each of the lines of sight ends on; -1 where it ends on none.
    """

    structure: Structure
    walls: tuple[Wall, ...]
    columns: WallColumns
    corners: NDArray[np.float64]
    index: FacadeIndex
    lines: SightLines
    wall_of: NDArray[np.int64]
    middle: NDArray[np.float64]
    up_sd_rad: float

    @property
    def flat(self) -> complex:
        """The middle from above."""
        return complex(self.middle[0], self.middle[1])


def scene_of(
    structure: Structure,
    walls: Sequence[Wall],
    index: FacadeIndex,
    seed: int,
    up_sd_rad: float,
) -> Scene:
    """All that is the same for every placement."""
    cut = cut_ends(structure, walls)
    lines = sight_lines(structure, seed)
    return Scene(
        structure,
        tuple(walls),
        wall_columns(walls, cut.edges, cut.tops),
        wall_corners(walls, structure.points),
        index,
        lines,
        _wall_of_lines(walls, lines, len(structure.points)),
        structure.centres().mean(axis=0),
        up_sd_rad,
    )


@dataclass(frozen=True)
class Found:
    """A refined placement and all that speaks for and against it."""

    refined: Refined
    matches: Matches
    against: Violations
    score: float


def spread(placements: Placements, score: NDArray[np.float64], middle: complex) -> list[int]:
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


def _wall_of_lines(walls: Sequence[Wall], lines: SightLines, points: int) -> NDArray[np.int64]:
    """(n,) the wall that each line ends on; -1 where it ends on none."""
    wall_of = np.full(points, -1, dtype=np.int64)
    for number, wall in enumerate(walls):
        wall_of[wall.point_rows] = number
    found: NDArray[np.int64] = wall_of[lines.point_of]
    return found


def weighed(refined: Refined, scene: Scene) -> Found:
    """The evidence of all walls that can be seen where they are laid, and of the cameras."""
    walls, index, lines, wall_of = scene.columns, scene.index, scene.lines, scene.wall_of
    matches = match_walls(walls, index, refined.level)
    against = violations(lines, index.facades, refined.world_from_model)
    own = wall_of >= 0
    count = np.bincount(wall_of[own], minlength=len(walls))
    blocked = np.bincount(wall_of[own], weights=against.blocked[own], minlength=len(walls))
    hidden = blocked > BLOCKED_WALL * np.maximum(count, 1)
    evidence = np.where(hidden, NO_WALL_NATS, matches.evidence[0])
    inside = max(MOST_INSIDE_NATS, INSIDE_NATS * float(against.inside.sum()))
    eyes = eye_height_nats(refined.world_from_model.moved(lines.centres), index.feet)
    return Found(refined, matches, against, float(evidence.sum()) + inside + eyes)


def differ(one: Found, other: Found, middle: NDArray[np.float64]) -> bool:
    """Whether two placements are not one: by the middle of the photos, turn and scale."""
    first, second = one.refined.world_from_model, other.refined.world_from_model
    apart = float(np.linalg.norm(first.moved(middle[None]) - second.moved(middle[None])))
    ratio = other.refined.level.turn[0] / one.refined.level.turn[0]
    turned, grown = abs(np.angle(ratio)), abs(np.log(abs(ratio)))
    return bool(apart > APART_M or turned > APART_RAD or grown > APART_SCALE)


def explained(found: Found, scene: Scene) -> float:
    """Share of the walls' widths that facades explain."""
    on = found.matches.evidence[0] > 0.0
    width = scene.columns.width
    return float(width[on].sum() / width.sum())


def fit_of(found: Found, scene: Scene) -> Fit:
    """For `georef.json` and the report."""
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
        residuals=residuals_of(refined, found.matches, scene.walls, scene.index.facades.names),
    )


def next_other(first: Found, others: Sequence[Found], scene: Scene) -> Found | None:
    """The first of these that is another placement."""
    return next((one for one in others if differ(first, one, scene.middle)), None)


def laid(
    model: CityModel,
    scene: Scene,
    first: Found,
    second: Found | None,
    verdict: tuple[bool, str],
    notes: tuple[str, ...] = (),
) -> Georeference:
    """The best placement with whether it is believed, and why, beside the next that is another."""
    accepted, why = verdict
    return Georeference(
        method="model",
        accepted=accepted,
        why=why,
        crs=model.crs,
        origin_m=model.origin_m,
        best=fit_of(first, scene),
        second=None if second is None else fit_of(second, scene),
        notes=notes,
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
