"""Camera, time and place from EXIF: written by Pillow, and by nobody sane."""

from __future__ import annotations

import io
from datetime import datetime
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from PIL.ExifTags import GPS, IFD, Base
from PIL.TiffImagePlugin import IFDRational

from veduta.imaging.shot import Position, Shot, read_shot


def shot_of(
    root: dict[int, Any] | None = None,
    tags: dict[int, Any] | None = None,
    gps: dict[int, Any] | None = None,
) -> Shot:
    exif = Image.Exif()
    exif.update(root or {})
    exif.get_ifd(IFD.Exif).update(tags or {})
    exif.get_ifd(IFD.GPSInfo).update(gps or {})
    file = io.BytesIO()
    Image.new("RGB", (8, 8)).save(file, format="JPEG", exif=exif)
    with Image.open(io.BytesIO(file.getvalue())) as image:
        return read_shot(image)


def gps(latitude: Any, longitude: Any, north: str = "N", east: str = "E") -> dict[int, Any]:
    return {
        GPS.GPSLatitudeRef: north,
        GPS.GPSLatitude: latitude,
        GPS.GPSLongitudeRef: east,
        GPS.GPSLongitude: longitude,
    }


def test_an_ordinary_photo() -> None:
    place = gps((48.0, 51.0, 29.6), (2.0, 17.0, 40.2))
    shot = shot_of(
        {Base.Make: "NIKON CORPORATION", Base.Model: "NIKON D60\0 "},
        {Base.DateTimeOriginal: "2011:05:02 17:24:14"},
        place | {GPS.GPSAltitude: 35.5, GPS.GPSAltitudeRef: b"\x00"},
    )
    assert shot.camera == "NIKON CORPORATION NIKON D60"
    assert shot.time == datetime(2011, 5, 2, 17, 24, 14)
    assert shot.position is not None
    assert shot.position.latitude_deg == pytest.approx(48.858222, abs=1e-6)
    assert shot.position.longitude_deg == pytest.approx(2.294500, abs=1e-6)
    assert shot.position.altitude_m == 35.5


def test_south_west_and_below_the_sea() -> None:
    place = gps((33.0, 30.0, 0.0), (70.0, 15.0, 0.0), "S", "W")
    below = {GPS.GPSAltitude: 12.0, GPS.GPSAltitudeRef: b"\x01"}
    assert shot_of(gps=place | below).position == Position(-33.5, -70.25, -12.0)


def test_nothing_is_told() -> None:
    assert shot_of() == Shot()


@pytest.mark.parametrize(
    "place",
    [
        gps((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        gps((91.0, 0.0, 0.0), (2.0, 0.0, 0.0)),
        gps((48.0, 0.0, 0.0), (181.0, 0.0, 0.0)),
        gps((IFDRational(0, 0), 0.0, 0.0), (2.0, 0.0, 0.0)),
        gps((48.0, 0.0, 0.0), (2.0, 0.0, 0.0), north="up"),
        {GPS.GPSLatitude: (48.0, 51.0, 29.6)},
    ],
)
def test_a_position_that_cannot_be(place: dict[int, Any]) -> None:
    shot = shot_of(gps=place)
    assert shot.position is None
    assert len(shot.notes) == 1
    assert "GPS position" in shot.notes[0]


@pytest.mark.parametrize("text", ["0000:00:00 00:00:00", "yesterday", "2011:13:40 17:24:14", ""])
def test_a_time_that_cannot_be(text: str) -> None:
    assert shot_of(tags={Base.DateTimeOriginal: text}).time is None


def test_an_altitude_that_cannot_be() -> None:
    place = gps((48.0, 0.0, 0.0), (2.0, 0.0, 0.0)) | {GPS.GPSAltitude: 99_000.0}
    shot = shot_of(gps=place)
    assert shot.position == Position(48.0, 2.0, None)
    assert "altitude" in shot.notes[0]


@given(
    latitude=st.floats(-89.9, 89.9).filter(lambda value: abs(value) > 0.01),
    longitude=st.floats(-179.9, 179.9),
)
def test_degrees_minutes_and_seconds(latitude: float, longitude: float) -> None:
    def parts(value: float) -> tuple[float, float, float]:
        minutes = abs(value) % 1 * 60
        return (float(int(abs(value))), float(int(minutes)), minutes % 1 * 60)

    place = gps(
        parts(latitude),
        parts(longitude),
        "N" if latitude >= 0 else "S",
        "E" if longitude >= 0 else "W",
    )
    found = shot_of(gps=place).position
    assert found is not None
    assert found.latitude_deg == pytest.approx(latitude, abs=1e-5)
    assert found.longitude_deg == pytest.approx(longitude, abs=1e-5)
