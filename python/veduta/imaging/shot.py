"""What EXIF says of the taking of a photo: with which camera, when, and where.

Tags are named after Exif 2.32 (CIPA DC-008). Every value is a claim of a stranger: it is taken
only where it can be true.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime

from PIL import Image
from PIL.ExifTags import GPS, IFD, Base

_TEXT = re.compile(r"[^\x20-\x7e]+")
_LONGEST_TEXT = 80
_LONGEST_XMP = 1 << 20
_PITCH = re.compile(rb"GimbalPitchDegree\s*(?:=\s*[\"']|>)\s*([+-]?\d{1,3}(?:\.\d{1,9})?)")
_TIME = "%Y:%m:%d %H:%M:%S"
_HIGHEST_M, _LOWEST_M = 10_000.0, -500.0


@dataclass(frozen=True)
class Position:
    """Where a photo was taken, by GPS: degrees in WGS 84, and metres above the sea where told."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None = None


@dataclass(frozen=True)
class Shot:
    """The camera (make and model), the local time and the position; None where nothing is told.

    pitch_deg: how far the camera looked up, from the gimbal of an aircraft; -90 is straight down.
    notes: what is told and cannot be true.
    """

    camera: str | None = None
    time: datetime | None = None
    position: Position | None = None
    pitch_deg: float | None = None
    notes: tuple[str, ...] = ()


def read_shot(image: Image.Image) -> Shot:
    """What the EXIF block of an opened image says; nothing of it where it cannot be true."""
    exif = image.getexif()
    words = [_text(exif.get(Base.Make)), _text(exif.get(Base.Model))]
    tags = exif.get_ifd(IFD.Exif)
    time = _time(tags.get(Base.DateTimeOriginal)) or _time(exif.get(Base.DateTime))
    place = exif.get_ifd(IFD.GPSInfo)
    position = _position(place)
    notes = []
    if position is None and place.get(GPS.GPSLatitude) is not None:
        notes.append("EXIF gives a GPS position that cannot be true: not used")
    if position is not None and position.altitude_m is None and _number(place.get(GPS.GPSAltitude)):
        notes.append("EXIF gives a GPS altitude that cannot be true: not used")
    return Shot(
        camera=" ".join(word for word in words if word) or None,
        time=time,
        position=position,
        pitch_deg=_pitch(image),
        notes=tuple(notes),
    )


def _pitch(image: Image.Image) -> float | None:
    """By the XMP that aircraft write beside EXIF."""
    packet = image.info.get("xmp")
    if not isinstance(packet, bytes):
        return None
    found = _PITCH.search(packet[:_LONGEST_XMP])
    pitch = None if found is None else _number(found[1].decode("ascii"))
    return pitch if pitch is not None and -90.5 <= pitch <= 90.0 else None


def _text(value: object) -> str:
    return _TEXT.sub(" ", value).strip()[:_LONGEST_TEXT] if isinstance(value, str) else ""


def _time(value: object) -> datetime | None:
    try:
        return datetime.strptime(_text(value), _TIME)
    except ValueError:
        return None


def _position(tags: Mapping[int, object]) -> Position | None:
    latitude = _degrees(tags.get(GPS.GPSLatitude), tags.get(GPS.GPSLatitudeRef), "NS", 90.0)
    longitude = _degrees(tags.get(GPS.GPSLongitude), tags.get(GPS.GPSLongitudeRef), "EW", 180.0)
    # Receivers without a fix write zeros: a point in the sea, where few buildings stand.
    if latitude is None or longitude is None or (latitude == 0.0 and longitude == 0.0):
        return None
    return Position(latitude, longitude, _altitude(tags))


def _degrees(value: object, side: object, sides: str, most: float) -> float | None:
    """Degrees, minutes and seconds with the half of the globe, as a signed number."""
    if not isinstance(value, tuple) or not 1 <= len(value) <= 3:
        return None
    parts = [_number(part) for part in value]
    letter = _text(side)[:1].upper()
    if None in parts or letter not in sides or not letter:
        return None
    degrees = math.fsum(part / 60**power for power, part in enumerate(parts) if part is not None)
    if not 0.0 <= degrees <= most:
        return None
    return degrees if letter == sides[0] else -degrees


def _altitude(tags: Mapping[int, object]) -> float | None:
    height = _number(tags.get(GPS.GPSAltitude))
    if height is None:
        return None
    below = tags.get(GPS.GPSAltitudeRef) in (1, b"\x01")
    height = -height if below else height
    return height if _LOWEST_M <= height <= _HIGHEST_M else None


def _number(value: object) -> float | None:
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        return None
    return number if math.isfinite(number) else None
