"""The elevation with depth that `veduta dense` writes of a wall, and whether it is of this photo.

A pixel of it is the pixel of the wall's picture, so that the front must be read from that picture
(`walls/ID.png` of `veduta photos`).
"""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from veduta.facade.document import Rectification
from veduta.facade.measured_depths import Elevation
from veduta.geometry import homography
from veduta.imaging.read import DAMAGE, image_size
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

MOST_BYTES = 1_000_000_000
MOST_SIDECAR_BYTES = 100_000
_AGAIN = "Give the walls/ID_depth.tif of `veduta dense`, with the ID_depth.json beside it."


class _Sidecar(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False)

    schema_: Literal["veduta/elevation"] = Field(alias="schema")
    version: Literal[1]
    unit: str
    wall: str = Field(max_length=64)
    units_per_px: float = Field(gt=0)
    cell_px: int = Field(default=1, ge=1, le=100_000)
    detail: float = Field(default=0.0, ge=0, le=1000)


def of_photo(path: Path, photo: Path) -> Elevation:
    """The depth map, checked against the photo that the front is read from.

    InputError where it cannot be read, lies in no metres, or is another wall's or another size's.
    """
    told = _sidecar(path)
    if told.unit != "metres":
        raise InputError(
            path,
            "has depths in a unit that is not known in metres",
            "Run `veduta dense` again with --metres-per-unit, and give its depth map.",
        )
    if photo.stem != told.wall:
        raise InputError(
            path,
            f"is of wall {told.wall}, and the photo is {photo.name}",
            f"Give the photo {told.wall}.png of the same walls/, or {photo.stem}_depth.tif.",
        )
    size, pictured = image_size(path), image_size(photo)
    if size != pictured:
        raise InputError(
            path,
            f"is {size[0]} x {size[1]} px, and the photo {pictured[0]} x {pictured[1]} px",
            "Both must be of one run of `veduta photos`: make the depth map again from it.",
        )
    return Elevation(
        wall=told.wall,
        metres_per_px=told.units_per_px,
        detail_m=max(told.detail, told.cell_px * told.units_per_px),
        width_px=size[0],
        height_px=size[1],
        sha256=file_digest(path),
    )


def read_depths(path: Path, elevation: Elevation) -> NDArray[np.float32]:
    """(h, w) metres out of the wall's plane, NaN where unknown; InputError where damaged."""
    try:
        with Image.open(path, formats=("TIFF",)) as image:
            if image.mode != "F":
                fault = "has no depths: its pixels are no 32 bit floating point numbers"
                raise InputError(path, fault, _AGAIN)
            depths = np.asarray(image, dtype=np.float32)
    except DAMAGE as error:
        raise InputError(path, f"cannot be read ({error})", _AGAIN) from error
    if depths.shape != (elevation.height_px, elevation.width_px):
        raise InputError(path, "has changed since it was looked at", "Start the call again.")
    return np.where(np.isfinite(depths), depths, np.float32(np.nan))


def metres_per_px(elevation: Elevation | None, record: Rectification) -> float | None:
    """Metres per pixel of the rectified photo, in its middle; None without a depth map."""
    if elevation is None:
        return None
    source_from_rectified = homography.inverse(
        np.array(record.rectified_from_source, dtype=np.float64)
    )
    middle = np.array([[record.width_px / 2, record.height_px / 2]])
    area = float(np.abs(homography.area_scale(source_from_rectified, middle))[0])
    return elevation.metres_per_px * float(np.sqrt(area))


def _sidecar(path: Path) -> _Sidecar:
    beside = path.with_suffix(".json")
    try:
        require_file(path, MOST_BYTES)
        require_file(beside, MOST_SIDECAR_BYTES)
        return _Sidecar.model_validate_json(beside.read_bytes())
    except FileNotFoundError as error:
        missing = Path(error.filename or path)
        fault = "does not exist"
        if missing.suffix == ".json":
            fault += f", so nothing says where and how large the wall of {path.name} is"
        raise InputError(missing, fault, _AGAIN) from error
    except ValidationError as error:
        fault = f"does not describe an elevation ({error.error_count()} faults)"
        raise InputError(beside, fault, _AGAIN) from error
