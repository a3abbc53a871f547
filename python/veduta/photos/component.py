"""A component with its cameras chosen, adjusted to all observations, cleaned and set upright."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from veduta.photos.lens import LensChoice, choose_lens, with_cameras
from veduta.photos.options import CameraOptions
from veduta.photos.orient import oriented
from veduta.photos.structure import (
    Structure,
    adjusted,
    errors_px,
    without_outliers,
)

MOST_ERROR_PX = 4.0
"""Observations that lie further off after the last adjustment are false."""


@dataclass(frozen=True)
class Component:
    """Photos that hang together. level_deg: how level they were held, in the middle."""

    structure: Structure
    lens: LensChoice
    level_deg: float

    @property
    def mean_error_px(self) -> float:
        """Mean distance of the observations from their points' projections."""
        return float(np.mean(errors_px(self.structure)))


def finish_component(
    mapped: Structure,
    options: CameraOptions,
    groups: Mapping[int, int],
    seed: int,
) -> Component:
    """What the engine mapped, with the cameras that the observations speak for."""
    choice = choose_lens(mapped, options, groups, seed)
    free = choice.kind.principal_point == "free"
    structure = with_cameras(mapped, choice.kind, groups)
    structure = without_outliers(adjusted(structure, free_principal_point=free), MOST_ERROR_PX)
    structure = adjusted(structure, free_principal_point=free)
    upright = oriented(without_outliers(structure, MOST_ERROR_PX))
    return Component(upright.structure, choice, upright.level_deg)
