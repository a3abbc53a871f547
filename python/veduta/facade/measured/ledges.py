"""Cornices and string courses: bands that stand before the wall along the whole front."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.facade.measured.surface import NORMAL, Depths, Mask
from veduta.facade.measured_depths import Ledge


@dataclass(frozen=True)
class LedgeParameters:
    """out_m, farthest_m: how far a ledge juts out (m). sigmas: and at least so many spreads of the
    wall. known_share: of a row that must have a depth; out_share: of those that must stand out.
    lowest_m, highest_m: heights of a ledge (m).
    """

    out_m: float = 0.04
    farthest_m: float = 1.5
    sigmas: float = 2.5
    known_share: float = 0.3
    out_share: float = 0.6
    lowest_m: float = 0.06
    highest_m: float = 1.2


def find_ledges(
    beyond_m: Depths,
    wall: Mask,
    metres_per_px: float,
    wall_spread_m: float,
    detail_m: float,
    parameters: LedgeParameters,
) -> tuple[Ledge, ...]:
    """The ledges from the top down, in the rows of `beyond_m`.

    beyond_m: (h, w) the front's columns, metres before the wall's surface. wall: (h, w) what
    belongs to no opening and no balcony. detail_m: what is lower is smoothed away.
    """
    known = wall & np.isfinite(beyond_m)
    least = max(parameters.out_m, parameters.sigmas * wall_spread_m)
    with np.errstate(invalid="ignore"):
        out = known & (beyond_m > least) & (beyond_m < parameters.farthest_m)
    count = known.sum(axis=1)
    enough = count >= np.maximum(parameters.known_share * wall.shape[1], 1)
    is_out = enough & (out.sum(axis=1) >= parameters.out_share * count)
    edges = np.flatnonzero(np.diff(np.r_[False, is_out, False].astype(np.int8)))
    found = []
    for first, last in zip(edges[0::2].tolist(), edges[1::2].tolist(), strict=True):
        if (
            not max(parameters.lowest_m, 0.5 * detail_m)
            <= (last - first) * metres_per_px
            <= parameters.highest_m
        ):
            continue
        depths = beyond_m[first:last][out[first:last]]
        middle = float(np.median(depths))
        spread = NORMAL * float(np.median(np.abs(depths - middle)))
        found.append(
            Ledge(
                y_px=float(first),
                height_px=float(last - first),
                out_m=round(middle, 4),
                spread_m=round(spread, 4),
            )
        )
    return tuple(found)
