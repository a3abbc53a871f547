"""The sun by place and time against published positions, and by north on a page."""

from __future__ import annotations

import math
import re
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.plan.sun import SunPosition, in_zone, read_time, sun_position
from veduta.plan.surroundings import daylight
from veduta.plan.surroundings.daylight import daylight_of


def test_position_published_by_nrel() -> None:
    """NREL/TP-560-34302, appendix A.5: zenith 50.11162, azimuth 194.34024 degrees."""
    when = datetime.fromisoformat("2003-10-17T12:30:30-07:00")
    sun = sun_position(39.742476, -105.1786, when)
    assert sun.azimuth_deg == pytest.approx(194.34024, abs=0.03)
    assert sun.elevation_deg == pytest.approx(90.0 - 50.11162, abs=0.03)


@pytest.mark.parametrize(
    ("place", "when"),
    [
        # Sunrise and sunset as almanacs print them, to the minute: the upper edge of the sun
        # appears or goes when its middle is 0.833 degrees below the level.
        ((51.5, -0.1167), "2026-06-21T04:43+01:00"),
        ((51.5, -0.1167), "2026-06-21T21:21+01:00"),
        ((51.5, -0.1167), "2026-12-21T08:04+00:00"),
        ((51.5, -0.1167), "2026-12-21T15:53+00:00"),
    ],
)
def test_rise_and_set_in_london(place: tuple[float, float], when: str) -> None:
    sun = sun_position(*place, datetime.fromisoformat(when))
    assert sun.elevation_deg == pytest.approx(-0.833, abs=0.15)


@given(st.floats(-66.0, 66.0), st.floats(-180.0, 180.0))
def test_noon_at_the_solstice(latitude: float, longitude: float) -> None:
    """At noon in June the sun stands 23.44 degrees north of the equator's highest point."""
    noon = in_zone(datetime(2026, 6, 21, 12, 0), longitude)
    ups = [
        sun_position(latitude, longitude, noon.replace(hour=hour, minute=minute)).elevation_deg
        for hour in (11, 12)
        for minute in range(0, 60, 2)  # near the zenith it moves by a quarter of a degree a minute
    ]
    assert max(ups) == pytest.approx(90.0 - abs(latitude - 23.44), abs=0.6)


def test_poles_have_a_sun() -> None:
    """Within 0.2 degrees of a pole the formulas stay where they are."""
    for latitude in (-90.0, 90.0):
        sun = sun_position(latitude, 0.0, datetime.fromisoformat("2026-06-21T12:00+00:00"))
        assert sun.elevation_deg == pytest.approx(math.copysign(23.44, latitude), abs=0.21)


def test_directions_on_a_page() -> None:
    """North up: a sun in the east is to the right. North to the right: it is below."""
    east = SunPosition(90.0, 0.0)
    assert east.toward(0.0) == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    assert east.toward(90.0) == pytest.approx((0.0, -1.0, 0.0), abs=1e-12)
    assert SunPosition(10.0, 90.0).toward(33.0) == pytest.approx((0.0, 0.0, 1.0), abs=1e-12)


@given(st.floats(0.0, 360.0), st.floats(-90.0, 90.0), st.floats(0.0, 360.0))
def test_directions_have_length_one(azimuth: float, elevation: float, north: float) -> None:
    toward = SunPosition(azimuth, elevation).toward(north)
    assert np.linalg.norm(toward) == pytest.approx(1.0)
    assert math.asin(max(-1.0, min(1.0, toward[2]))) == pytest.approx(
        math.radians(elevation), abs=1e-6
    )


def test_a_clock_without_an_offset_is_the_longitudes() -> None:
    when = read_time("2026-06-21T15:00")
    assert in_zone(when, 151.2).isoformat() == "2026-06-21T15:00:00+10:00"
    assert in_zone(when, -0.1).isoformat() == "2026-06-21T15:00:00+00:00"
    assert in_zone(read_time("2026-06-21T15:00Z"), 151.2).utcoffset().seconds == 0


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("yesterday", "is no date with a time"),
        ("2026-02-30T12:00", "is no date with a time"),
        ("2026-06-21", "has no time of day"),
        ("1850-06-21T12:00", "is not in the years"),
        ("2026-06-21T12:00+02:00:30", "no whole number of minutes"),
        ("1912-06-21T12:00-07:52:58", "no whole number of minutes"),
    ],
)
def test_faulty_times_are_told(text: str, fault: str) -> None:
    with pytest.raises(ValueError, match=fault):
        read_time(text)


def test_light_by_the_suns_height() -> None:
    noon, low, night = (daylight_of(SunPosition(180.0, e)) for e in (50.0, 1.0, -20.0))
    assert noon.strength == pytest.approx(1.0)
    assert noon.strength > low.strength > night.strength
    assert low.colour[0] - low.colour[2] > noon.colour[0] - noon.colour[2] > 0.0
    assert night.colour[2] > night.colour[0]
    assert max(night.shown) < 0.4


STUDIO = Path(__file__).parents[3] / "studio" / "src"


def by_sine(sine: float) -> daylight.Daylight:
    return daylight_of(SunPosition(180.0, math.degrees(math.asin(sine))))


def test_light_has_the_values_of_the_studio() -> None:
    source = (STUDIO / "three" / "sky-light.ts").read_text()
    for name in ("DAY", "DUSK", "NIGHT"):
        (block,) = re.findall(rf"const {name}: Look = {{(.*?)}};", source, re.DOTALL)
        told = dict(re.findall(r'(\w+): "?([^",]+)"?,', block))
        look = getattr(daylight, name)
        assert {one: told[one] for one in ("sun", "zenith", "horizon", "picture")} == {
            "sun": look.sun, "zenith": look.zenith, "horizon": look.horizon,
            "picture": look.picture,
        }  # fmt: skip
        assert float(told["sunStrength"]) == look.sun_strength
    source += (STUDIO / "core" / "daylight.ts").read_text()
    for name in ("DAY_SINE", "NIGHT_SINE", "DUSK_SINE", "FADE_SINE", "DUSK_SHARE"):
        assert re.findall(rf"const {name} = (.*);", source) == [str(getattr(daylight, name))]
    (moon,) = re.findall(r"const TO_MOON: Vec3 = \[(.*)\];", source)
    way = np.array([float(one) for one in moon.split(",")])
    assert daylight.MOON.toward(0.0) == pytest.approx(way / np.linalg.norm(way), abs=1e-3)


def test_colours_are_mixed_as_light_is() -> None:
    """Between night and day: of the linear values, by the curve of IEC 61966-2-1."""

    def linear(value: float) -> float:
        return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4

    sine = 0.25  # above where it is red
    share = (sine + 0.12) / 0.42
    day = share * share * (3.0 - 2.0 * share)
    mixed = (1.0 - day) * linear(0x1A / 255.0) + day * linear(0xA6 / 255.0)
    assert linear(by_sine(sine).zenith[1]) == pytest.approx(mixed, abs=1e-4)


def test_sun_fades_to_the_horizon_and_the_moon_comes_in_by_its_own_colour() -> None:
    sines = np.linspace(-0.3, 0.3, 601)
    direct = np.array([by_sine(one).strength * np.array(by_sine(one).colour) for one in sines])
    assert np.abs(np.diff(direct, axis=0)).max() < 0.03
    assert direct[300] == pytest.approx(0.0, abs=1e-9)
    just_set, night = by_sine(-0.03), by_sine(-0.3)
    assert just_set.colour == night.colour
    assert 0.0 < just_set.strength < 0.5 * night.strength
