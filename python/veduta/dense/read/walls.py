"""The walls of a result of `veduta photos`, whose elevations get their depth."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from veduta.dense.document import Elevation
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

WALLS = "walls.json"
MOST_BYTES = 50_000_000
MOST_PIXELS = 100_000_000


class _Record(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False)


class _Picture(_Record):
    units_per_px: float = Field(gt=0)
    width_px: int = Field(gt=0, le=65_500)
    height_px: int = Field(gt=0, le=65_500)
    left: float
    upper: float


class _Wall(_Record):
    id: str = Field(pattern=r"^[A-Za-z0-9_-]{1,64}$")
    start: tuple[float, float]
    end: tuple[float, float]
    height: float = Field(gt=0)
    outward: tuple[float, float]
    picture: _Picture | None = None


class _Walls(_Record):
    walls: list[_Wall]


def read_elevations(folder: Path) -> list[Elevation]:
    """The walls with a picture of the result in a folder; none where it has no `walls.json`.

    InputError where that file cannot be read.
    """
    path = folder / WALLS
    if not path.is_file():
        return []
    require_file(path, MOST_BYTES)
    try:
        found = _Walls.model_validate_json(path.read_bytes())
    except ValidationError as error:
        fault = f"is no file of walls ({error.error_count()} faults)"
        raise InputError(path, fault, "Run `veduta photos` again into this folder.") from None
    return [made for one in found.walls if (made := _elevation(one)) is not None]


def _elevation(wall: _Wall) -> Elevation | None:
    picture = wall.picture
    start, end = np.array([*wall.start, 0.0]), np.array([*wall.end, 0.0])
    length, across = np.linalg.norm(end - start), np.hypot(*wall.outward)
    if picture is None or length == 0.0 or across == 0.0:
        return None
    if picture.width_px * picture.height_px > MOST_PIXELS:
        return None
    return Elevation(
        id=wall.id,
        start_m=start,
        along=(end - start) / length,
        outward=np.array([*wall.outward, 0.0]) / across,
        left_m=picture.left,
        upper_m=picture.upper,
        pixel_m=picture.units_per_px,
        shape=(picture.height_px, picture.width_px),
        height_m=wall.height,
    )
