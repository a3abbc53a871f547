"""What EXIF says about the camera: orientation and focal length.

Tags are named after Exif 2.32 (CIPA DC-008). Every value is a claim of a stranger: it is taken
only where it is a finite number in the range of real cameras.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from PIL import Image
from PIL.ExifTags import IFD, Base

FULL_FRAME_DIAGONAL_MM = math.hypot(36.0, 24.0)
"""The 35 mm equivalent focal length keeps the diagonal angle of view (CIPA DCG-001)."""

_MM_PER_UNIT = {2: 25.4, 3: 10.0, 4: 1.0, 5: 0.001}
_FOCAL_MM35_RANGE = (4.0, 2000.0)
_CROP_TOLERANCE = 0.02


@dataclass(frozen=True)
class CameraTags:
    """Orientation 1..8 and the focal length; `notes` says why a stated one is not used."""

    orientation: int = 1
    focal_mm35: float | None = None
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
    focal_mm35 = _stated_mm35(tags)
    if focal_mm35 is None:
        focal_mm35 = _mm35_from_focal_plane(tags, image.size)
    if focal_mm35 is None:
        return CameraTags(orientation=orientation)
    if _was_cropped(tags, image.size):
        note = "the photo was cropped after it was taken: its EXIF focal length is not used"
        return CameraTags(orientation=orientation, notes=(note,))
    return CameraTags(orientation=orientation, focal_mm35=focal_mm35)


def _stated_mm35(tags: dict[int, object]) -> float | None:
    return _in_range(_number(tags.get(Base.FocalLengthIn35mmFilm)))


def _mm35_from_focal_plane(tags: dict[int, object], size_px: tuple[int, int]) -> float | None:
    """35 mm equivalent from FocalLength and FocalPlaneXResolution.

    The resolution counts pixels of the image as the camera wrote it (PixelXDimension), which may
    have been scaled since: only the sensor's diagonal is taken from it.
    """
    focal_mm = _number(tags.get(Base.FocalLength))
    per_unit = _number(tags.get(Base.FocalPlaneXResolution))
    unit_mm = _MM_PER_UNIT.get(int(_number(tags.get(Base.FocalPlaneResolutionUnit)) or 2))
    if focal_mm is None or per_unit is None or unit_mm is None:
        return None
    width_px = _number(tags.get(Base.ExifImageWidth)) or float(size_px[0])
    height_px = _number(tags.get(Base.ExifImageHeight)) or float(size_px[1])
    diagonal_mm = math.hypot(width_px, height_px) * unit_mm / per_unit
    if not 2.0 <= diagonal_mm <= 100.0:
        return None
    return _in_range(focal_mm * FULL_FRAME_DIAGONAL_MM / diagonal_mm)


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
