"""Where the sun stands over a place at a time, by the NOAA's formulas (astral has them).

Directions are true ones, without the bending of light in the air (at most 0.5 degrees).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone

import astral
import astral.sun

USUAL_AZIMUTH_DEG, USUAL_ELEVATION_DEG = 229.26, 34.79
"""A spring afternoon's sun, the light of the studio where nothing else is known."""
USUAL_TIME = "2026-03-20T14:30"
"""A time for a place of which none is told: the same afternoon."""
FIRST_YEAR, LAST_YEAR = 1901, 2099
"""The years for which the formulas hold."""
_HOUR_DEG = 15.0


@dataclass(frozen=True)
class SunPosition:
    """azimuth_deg: clockwise from north, 0 to 360. elevation_deg: above the level, -90 to 90."""

    azimuth_deg: float
    elevation_deg: float

    @property
    def is_up(self) -> bool:
        """Whether it is day."""
        return self.elevation_deg > 0.0

    def toward(self, north_deg: float) -> tuple[float, float, float]:
        """Unit vector to the sun where x is right and y up on a page.

        north_deg: how far north is turned there, clockwise from up.
        """
        azimuth = math.radians(self.azimuth_deg + north_deg)
        elevation = math.radians(self.elevation_deg)
        level = math.cos(elevation)
        return level * math.sin(azimuth), level * math.cos(azimuth), math.sin(elevation)


USUAL_SUN = SunPosition(USUAL_AZIMUTH_DEG, USUAL_ELEVATION_DEG)


def sun_position(latitude_deg: float, longitude_deg: float, when: datetime) -> SunPosition:
    """The sun over a place at a time with its offset from UTC (years 1901 to 2099)."""
    here = astral.Observer(latitude_deg, longitude_deg)
    return SunPosition(
        astral.sun.azimuth(here, when),
        astral.sun.elevation(here, when, with_refraction=False),
    )


def read_time(text: str) -> datetime:
    """A date with a time of day (ISO 8601); ValueError says what is wrong with it."""
    try:
        when = datetime.fromisoformat(text.strip())
    except ValueError:
        example = "such as 2026-06-21T15:00 or 2026-06-21T15:00+02:00"
        raise ValueError(f"{text!r} is no date with a time, {example}") from None
    if "T" not in text.upper() and " " not in text.strip():
        raise ValueError(f"{text!r} has no time of day: write {text.strip()}T15:00, for one")
    if not FIRST_YEAR <= when.year <= LAST_YEAR:
        raise ValueError(f"{text!r} is not in the years {FIRST_YEAR} to {LAST_YEAR}")
    offset = when.utcoffset()
    if offset is not None and offset % timedelta(minutes=1):
        raise ValueError(f"{text!r} has an offset that is no whole number of minutes")
    return when


def in_zone(when: datetime, longitude_deg: float) -> datetime:
    """A time without an offset, as a clock of the longitude's zone: 15 degrees an hour."""
    if when.tzinfo is not None:
        return when
    return when.replace(tzinfo=timezone(timedelta(hours=round(longitude_deg / _HOUR_DEG))))
