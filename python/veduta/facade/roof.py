"""A mansard over the footprint rectangle: steep lower slopes, flatter upper ones."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, radians, tan

from veduta.facade.cells import DECIMALS

# Slope of the lower part of a mansard.
LOWER_SLOPE_RAD = radians(72.0)
# The lower slope takes this share of the roof's height (h_l of h_l + h_t): from the street, where
# the photo was taken, little more than the lower slope is seen.
LOWER_SHARE = 0.85
# A roof lower than this is taken for one that the photo does not show: it is flat (m).
LEAST_ROOF_M = 0.5
# The lower slopes leave at least this share of the narrower side for the upper ones.
LEAST_TOP_SHARE = 0.4


@dataclass(frozen=True)
class Mansard:
    """Sizes in metres; the footprint is [0, width] x [0, depth], the eaves are at `eaves_m`."""

    width_m: float
    depth_m: float
    eaves_m: float
    lower_m: float
    upper_m: float
    inset_m: float

    @property
    def break_m(self) -> float:
        """Height of the edge between the lower and the upper slopes."""
        return self.eaves_m + self.lower_m

    @property
    def slope_deg(self) -> float:
        """How steep the lower slopes are."""
        return degrees(atan2(self.lower_m, self.inset_m))

    @property
    def top_m(self) -> float:
        """Height of the ridge."""
        return self.break_m + self.upper_m

    def front_y_m(self, z_m: float) -> float:
        """Where the front's lower slope is at this height."""
        return self.inset_m * (z_m - self.eaves_m) / self.lower_m


def plan_mansard(
    width_m: float, depth_m: float, eaves_m: float, roof_m: float, least_lower_m: float = 0.0
) -> Mansard | None:
    """The mansard of this height; None where the roof is too low to be one.

    `least_lower_m` is how high the lower slope must reach above the eaves (for its dormers).
    """
    if roof_m < LEAST_ROOF_M:
        return None
    lower = round(min(max(LOWER_SHARE * roof_m, least_lower_m), 0.92 * roof_m), DECIMALS)
    widest = 0.5 * (1.0 - LEAST_TOP_SHARE) * min(width_m, depth_m)
    inset = min(lower / tan(LOWER_SLOPE_RAD), widest)
    return Mansard(width_m, depth_m, eaves_m, lower, roof_m - lower, inset)
