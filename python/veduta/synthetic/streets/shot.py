"""The file that a camera with a receiver writes: a JPEG with its EXIF."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from io import BytesIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.ExifTags import GPS, IFD, Base
from PIL.TiffImagePlugin import IFDRational

MAKE = "Veduta"


@dataclass(frozen=True)
class ShotTags:
    """What EXIF is to say; None leaves a thing out.

    gps: latitude and longitude (degrees) and height above the sea (m).
    """

    model: str
    time: datetime
    focal_mm35: float | None
    gps: tuple[float, float, float] | None


def shot_jpeg(pixels: NDArray[np.uint8], tags: ShotTags, quality: int) -> bytes:
    """The bytes of the file; the focal length in whole millimetres, as the standard has it."""
    exif = Image.Exif()
    exif[Base.Make], exif[Base.Model] = MAKE, tags.model
    own = exif.get_ifd(IFD.Exif)
    own[Base.DateTimeOriginal] = tags.time.strftime("%Y:%m:%d %H:%M:%S")
    if tags.focal_mm35 is not None:
        own[Base.FocalLengthIn35mmFilm] = round(tags.focal_mm35)
    if tags.gps is not None:
        tag_position(exif, *tags.gps)
    buffer = BytesIO()
    Image.fromarray(pixels).save(buffer, "JPEG", quality=quality, subsampling=0, exif=exif)
    return buffer.getvalue()


def tag_position(exif: Image.Exif, latitude: float, longitude: float, height: float) -> None:
    """Write a position (degrees, WGS 84; m) into a photo's EXIF, to 3 mm and 1 cm."""
    where = exif.get_ifd(IFD.GPSInfo)
    where[GPS.GPSLatitudeRef] = "N" if latitude >= 0 else "S"
    where[GPS.GPSLatitude] = _sexagesimal(abs(latitude))
    where[GPS.GPSLongitudeRef] = "E" if longitude >= 0 else "W"
    where[GPS.GPSLongitude] = _sexagesimal(abs(longitude))
    where[GPS.GPSAltitudeRef] = b"\x00" if height >= 0 else b"\x01"
    where[GPS.GPSAltitude] = IFDRational(round(abs(height) * 100), 100)


def _sexagesimal(degrees: float) -> tuple[IFDRational, IFDRational, IFDRational]:
    """Degrees, minutes and seconds to a ten thousandth (3 mm)."""
    ticks = round(degrees * 3600 * 10_000)
    minutes, seconds = divmod(ticks, 600_000)
    whole, minutes = divmod(minutes, 60)
    return IFDRational(whole, 1), IFDRational(minutes, 1), IFDRational(seconds, 10_000)
