"""`place.json`: the parts of a place, where they stand, and how two places become one."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from veduta.run.errors import InputError

VERSION = 1
IDENTITY: tuple[float, ...] = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)

Finite = Annotated[float, Field(allow_inf_nan=False)]
Vector = tuple[Finite, Finite, Finite]


def _within_folder(path: str) -> str:
    """A manifest comes from outside: it may not reach outside of its folder."""
    parts = PurePosixPath(path).parts
    if not parts or path.startswith("/") or ".." in parts or "\\" in path or ":" in parts[0]:
        raise ValueError(f"{path!r} is not a path below the folder of place.json")
    return path


RelativePath = Annotated[str, Field(min_length=1, max_length=1024), AfterValidator(_within_folder)]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class Bounds(_Record):
    """Axis-parallel box in the part's own frame (m)."""

    min: Vector
    max: Vector


class PlacePart(_Record):
    """One part: its files, relative to place.json, and where it stands."""

    id: str = Field(min_length=1, max_length=256, description="stable: a rebuild keeps it")
    name: str
    model: RelativePath = Field(description="glTF binary")
    city_model: RelativePath | None = Field(default=None, description="CityJSON")
    document: RelativePath | None = Field(default=None, description="what it was built from")
    photo: RelativePath | None = Field(default=None, description="the photo that textures it")
    transform: tuple[Finite, ...] = Field(
        default=IDENTITY,
        min_length=16,
        max_length=16,
        description="world_from_part, 4x4, column-major, metres",
    )
    arrangement: Literal["single", "invented"] = Field(
        description="invented: where it stands relative to the other parts is not known"
    )
    bounds: Bounds
    ground: bool = Field(
        default=False, description="whether it is the ground between the others, on which one walks"
    )

    @model_validator(mode="after")
    def _is_affine(self) -> Self:
        matrix = np.array(self.transform).reshape(4, 4).T
        if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0] or np.linalg.det(matrix[:3, :3]) <= 0.0:
            raise ValueError(f"the transform of part {self.id!r} is no placement in space")
        return self


class Start(_Record):
    """Where a visitor begins (m, world frame)."""

    eye: Vector
    target: Vector


class Place(_Record):
    """The manifest. World frame: x east, y north, z up, metres from `origin` in `crs`."""

    schema_: Literal["veduta/place"] = Field(default="veduta/place", alias="schema")
    version: Literal[1] = 1
    crs: str | None = Field(default=None, description="EPSG code; null where none is known")
    origin: Vector = (0.0, 0.0, 0.0)
    parts: list[PlacePart] = Field(max_length=1_000_000)
    tileset: RelativePath | None = Field(
        default=None,
        description="3D Tiles of all parts together: what is shown where they are too many",
    )
    start: Start

    @model_validator(mode="after")
    def _ids_are_unique(self) -> Self:
        seen: set[str] = set()
        for part in self.parts:
            if part.id in seen:
                raise ValueError(f"two parts have the id {part.id!r}")
            seen.add(part.id)
        return self


def merge(first: Place, second: Place, second_folder: str = "") -> Place:
    """Join two places into one in the frame of the first.

    The rule: both are in the same CRS (or both in none). Parts of the second move by the
    difference of the origins, and their files are looked for below `second_folder`. A part that
    both have under one id is kept once if it is the same in all that it says, and refused
    otherwise: an id names one thing. Parts keep their order, the first place's before the
    second's; the start is the first's.
    """
    if first.crs != second.crs:
        raise InputError(
            "place.json",
            f"the places are in different coordinate systems ({first.crs} and {second.crs})",
            "Bring both into one coordinate system first.",
        )
    shift = np.array(second.origin) - np.array(first.origin)
    parts = {part.id: part for part in first.parts}
    for part in second.parts:
        moved = _moved(part, shift.tolist(), second_folder)
        known = parts.setdefault(moved.id, moved)
        if known != moved:
            raise InputError(
                "place.json",
                f"both places have a part {moved.id!r}, and the two differ",
                "Rename one of them, or remove the one that is out of date.",
            )
    # The tiles of one do not show the other.
    return first.model_copy(update={"parts": list(parts.values()), "tileset": None})


def _moved(part: PlacePart, shift_m: list[float], folder: str) -> PlacePart:
    transform = list(part.transform)
    for axis in range(3):
        transform[12 + axis] += shift_m[axis]
    update: dict[str, object] = {"transform": tuple(transform)}
    for field in ("model", "city_model", "document", "photo"):
        path = getattr(part, field)
        if path is not None and folder:
            update[field] = str(PurePosixPath(folder) / path)
    return PlacePart.model_validate(part.model_dump() | update)
