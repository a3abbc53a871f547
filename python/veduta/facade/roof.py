"""A mansard over the footprint rectangle: steep lower slopes, flatter upper ones."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan

# Slope of the lower part of a mansard.
LOWER_SLOPE_RAD = radians(72.0)
# The lower slope takes this share of the roof's height (h_l of h_l + h_t): from the street, where
# the photo was taken, little more than the lower slope is seen.
LOWER_SHARE = 0.85
# A roof lower than this is taken for one that the photo does not show: it is flat (m).
LEAST_ROOF_M = 0.5
# The lower slopes leave at least this share of the narrower side for the upper ones.
LEAST_TOP_SHARE = 0.4

Point = tuple[float, float, float]


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
    def top_m(self) -> float:
        """Height of the ridge."""
        return self.break_m + self.upper_m

    def front_y_m(self, z_m: float) -> float:
        """Where the front's lower slope is at this height."""
        return self.inset_m * (z_m - self.eaves_m) / self.lower_m

    def lower_slopes(self) -> dict[str, list[Point]]:
        """Front, right, back and left, counter-clockwise seen from outside."""
        low = self._ring(0.0, self.eaves_m)
        high = self._ring(self.inset_m, self.break_m)
        names = ("front", "right", "back", "left")
        return {
            name: [low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]]
            for i, name in enumerate(names)
        }

    def upper_slopes(self) -> dict[str, list[Point]]:
        """Hipped: equal slopes up to a ridge along the longer side, or to one point."""
        a, b, c, d = self._ring(self.inset_m, self.break_m)
        half = 0.5 * min(b[0] - a[0], d[1] - a[1])
        low_end = (a[0] + half, a[1] + half, self.top_m)
        high_end = (c[0] - half, c[1] - half, self.top_m)
        slack = (b[0] - a[0]) - (d[1] - a[1])
        if abs(slack) < 1e-3:
            apex = (0.5 * (a[0] + c[0]), 0.5 * (a[1] + c[1]), self.top_m)
            return {
                "front": [a, b, apex],
                "right": [b, c, apex],
                "back": [c, d, apex],
                "left": [d, a, apex],
            }
        if slack > 0:  # the ridge runs along the street
            return {
                "front": [a, b, high_end, low_end],
                "right": [b, c, high_end],
                "back": [c, d, low_end, high_end],
                "left": [d, a, low_end],
            }
        return {
            "front": [a, b, low_end],
            "right": [b, c, high_end, low_end],
            "back": [c, d, high_end],
            "left": [d, a, low_end, high_end],
        }

    def _ring(self, inset_m: float, z_m: float) -> list[Point]:
        x1, y1 = self.width_m - inset_m, self.depth_m - inset_m
        return [(inset_m, inset_m, z_m), (x1, inset_m, z_m), (x1, y1, z_m), (inset_m, y1, z_m)]


def plan_mansard(
    width_m: float, depth_m: float, eaves_m: float, roof_m: float, least_lower_m: float = 0.0
) -> Mansard | None:
    """The mansard of this height; None where the roof is too low to be one.

    `least_lower_m` is how high the lower slope must reach above the eaves (for its dormers).
    """
    if roof_m < LEAST_ROOF_M:
        return None
    lower = min(max(LOWER_SHARE * roof_m, least_lower_m), 0.92 * roof_m)
    widest = 0.5 * (1.0 - LEAST_TOP_SHARE) * min(width_m, depth_m)
    inset = min(lower / tan(LOWER_SLOPE_RAD), widest)
    return Mansard(width_m, depth_m, eaves_m, lower, roof_m - lower, inset)
