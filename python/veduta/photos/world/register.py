"""Laying a component into a city model by its walls (section 2.6.2 of the thesis).

Hypotheses from pairs of walls, weighed by all walls, the best refined in space and held against
what may not be; then it is decided whether the best is believed. Where none is, and GPS says where
the photos were taken, that is a hypothesis too (`pose`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.photos.city.facades import Facades, facades_of
from veduta.photos.city.model import CityModel
from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall
from veduta.photos.world.believed import Standing, believed
from veduta.photos.world.evidence import FacadeIndex, match_walls
from veduta.photos.world.gauss_newton import UP_SD_RAD
from veduta.photos.world.georeference import Georeference
from veduta.photos.world.pose import register_pose
from veduta.photos.world.prior import PlacementPrior, log_cells
from veduta.photos.world.refine import refine
from veduta.photos.world.refine_points import refine_by_points
from veduta.photos.world.search import hypotheses
from veduta.photos.world.weighing import (
    Found,
    Scene,
    differ,
    explained,
    laid,
    next_other,
    scene_of,
    spread,
    weighed,
)

FEWEST_WALLS = 3
_RAN_AWAY = (
    "what single points say leads away from the walls' placement: it is that of the walls alone,"
    " less exact"
)


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
    if len(facades) == 0:
        return _refused(model, "the model has no walls")
    if len(walls) < FEWEST_WALLS:
        return _refused(
            model, f"only {len(walls)} walls were found, of {FEWEST_WALLS} that it takes"
        )
    scene = scene_of(structure, walls, FacadeIndex(facades), seed, up_sd_rad)
    found = _by_walls(scene, facades, model, prior)
    if found.accepted or prior is None or not prior.is_pose:
        return found
    by_pose = register_pose(scene, model, prior)
    return by_pose if by_pose.accepted or found.best is None else found


def _by_walls(
    scene: Scene, facades: Facades, model: CityModel, prior: PlacementPrior | None
) -> Georeference:
    """By the hypotheses of pairs of walls."""
    placements = hypotheses(scene.columns, facades)
    if prior is not None:
        placements = placements.taken(prior.allows(placements, scene.flat))
    if len(placements) == 0:
        near = "" if prior is None else f" within {prior.reach_m:.0f} m of where GPS says"
        return _refused(model, f"no two walls have the shapes of two facades of the model{near}")
    score = match_walls(scene.columns, scene.index, placements).score
    found: list[Found] = []
    for row in spread(placements, score, scene.flat):
        placement = placements.taken(np.array([row]))
        refined = refine(
            scene.columns, scene.corners, scene.index, placement, scene.middle, scene.up_sd_rad
        )
        if prior is None or prior.allows(refined.level, scene.flat)[0]:
            found.append(weighed(refined, scene))
    if not found:
        return _refused(model, "no placement stays near where GPS says")
    found.sort(key=lambda one: -one.score)
    closer = refine_by_points(
        found[0].refined,
        scene.columns,
        scene.corners,
        scene.index,
        scene.structure.points,
        scene.middle,
        scene.up_sd_rad,
    )
    first = weighed(closer, scene)
    ran_away = differ(first, found[0], scene.middle)
    if ran_away:
        first = found[0]
    second = next_other(first, found[1:], scene)
    standing = Standing(
        evidence=first.score,
        second=None if second is None else second.score,
        chance=log_cells(facades, prior),
        walls=int((first.matches.evidence[0] > 0.0).sum()),
        explained=explained(first, scene),
        blocked=first.against.blocked_share,
        inside=first.against.inside_share,
        covariance=first.refined.covariance,
    )
    notes = (_RAN_AWAY,) if ran_away else ()
    return laid(model, scene, first, second, believed(standing), notes)


def _refused(model: CityModel, why: str) -> Georeference:
    return Georeference("model", False, why, model.crs, model.origin_m, None)
