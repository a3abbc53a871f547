"""The scale of a sheet that says nothing of it: by what doors and walls usually measure."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from veduta.plan.document import ScaleEvidence
from veduta.plan.scale.evidence import Hypothesis, Voter

DOOR_M = 0.85
"""Width of the usual door, wall to wall."""
_WALL_M = 0.3  # thickness of the thickest walls
_SHEET_M = 12.0  # long side of what is drawn
_DOORS_SIGMA = 0.12  # the median door of a house is 0.7 to 1.0 m wide
_WALLS_SIGMA = 0.4
_SHEET_SIGMA = 0.5
_FEW = 3  # fewer doors than this may all be unusual ones


def door_voter(widths_px: Sequence[float]) -> Voter | None:
    """Doors as a weak vote: it settles whether `345` means 3.45 or 0.345 m. None without doors."""
    if not len(widths_px):
        return None
    width = float(np.median(widths_px))
    sigma = _DOORS_SIGMA * (1.0 if len(widths_px) >= _FEW else 1.5)
    reading = Hypothesis(math.log(DOOR_M / width), sigma, 1.0)
    text = f"{len(widths_px)} doors, median {width:.1f} px"
    return Voter("door", text, "doors", (reading,), mass=0.3)


def assumed_scale(walls_px: Sequence[float], size_px: float) -> ScaleEvidence:
    """A guess without doors: by the thickness of walls, else by the size of what is drawn.

    `walls_px` are thicknesses, `size_px` is the long side of what is drawn.
    """
    if len(walls_px):
        thickness = float(np.quantile(walls_px, 0.9))
        return ScaleEvidence(
            kind="assumed",
            text=f"thick walls of {thickness:.1f} px taken for {_WALL_M} m",
            metres_per_px=_WALL_M / thickness,
            sigma=_WALLS_SIGMA,
            agrees=True,
        )
    return ScaleEvidence(
        kind="assumed",
        text=f"{size_px:.0f} px of drawing taken for {_SHEET_M} m",
        metres_per_px=_SHEET_M / size_px,
        sigma=_SHEET_SIGMA,
        agrees=True,
    )
