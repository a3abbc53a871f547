"""What EXIF says about the camera: orientation and focal length.

The focal length is what EXIF states as 35 mm equivalent; or else follows from the true one and the
resolution of the sensor; or from the true one and the size of the sensor, which the table of
cameras knows.

Tags are named after Exif 2.32 (CIPA DC-008). Every value is a claim of a stranger: it is taken
only where it is a finite number in the range of real cameras.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from PIL import Image
from PIL.ExifTags import IFD, Base

from veduta.imaging.sensors import Sensor, sensor_of

FULL_FRAME_DIAGONAL_MM = math.hypot(36.0, 24.0)
"""The 35 mm equivalent focal length keeps the diagonal angle of view (CIPA DCG-001)."""

_MM_PER_UNIT = {2: 25.4, 3: 10.0, 4: 1.0, 5: 0.001}
_FOCAL_MM35_RANGE = (4.0, 2000.0)
_FOCAL_MM_RANGE = (0.5, 5000.0)
_CROP_TOLERANCE = 0.02
_ZOOMED = 1.01
"""From here on the digital zoom has cut the picture out of the sensor's."""

FocalSource = Literal["stated", "focal-plane", "camera-table"]
"""Where a focal length is from."""


@dataclass(frozen=True)
class CameraTags:
    """Orientation 1..8 and the focal length; `notes` says why a stated one is not used."""

    orientation: int = 1
    focal_mm35: float | None = None
    focal_source: FocalSource | None = None
    notes: tuple[str, ...] = ()


def focal_px_from_mm35(focal_mm35: float, width_px: int, height_px: int) -> float:
    """Focal length in pixels of an uncropped image from its 35 mm equivalent."""
    return focal_mm35 * math.hypot(width_px, height_px) / FULL_FRAME_DIAGONAL_MM


def read_camera_tags(image: Image.Image) -> CameraTags:
    """Orientation and focal length of an opened image, before the orientation is applied."""
    exif = image.getexif()
    orientation = exif.get(Base.Orientation, 1)
    if orientation not in range(1, 9):
        orientation = 1
    tags = exif.get_ifd(IFD.Exif)
    names = str(exif.get(Base.Make, "")), str(exif.get(Base.Model, ""))
    found = _Claims()
    source: FocalSource = "stated"
    focal_mm35 = found.taken(tags, Base.FocalLengthIn35mmFilm, _FOCAL_MM35_RANGE)
    focal_mm = found.taken(tags, Base.FocalLength, _FOCAL_MM_RANGE)
    if focal_mm35 is None and focal_mm is not None:
        source = "focal-plane"
        focal_mm35 = _mm35_from_focal_plane(tags, focal_mm, image.size)
    if focal_mm35 is None and focal_mm is not None:
        source = "camera-table"
        focal_mm35 = _mm35_from_table(names, tags, focal_mm, image.size)
    if focal_mm35 is None:
        return CameraTags(orientation=orientation, notes=tuple(found.notes))
    if _was_cropped(tags, image.size):
        note = "the photo was cropped after it was taken: its EXIF focal length is not used"
        return CameraTags(orientation=orientation, notes=(*found.notes, note))
    return CameraTags(orientation, focal_mm35, source, tuple(found.notes))


@dataclass
class _Claims:
    """Numbers of a stranger; `notes` names those that cannot be true."""

    notes: list[str] = field(default_factory=list)

    def taken(
        self, tags: dict[int, object], tag: Base, bounds: tuple[float, float]
    ) -> float | None:
        """The value in its range; 0 is how EXIF says that it is not known."""
        value = _number(tags.get(tag))
        if value is None:
            return None
        if bounds[0] <= value <= bounds[1]:
            return value
        self.notes.append(f"EXIF says {tag.name} {value:g} mm, which cannot be true: not used")
        return None


def _mm35_from_focal_plane(
    tags: dict[int, object], focal_mm: float, size_px: tuple[int, int]
) -> float | None:
    """35 mm equivalent from FocalLength and FocalPlaneXResolution.

    The resolution counts pixels of the image as the camera wrote it (PixelXDimension), which may
    have been scaled since: only the sensor's diagonal is taken from it.
    """
    per_unit = _number(tags.get(Base.FocalPlaneXResolution))
    unit_mm = _MM_PER_UNIT.get(int(_number(tags.get(Base.FocalPlaneResolutionUnit)) or 2))
    if per_unit is None or unit_mm is None:
        return None
    width_px = _number(tags.get(Base.ExifImageWidth)) or float(size_px[0])
    height_px = _number(tags.get(Base.ExifImageHeight)) or float(size_px[1])
    diagonal_mm = math.hypot(width_px, height_px) * unit_mm / per_unit
    if not 2.0 <= diagonal_mm <= 100.0:
        return None
    return _in_range(focal_mm * FULL_FRAME_DIAGONAL_MM / diagonal_mm)


def _mm35_from_table(
    names: tuple[str, str], tags: dict[int, object], focal_mm: float, size_px: tuple[int, int]
) -> float | None:
    """35 mm equivalent from FocalLength and the size of the sensor of this make and model."""
    sensor = sensor_of(*names, focal_mm)
    zoom = _number(tags.get(Base.DigitalZoomRatio)) or 1.0
    if sensor is None or zoom > _ZOOMED:
        return None
    focal_px = focal_mm * _px_per_mm(sensor, size_px)
    return _in_range(focal_px * FULL_FRAME_DIAGONAL_MM / math.hypot(*size_px))


def _px_per_mm(sensor: Sensor, size_px: tuple[int, int]) -> float:
    """Pixels per millimetre of the sensor.

    A camera that writes another aspect than its sensor's leaves out two edges, and so has the
    full length of the other side.
    """
    return max(max(size_px) / sensor.width_mm, min(size_px) / sensor.height_mm)


def _was_cropped(tags: dict[int, object], size_px: tuple[int, int]) -> bool:
    """True when the camera's own size has another aspect than the image (in either posture)."""
    width_px = _number(tags.get(Base.ExifImageWidth))
    height_px = _number(tags.get(Base.ExifImageHeight))
    if width_px is None or height_px is None:
        return False
    taken = max(width_px, height_px) / min(width_px, height_px)
    now = max(size_px) / min(size_px)
    return abs(taken / now - 1.0) > _CROP_TOLERANCE


def _number(value: object) -> float | None:
    """A positive finite number, or None for anything else that a file may carry."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        return None
    return number if math.isfinite(number) and number > 0 else None


def _in_range(focal_mm35: float | None) -> float | None:
    low, high = _FOCAL_MM35_RANGE
    return focal_mm35 if focal_mm35 is not None and low <= focal_mm35 <= high else None
