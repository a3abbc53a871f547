"""A gable over the front, or a hipped roof: what is built of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from veduta.facade.adjusted import left_out
from veduta.facade.layout import GAP_M, SMALLEST_M, Opening
from veduta.facade.rectangles import Rectangle, carve


@dataclass(frozen=True)
class GableLimits:
    """least_m: a roof lower than this is flat (m), as `roof.LEAST_ROOF_M`. kept: the share of its
    width that an opening has left beside the gable's sides and other openings, at least.
    """

    least_m: float = 0.5
    kept: float = 0.6


@dataclass(frozen=True)
class PlannedGable:
    """Over a front `width_m` wide, from `eaves_m` up; the openings lie in the gable."""

    kind: Literal["gable", "hip"]
    width_m: float
    eaves_m: float
    height_m: float
    openings: tuple[Opening, ...] = ()

    @property
    def top_m(self) -> float:
        """Height of the ridge over the ground."""
        return self.eaves_m + self.height_m

    def side_m(self, z_m: float) -> float:
        """How far the gable's side has come in at a height over the ground."""
        return 0.5 * self.width_m * (z_m - self.eaves_m) / self.height_m


def plan_gable(
    kind: Literal["gable", "hip"],
    sizes_m: tuple[float, float, float],
    windows: Sequence[Opening],
    notes: list[str],
    limits: GableLimits | None = None,
) -> PlannedGable | None:
    """The roof over a front of this width, height of the eaves, and height of the roof.

    None where it is too low. Windows that do not lie in the gable are left out, and noted.
    """
    own = limits or GableLimits()
    width, eaves, high = sizes_m
    if high < own.least_m:
        return None
    gable = PlannedGable(kind, width, eaves, high)
    found: list[Opening] = []
    for window in windows:
        place = window.rectangle
        place = Rectangle(place.x0, max(place.z0, eaves + GAP_M), place.x1, place.z1)
        side = gable.side_m(place.z1) + GAP_M
        inside = place.common(Rectangle(side, eaves, width - side, gable.top_m))
        free = carve(inside, [other.rectangle for other in found], GAP_M)
        small = free.width < max(SMALLEST_M, own.kept * place.width) or free.height < SMALLEST_M
        if kind == "hip" or small:
            reason = "it does not lie in the gable" if kind == "gable" else "it lies in the roof"
            notes.append(left_out(window.element, window.number, reason))
            continue
        found.append(Opening(free, window.element, window.number))
    return PlannedGable(kind, width, eaves, high, tuple(found))
