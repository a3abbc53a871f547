"""What the sun's height does to the light: its colour and strength, and the sky's.

Colours, strengths and how they are mixed are the studio's (`studio/src/three/sky-light.ts`,
`studio/src/core/daylight.ts`), but for `around`; they are chosen by eye.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.place.material import Colour
from veduta.place.mover import Vector
from veduta.place.sunlight import Sunlight
from veduta.plan.sun import SunPosition
from veduta.plan.surroundings.site import Site

DAY_SINE, NIGHT_SINE, DUSK_SINE = 0.3, -0.12, 0.22
"""Sines of the sun's elevation: as light as by day from here on, dark from there on, red below."""
FADE_SINE = 0.03
"""Below this the sun's own light fades; there is none on the horizon."""
DUSK_SHARE = 0.75
MOON = SunPosition(140.7, 44.6)
"""Where light comes from by night: high, from the side from which most houses are seen."""


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


@dataclass(frozen=True)
class Look:
    """How it looks at one time: colours as in the studio, strengths in its units.

    around: of X3D's lights from the sky, which have the sun's colour; 1 by day.
    """

    sun: str
    sun_strength: float
    zenith: str
    horizon: str
    picture: str
    around: float


DAY = Look("#fff6ea", 3.1, "#7ea6c9", "#e4eaee", "#ffffff", 1.0)
DUSK = Look("#ff9d5c", 1.5, "#5f7ba6", "#e9b48f", "#c9a899", 0.49)
NIGHT = Look("#b4c6e8", 0.55, "#101a2e", "#2c3a52", "#384257", 0.4)


def daylight_of(sun: SunPosition) -> Daylight:
    """The light by a sun of this height."""
    height = math.sin(math.radians(sun.elevation_deg))
    share = min(1.0, max(0.0, (height - NIGHT_SINE) / (DAY_SINE - NIGHT_SINE)))
    day = share * share * (3.0 - 2.0 * share)
    dusk = DUSK_SHARE * max(0.0, 1.0 - abs(height) / DUSK_SINE)
    if sun.is_up:
        colour = _colour(NIGHT.sun, DAY.sun, DUSK.sun, day, dusk)
        full = _number(NIGHT.sun_strength, DAY.sun_strength, DUSK.sun_strength, day, dusk)
        direct = min(1.0, height / FADE_SINE)
    else:
        # The moon has its own colour and strength, however red the sky still is.
        colour = _colour(NIGHT.sun, DAY.sun, DUSK.sun, 0.0, 0.0)
        full, direct = NIGHT.sun_strength, min(1.0, height / NIGHT_SINE)
    return Daylight(
        colour,
        direct * full / DAY.sun_strength,
        _number(NIGHT.around, DAY.around, DUSK.around, day, dusk),
        _colour(NIGHT.zenith, DAY.zenith, DUSK.zenith, day, dusk),
        _colour(NIGHT.horizon, DAY.horizon, DUSK.horizon, day, dusk),
        _colour(NIGHT.picture, DAY.picture, DUSK.picture, day, dusk),
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


def _colour(night: str, light: str, red: str, day: float, dusk: float) -> Colour:
    """Mixed as light is, in linear values; sRGB."""
    at_night, by_day, at_dusk = (
        linear_of_srgb(np.array(_srgb(one))) for one in (night, light, red)
    )
    plain = at_night + day * (by_day - at_night)
    mixed = srgb_of_linear(plain + dusk * (at_dusk - plain))
    one, two, three = np.round(mixed, 4).tolist()
    return one, two, three


def _srgb(text: str) -> Colour:
    red, green, blue = bytes.fromhex(text.removeprefix("#"))
    return red / 255.0, green / 255.0, blue / 255.0
