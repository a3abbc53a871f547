"""What the sun's height does to the light: its colour and strength, and the sky's.

The values are those of the studio (`studio/src/three/sky-light.ts`); they are chosen by eye.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from veduta.place.material import Colour
from veduta.place.mover import Vector
from veduta.place.sunlight import Sunlight
from veduta.plan.surroundings.site import Site
from veduta.plan.surroundings.sun import SunPosition

_DAY_SINE, _NIGHT_SINE, _DUSK_SINE = 0.3, -0.12, 0.22
"""Sines of the sun's elevation: as light as by day from here on, dark from there on, red below."""
_DUSK_SHARE = 0.75
MOON = SunPosition(140.7, 44.6)
"""Where light comes from by night: high, from the side from which most houses are seen."""
_MOON_STRENGTH = 0.18


@dataclass(frozen=True)
class Daylight:
    """Colours are sRGB. strength: of the sun or the moon; around: of the sky's light; 1 by day.

    shown: by what a picture that was taken by day is multiplied.
    """

    colour: Colour
    strength: float
    around: float
    zenith: Colour
    horizon: Colour
    shown: Colour


_DAY = Daylight(
    (1.0, 0.98, 0.94), 1.0, 1.0, (0.30, 0.52, 0.80), (0.87, 0.92, 0.96), (1.0, 1.0, 1.0)
)
_DUSK = Daylight(
    (1.0, 0.62, 0.36), 0.48, 0.49, (0.37, 0.48, 0.65), (0.91, 0.71, 0.56), (0.79, 0.66, 0.60)
)
_NIGHT = Daylight(
    (0.71, 0.78, 0.91), _MOON_STRENGTH, 0.4, (0.06, 0.10, 0.18), (0.17, 0.23, 0.32),
    (0.22, 0.26, 0.34),
)  # fmt: skip


def daylight_of(sun: SunPosition) -> Daylight:
    """The light by a sun of this height."""
    height = math.sin(math.radians(sun.elevation_deg))
    share = min(1.0, max(0.0, (height - _NIGHT_SINE) / (_DAY_SINE - _NIGHT_SINE)))
    day = share * share * (3.0 - 2.0 * share)
    dusk = _DUSK_SHARE * max(0.0, 1.0 - abs(height) / _DUSK_SINE)
    return Daylight(
        _colour(_NIGHT.colour, _DAY.colour, _DUSK.colour, day, dusk),
        _number(_NIGHT.strength, _DAY.strength, _DUSK.strength, day, dusk),
        _number(_NIGHT.around, _DAY.around, _DUSK.around, day, dusk),
        _colour(_NIGHT.zenith, _DAY.zenith, _DUSK.zenith, day, dusk),
        _colour(_NIGHT.horizon, _DAY.horizon, _DUSK.horizon, day, dusk),
        _colour(_NIGHT.shown, _DAY.shown, _DUSK.shown, day, dusk),
    )


def sunlight_of(site: Site) -> Sunlight:
    """The sun over a site, in the plan frame; the moon where it is night."""
    light = daylight_of(site.sun)
    return Sunlight(toward_light(site), light.colour, light.strength)


def toward_light(site: Site) -> Vector:
    """Unit vector to the sun in the plan frame, or to the moon by night."""
    if site.sun.is_up:
        return site.toward_sun
    return MOON.toward(site.turn_deg)


def _number(night: float, light: float, red: float, day: float, dusk: float) -> float:
    plain = night + day * (light - night)
    return plain + dusk * (red - plain)


def _colour(night: Colour, light: Colour, red: Colour, day: float, dusk: float) -> Colour:
    mixed = [_number(*three, day, dusk) for three in zip(night, light, red, strict=True)]
    one, two, three = np.round(mixed, 4).tolist()
    return one, two, three
