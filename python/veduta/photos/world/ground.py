"""How high the ground lies that photos were taken above, by the points around the cameras."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial import KDTree

from veduta.photos.structure import Structure
from veduta.photos.world.eye_height import Feet
from veduta.photos.world.georeference import Fit

FEET_SD_M = 0.7
"""How far the ground of a street lies off the feet of the buildings beside it."""
LOW_SHARE = 0.02
"""Share of the points around the cameras that lie under the ground: they are false."""


def ground_height(structure: Structure) -> float:
    """In the structure's own unit, z up; the lowest of what lies no further off than usual."""
    centres = structure.centres()
    away = structure.points[structure.point_of] - centres[structure.image_of]
    reach = float(np.median(np.linalg.norm(away, axis=1)))
    apart, _ = KDTree(centres[:, :2]).query(structure.points[:, :2])
    near = structure.points[np.asarray(apart) < reach, 2]
    return float(np.quantile(near if len(near) else structure.points[:, 2], LOW_SHARE))


def on_the_feet(fit: Fit, structure: Structure, feet: Feet) -> Fit:
    """The fit with the ground under the photos at the feet of a model's buildings beside them.

    Heights of GPS are poor, and models of outlines have none; as it is where no building is near.
    """
    world = fit.world_from_model
    under = feet.under(world.moved(structure.centres())[:, :2])
    under = under[np.isfinite(under)]
    if len(under) == 0:
        return fit
    lift = float(np.median(under)) - world.scale * ground_height(structure)
    shift = np.array([world.shift[0], world.shift[1], lift])
    sd = np.array([fit.shift_sd_m[0], fit.shift_sd_m[1], FEET_SD_M])
    return replace(fit, world_from_model=replace(world, shift=shift), shift_sd_m=sd)
