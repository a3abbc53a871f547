"""Outlines that tell no heights stand at zero: laid onto the ground that photos know."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from veduta.photos.city.facades import Facades
from veduta.photos.city.model import CityModel

LEAST_M = 2.0
"""A model whose feet lie nearer to the ground has heights that are meant."""


def lifted(model: CityModel, facades: Facades, ground_m: float) -> tuple[CityModel, str]:
    """The model with its feet at the ground, and what is to be told; as it is where it has heights.

    ground_m: about the model's origin.
    """
    is_flat = model.origin_m[2] == 0.0 and len(facades) > 0 and not np.any(facades.bottom)
    if not is_flat or abs(ground_m) < LEAST_M:
        return model, ""
    buildings = tuple(
        replace(one, offset_m=(one.offset_m[0], one.offset_m[1], one.offset_m[2] + ground_m))
        for one in model.buildings
    )
    note = f"the model tells no heights: its buildings stand on the ground, at {ground_m:.1f} m"
    return replace(model, buildings=buildings), note
