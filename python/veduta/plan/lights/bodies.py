"""What lamps look like: turned bodies of glass that glows and metal. All of it is invented."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.place.lamp import Lamp
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Light, Storey
from veduta.plan.house.frame import Frame, Sculptor, Surface, level
from veduta.plan.lights.furnished import FLOOR_LAMP_M, bodies_of

Profile = Sequence[tuple[float, float]]
"""(radius, height) from the lowest to the highest point of a turned body (m)."""
_SEGMENTS = 20
_PENDANT_M = 0.3
"""A ceiling lamp that is so far below its ceiling hangs on a cord."""
_PLATE: Profile = ((0.15, 0.0), (0.15, 0.025))
_DOME: Profile = (
    (0.0, -0.085), (0.06, -0.08), (0.11, -0.064), (0.145, -0.04), (0.16, -0.012), (0.16, 0.0),
)  # fmt: skip
_SHADE: Profile = (
    (0.175, -0.13), (0.11, 0.11), (0.105, 0.11), (0.17, -0.13),
)  # fmt: skip
_FOOT: Profile = ((0.14, 0.0), (0.14, 0.012), (0.115, 0.022), (0.011, 0.03))
_SMALL_FOOT: Profile = ((0.075, 0.0), (0.075, 0.012), (0.05, 0.022), (0.008, 0.03))


def add_lamps(storey: Storey, ceiling_m: float, sculptor: Sculptor) -> None:
    """The lamps of a storey: what shines, and its body where no furniture is that.

    ceiling_m: above the floor.
    """
    bodied = bodies_of(storey)
    for light in storey.lights or []:
        x, y = light.at_m
        at = (x, y, storey.elevation_m + light.above_m)
        name = f"{storey.name} light {light.id}"
        room = f"{storey.name} {light.room}"
        sculptor.builder.lamp(Lamp(name, light.kind, at, light.lumen, room))
        if light.id in bodied:
            continue
        feature = sculptor.builder.feature(
            SemanticClass.OTHER,
            Provenance.INVENTED,
            name,
            shell=sculptor.builder.new_shell(),
        )
        body = _Body(sculptor, level(storey.elevation_m), light, feature)
        body.add(ceiling_m)


class _Body:
    """The body of one lamp, in the frame of its storey."""

    def __init__(self, sculptor: Sculptor, frame: Frame, light: Light, feature: int) -> None:
        self._sculptor, self._frame, self._light = sculptor, frame, light
        self._glass = Surface(feature, "lamp glass")
        self._metal = Surface(feature, "lamp metal")

    def add(self, ceiling_m: float) -> None:
        """Add what the kind of the lamp asks for."""
        above = self._light.above_m
        kind = self._light.kind
        if kind == "ceiling" and ceiling_m - above < _PENDANT_M:
            self._turned(_PLATE, ceiling_m - 0.025, self._metal)
            self._turned(_DOME, ceiling_m - 0.025, self._glass)
        elif kind == "ceiling":
            self._turned(((0.05, 0.0), (0.05, 0.03)), ceiling_m - 0.03, self._metal)
            self._turned(((0.006, above + 0.11), (0.006, ceiling_m - 0.03)), 0.0, self._metal)
            self._shade(above, 1.0)
        elif kind == "wall":
            self._turned(((0.0, -0.11), (0.06, -0.1), (0.06, 0.1), (0.0, 0.11)), above, self._glass)
            self._turned(((0.066, -0.012), (0.066, 0.012)), above, self._metal)
        else:
            small = kind == "table"
            size = 0.6 if small else above / FLOOR_LAMP_M
            foot = 0.0 if not small else above - 0.3
            self._turned(_SMALL_FOOT if small else _FOOT, foot, self._metal)
            self._turned(((0.009, foot + 0.02), (0.009, above + 0.09 * size)), 0.0, self._metal)
            self._shade(above, size)

    def _shade(self, height_m: float, size: float) -> None:
        """A cone that is open above and below."""
        self._turned([(size * r, size * z) for r, z in _SHADE], height_m, self._glass, closed=True)

    def _turned(
        self, profile: Profile, height_m: float, surface: Surface, *, closed: bool = False
    ) -> None:
        """A profile turned about the upright through the lamp; closed: it is a ring, not a line."""
        x, y = self._light.at_m
        middle = np.array([x, y, height_m])
        for ring in turned(profile, closed=closed):
            self._sculptor.face([ring + middle], self._frame, surface)


def turned(profile: Profile, *, closed: bool = False) -> list[NDArray[np.float64]]:
    """The faces of a turned body, (n, 3) each, counter-clockwise seen from outside.

    An open profile runs upwards and gets flat ends; a closed one runs around its section
    counter-clockwise as seen with the axis to the left.
    """
    angle = 2.0 * np.pi * np.arange(_SEGMENTS) / _SEGMENTS
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros(_SEGMENTS)], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    rings = [radius * circle + height * up for radius, height in profile]
    pairs = list(zip(rings[:-1], rings[1:], strict=True))
    faces: list[NDArray[np.float64]] = []
    if closed:
        pairs.append((rings[-1], rings[0]))
    else:
        if profile[0][0] > 0.0:
            faces.append(rings[0][::-1])
        if profile[-1][0] > 0.0:
            faces.append(rings[-1])
    for low, high in pairs:
        after_low, after_high = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
        for corners in np.stack([low, after_low, after_high, high], axis=1):
            faces.append(_without_twins(corners))
    return faces


def _without_twins(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """At the axis a quad is a triangle."""
    apart = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1) > 1e-9
    kept: NDArray[np.float64] = corners[apart]
    return kept
