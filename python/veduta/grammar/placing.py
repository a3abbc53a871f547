"""Where the buildings stand, and where a visitor begins."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from veduta.grammar.lots import Lots
from veduta.place.manifest import IDENTITY, Bounds, Place, PlacePart, Start

EYE_M = 1.7
MIN_DISTANCE_M, MAX_DISTANCE_M = 15.0, 60.0


def place_of(lots: Lots, built: Sequence[Mapping[str, Any]]) -> Place:
    """The place of what was built, as the summaries of the lots have it."""
    return Place(
        crs=lots.crs,
        origin=lots.origin_m,
        parts=[_part(lot) for lot in built],
        start=_start(built) if lots.look is None else Start(eye=lots.look[0], target=lots.look[1]),
    )


def _part(lot: Mapping[str, Any]) -> PlacePart:
    transform = list(IDENTITY)
    transform[12:15] = lot["anchor_m"]
    low, high = lot["bounds"]
    return PlacePart(
        id=lot["id"],
        name=lot["name"],
        model=lot["model"],
        transform=tuple(transform),
        arrangement="single",
        bounds=Bounds(min=tuple(low), max=tuple(high)),
    )


def _start(built: Sequence[Mapping[str, Any]]) -> Start:
    """South of the building in the middle of the southern edge, far enough to see it whole."""
    low = np.array([lot["bounds"][0] for lot in built]) + [lot["anchor_m"] for lot in built]
    high = np.array([lot["bounds"][1] for lot in built]) + [lot["anchor_m"] for lot in built]
    south, middle_x = float(low[:, 1].min()), float(low[:, 0].min() + high[:, 0].max()) / 2
    across = np.abs((low[:, 0] + high[:, 0]) / 2 - middle_x)
    front = int(np.argmin(across + (low[:, 1] - south)))
    height = float(high[front, 2] - low[front, 2])
    ground = float(low[front, 2])
    x = float(low[front, 0] + high[front, 0]) / 2
    distance = min(max(MIN_DISTANCE_M, 1.4 * height), MAX_DISTANCE_M)
    return Start(
        eye=(x - 0.4 * distance, south - distance, ground + EYE_M),
        target=(x, float(low[front, 1]), ground + 0.4 * height),
    )
