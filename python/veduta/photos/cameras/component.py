"""A component with its cameras chosen, adjusted to all observations, cleaned and set upright."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.lens import LensChoice, choose_lens, with_cameras
from veduta.photos.cameras.orient import oriented
from veduta.photos.cameras.upright import Upright
from veduta.photos.options import CameraOptions
from veduta.photos.structure import (
    Structure,
    adjusted,
    errors_px,
    without_outliers,
)

MOST_ERROR_PX = 4.0
"""Observations that lie further off after the last adjustment are false."""
FEWEST_POINTS = 30
"""The engine places a photo by as many; one that is left with fewer was placed falsely."""


@dataclass(frozen=True)
class Component:
    """Photos that hang together. level_deg: how level they were held, in the middle.

    upright: what walls and vertical edges said of up; None where they were not asked.
    """

    structure: Structure
    lens: LensChoice
    level_deg: float
    upright: Upright | None = None

    @cached_property
    def errors_px(self) -> NDArray[np.float64]:
        """(o,) distance of each observation from its point's projection."""
        return errors_px(self.structure)


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
    structure = without_outliers(adjusted(structure, free_principal_point=free), MOST_ERROR_PX)
    upright = oriented(without_weak(structure))
    return Component(upright.structure, choice, upright.level_deg)


def without_weak(structure: Structure) -> Structure:
    """The same without photos that too few points hold, as long as two are left."""
    counts = np.bincount(structure.image_of, minlength=len(structure.names))
    weak = counts < FEWEST_POINTS
    if not weak.any() or np.count_nonzero(~weak) < 2:
        return structure
    return structure.without_photos(weak)
