"""Whether what lies above the eaves is a roof, or the wall that goes on: a parapet, an attic."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float
from veduta.facade.extent import Skyline


@dataclass(frozen=True)
class AboveParameters:
    """When the wall goes on above the eaves.

    `no_roof`: the chance of wall there from which on it does. Of a hundred pictures of two sets (40
    of ECP train, 60 of CMP) it decides in eight: three with a roof have 0.76, 0.76 and 0.81, five
    without 0.75 to 0.87.
    Roofs are darker than walls: what is as light as the middle of the storey below, and has a
    colour of its wall, is none. `tint`, `light`: how far the middle colour there may be from that
    of a pixel of the wall (Lab of 0 to 255: a and b; lightness) to be of its colour. `share`: of
    the wall's pixels so many are. `roof`: the chance of roof from which on the colour does not
    count, unless what is there is lower than `low` storeys. What is higher than `high` ones may be
    a storey and a roof. `opening`: pixels of windows count on neither side. Looked at on rendered
    blocks (6 to 45 lighter) and roofs (18 to 104 darker) of seeds 20 to 29. Roofs of zinc in the
    sun are as light as walls, as four fronts of ECP val showed: dormers tell them, and `high`.
    """

    no_roof: float = 0.82
    tint: float = 8.0
    light: float = 30.0
    share: float = 0.1
    roof: float = 0.3
    low: float = 0.4
    high: float = 1.0
    opening: float = 0.5


@dataclass(frozen=True)
class Surfaces:
    """The chances (h, w) of wall, roof and window between the sides of a front."""

    wall: Float
    roof: Float
    window: Float


def is_wall_above(
    evidence: Evidence,
    skyline: Skyline,
    eaves: float,
    storey: float,
    surfaces: Surfaces,
    *,
    dormers: bool = False,
    parameters: AboveParameters | None = None,
) -> bool:
    """Whether the wall goes on from the eaves up to the outline (rows and storeys of pixels).

    dormers: windows stand there that are no storey's.
    """
    own = parameters or AboveParameters()
    top, end = skyline.level, round(eaves)
    if end - top < 2:
        return False
    if float(surfaces.wall[top:end].mean()) > own.no_roof:
        return True
    above = _inside(evidence, skyline, top + 1, end)
    above &= surfaces.window < own.opening
    wall = _inside(evidence, skyline, end, round(eaves + storey)) & (surfaces.wall > 0.5)
    is_too_high = end - top > own.high * storey
    if dormers or is_too_high or not above.any() or not wall.any():
        return False
    is_low = end - top <= own.low * storey
    if not is_low and float(surfaces.roof[above].mean()) > own.roof:
        return False
    return _is_alike(evidence.lab[above], evidence.lab[wall], own)


def _inside(evidence: Evidence, skyline: Skyline, top: int, end: int) -> NDArray[np.bool_]:
    """Pixels (h, w) of the building between two rows."""
    rows = np.arange(evidence.height)[:, None]
    below = rows >= skyline.rows[None] + 1
    return np.asarray(below & (rows >= top) & (rows < end) & evidence.valid, bool)


def _is_alike(above: Float, wall: Float, parameters: AboveParameters) -> bool:
    """Whether what is above (n, 3) is as light as the wall (m, 3), in one of its colours."""
    middle = np.median(above, axis=0)
    apart = np.abs(wall - middle)
    tint = (apart[:, 1:] <= parameters.tint).all(1)
    share = float((tint & (apart[:, 0] <= parameters.light)).mean())
    return bool(middle[0] >= np.median(wall[:, 0])) and share >= parameters.share
