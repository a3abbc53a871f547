"""`drive.json`: the path that was driven, its segments, and what was corrected."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

VERSION = 1
Finite = Annotated[float, Field(allow_inf_nan=False)]
Point = tuple[Finite, Finite, Finite]
Fate = Literal["build", "as-is", "leave-out"]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class PathPose(_Record):
    """Where the scanner was. sweep: name of the scan; matrix: world_from_sensor, 3x4 by rows."""

    sweep: str = Field(max_length=256)
    time_s: Finite
    matrix: tuple[Finite, ...] = Field(min_length=12, max_length=12)


class Correction(_Record):
    """What was changed of the path, and why."""

    sweep: str = Field(max_length=256)
    moved_m: Point
    reason: str = Field(max_length=1000)


class DriveSegment(_Record):
    """A quasi-linear piece of the path, looked at to one side."""

    id: str = Field(min_length=1, max_length=64)
    side: Literal["left", "right"]
    line: list[Point] = Field(
        min_length=2, max_length=100_000,
        description="where the virtual scanner stands, equally spaced (m, world)",
    )  # fmt: skip
    fate: Fate = Field(
        default="build",
        description="build: foreground taken out, holes filled; as-is: meshed as scanned",
    )
    reason: str = Field(max_length=1000, description="why it begins, ends and is treated so")


class DriveDocument(_Record):
    """World: z up, metres from `origin` in `crs`; z = 0 is the road where there is no CRS."""

    schema_: Literal["veduta/drive"] = Field(default="veduta/drive", alias="schema")
    version: Literal[1] = 1
    record: str = Field(description="the log that it was read from, relative or absolute")
    crs: str | None = None
    vertical_datum: str | None = Field(default=None, description="what heights count from")
    origin: Point = (0.0, 0.0, 0.0)
    path_from: str = Field(max_length=1000, description="how the path was found")
    path: list[PathPose] = Field(min_length=1, max_length=1_000_000)
    corrections: list[Correction] = Field(default=[], max_length=1_000_000)
    segments: list[DriveSegment] = Field(max_length=100_000)
    notes: list[str] = Field(default=[], max_length=1000)
