"""`drive.toml`: what a log's scanners and camera are, and where its tables lie."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]
Matrix = Annotated[tuple[Finite, ...], Field(min_length=12, max_length=12)]
Table = Annotated[str, Field(min_length=1, max_length=256, pattern=r"^[^/\\.][^\\]*$")]
_IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Scanner(_Record):
    """A 2D scanner. Beam i points along (cos a, sin a, 0) of its frame, a = first + i * step.

    table: Parquet with `time_s` and `ranges_m` (list of floats; 0 or NaN: nothing came back).
    """

    table: Table
    vehicle_from_scanner: Matrix = Field(
        description="3x4 by rows; the vehicle has x forward, y left, z up"
    )
    first_beam_rad: Finite
    beam_step_rad: Annotated[Finite, Field(gt=0.0, le=0.5)]
    nearest_m: Annotated[Finite, Field(ge=0.0)] = 0.5
    farthest_m: Annotated[Finite, Field(gt=0.0)] = 80.0
    clock_offset_s: Finite = Field(
        default=0.0, description="is added to its times to get those of the path"
    )


class CameraMount(_Record):
    """The camera. table: Parquet with `time_s` and `file` (beside drive.toml)."""

    table: Table
    vehicle_from_camera: Matrix = Field(description="3x4 by rows; x right, y down, z forward")
    width_px: int = Field(gt=0, le=100_000)
    height_px: int = Field(gt=0, le=100_000)
    focal_px: tuple[Finite, Finite]
    centre_px: tuple[Finite, Finite]
    clock_offset_s: Finite = 0.0


class PathTable(_Record):
    """Poses that came with the log. table: Parquet with `time_s`, `matrix` (12 floats by rows)."""

    table: Table
    frame: Literal["world_from_vehicle"] = "world_from_vehicle"


class DriveLog(_Record):
    """All of `drive.toml`. World: z up, metres from `origin` in `crs`."""

    name: str = Field(default="drive", max_length=256)
    crs: str | None = Field(default=None, description="EPSG:code of the path's coordinates")
    vertical_datum: str | None = Field(default=None, max_length=256)
    origin: tuple[Finite, Finite, Finite] = (0.0, 0.0, 0.0)
    vertical: Scanner
    horizontal: Scanner | None = None
    camera: CameraMount | None = None
    path: PathTable | None = None
