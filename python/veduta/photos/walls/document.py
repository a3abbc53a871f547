"""`walls.json`: the walls that the points of a model speak for, and where their pictures lie."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from veduta.photos.structure import Structure
from veduta.photos.walls.pictures import WallPicture
from veduta.photos.walls.wall import Wall

WALLS = "walls"
"""The folder of the pictures."""
Unit = Literal["metres", "unknown"]
Finite = Annotated[float, Field(allow_inf_nan=False)]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class WallPictureRecord(_Record):
    """A metric picture: row 0 at the top, column 0 at the left of one who looks at the wall."""

    file: str = Field(description="PNG with alpha, relative to walls.json; transparent: not seen")
    units_per_px: float = Field(gt=0, description="side of a pixel, along the wall and upwards")
    width_px: int = Field(gt=0)
    height_px: int = Field(gt=0)
    left: Finite = Field(description="left border of the picture, from `start` along the wall")
    upper: Finite = Field(description="height of the picture's upper border")
    seen: float = Field(ge=0, le=1, description="share of its pixels that a photo shows")
    photos: list[str] = Field(description="the photos that it is made of")


class WallRecord(_Record):
    """An upright rectangle; one who looks at it from outside has `start` at the left."""

    id: str
    start: tuple[Finite, Finite]
    end: tuple[Finite, Finite]
    bottom: Finite
    top: Finite
    outward: tuple[Finite, Finite] = Field(description="unit normal, to the side it is seen from")
    width: float = Field(gt=0)
    height: float = Field(gt=0)
    points: int = Field(ge=0, description="points on it")
    rms: float = Field(ge=0, description="of the points' distances from its plane")
    picture: WallPictureRecord | None = None


class WallsDocument(_Record):
    """All walls, that with most points first, in the frame of place.json; z is up."""

    schema_: Literal["veduta/walls"] = Field(default="veduta/walls", alias="schema")
    version: Literal[1] = 1
    unit: Unit = Field(description="of all lengths; unknown: any, as in place.json")
    walls: list[WallRecord]


def walls_document(
    walls: Sequence[Wall], pictures: Sequence[WallPicture], structure: Structure, unit: Unit
) -> WallsDocument:
    """The document of walls and their pictures, which come in the same order."""
    return WallsDocument(
        unit=unit,
        walls=[
            _record(wall, _picture(picture, structure))
            for wall, picture in zip(walls, pictures, strict=True)
        ],
    )


def picture_file(wall: Wall) -> str:
    """Where a wall's picture lies in OUT."""
    return f"{WALLS}/{wall.id}.png"


def _record(wall: Wall, picture: WallPictureRecord) -> WallRecord:
    return WallRecord(
        id=wall.id,
        start=(float(wall.start[0]), float(wall.start[1])),
        end=(float(wall.end[0]), float(wall.end[1])),
        bottom=wall.bottom,
        top=wall.top,
        outward=(float(wall.outward[0]), float(wall.outward[1])),
        width=wall.width,
        height=wall.height,
        points=len(wall.point_rows),
        rms=wall.rms,
        picture=picture,
    )


def _picture(picture: WallPicture, structure: Structure) -> WallPictureRecord:
    grid = picture.grid
    return WallPictureRecord(
        file=picture_file(grid.wall),
        units_per_px=grid.pixel,
        width_px=grid.width_px,
        height_px=grid.height_px,
        left=grid.left,
        upper=grid.upper,
        seen=picture.seen,
        photos=[structure.names[row] for row in picture.photos],
    )
