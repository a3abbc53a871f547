"""The wall of an existing building that a front is put on, as the document keeps it."""

from __future__ import annotations

import math
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, model_validator

Vector = tuple[float, float, float]
Near = Annotated[float, Field(ge=-1e6, le=1e6)]
Far = Annotated[float, Field(ge=-1e8, le=1e8)]
"""Of a CRS: its origin may be far off, and a wall is not far from it (m)."""
NARROWEST_M = 0.5
"""No front is narrower (m)."""
WIDER_M = 0.05
"""A front that reaches so far beyond its wall, or ends so far before its ends, is told (m)."""


class Wall(BaseModel):
    """An edge of a footprint: metres from `origin_m` in `crs`, x east, y north, z up.

    Seen from outside the wall goes from left to right from `start_m` to `end_m`; the building lies
    behind it.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    footprint: str = Field(description="file name")
    lot: str = Field(description="name of the polygon")
    edge: int = Field(ge=0, description="counter-clockwise; 0 joins the first two corners")
    start_m: tuple[Near, Near, Near]
    end_m: tuple[Near, Near, Near]
    depth_m: float = Field(gt=0, le=1e6, description="mean depth of the footprint behind the edge")
    overlap: float = Field(
        ge=0, le=1, description="of footprint and body: intersection over union of their areas"
    )
    crs: str | None = Field(default=None, description="EPSG code, null where it is not known")
    origin_m: tuple[Far, Far, Far] = (0.0, 0.0, 0.0)
    chosen: str = Field(description="why this edge, in words")

    @model_validator(mode="after")
    def _is_wide(self) -> Self:
        if self.width_m < NARROWEST_M:
            raise ValueError(f"a wall is at least {NARROWEST_M:g} m wide")
        return self

    @property
    def width_m(self) -> float:
        """Length of the edge on the ground."""
        return math.dist(self.start_m[:2], self.end_m[:2])

    @property
    def told(self) -> str:
        """Which wall it is, and why, in a line."""
        return (
            f"edge {self.edge} of {self.lot} in {self.footprint}, {self.width_m:.2f} m wide,"
            f" {facing(self.start_m, self.end_m)}: {self.chosen}"
        )

    def world_from_part(self, front_m: float) -> NDArray[np.float64]:
        """(4, 4) the placement of a building whose front is so wide (m), in the wall's middle.

        The part's frame: x right along the front from its left end, y into the body, z up.
        """
        start, end = np.array(self.start_m), np.array(self.end_m)
        along = (end - start)[:2] / self.width_m
        matrix = np.eye(4)
        matrix[:2, 0] = along
        matrix[:2, 1] = -along[1], along[0]
        matrix[:2, 3] = start[:2] + 0.5 * (self.width_m - front_m) * along
        matrix[2, 3] = start[2]
        return matrix

    def notes(self, front_m: float, depth_m: float, *, is_scaled: bool) -> list[str]:
        """What was chosen: the wall, the front's width (m) on it, the depth (m) of the body.

        is_scaled: whether the wall gave the scale.
        """
        said = [f"wall: {self.told}"]
        if is_scaled:
            said.append("wall: it gives the scale, for no other is given: the front is as wide")
        elif front_m > self.width_m + WIDER_M:
            said.append(f"wall: the front is {front_m:.2f} m wide and reaches beyond both its ends")
        elif front_m < self.width_m - WIDER_M:
            said.append(f"wall: the front is {front_m:.2f} m wide and stands in its middle")
        if not math.isclose(depth_m, self.depth_m, abs_tol=1e-6):
            said.append(
                f"wall: the body is {depth_m:.2f} m deep as asked; behind the edge the footprint"
                f" is {self.depth_m:.2f} m deep in the mean"
            )
            return said
        said.append(
            f"wall: the body is a box {depth_m:.2f} m deep, the footprint's mean behind the edge;"
            f" behind the whole edge it and the footprint overlap by {100 * self.overlap:.0f} %"
        )
        return said


def facing(start_m: Vector, end_m: Vector) -> str:
    """Where a wall looks, as one of eight directions."""
    east, north = end_m[1] - start_m[1], start_m[0] - end_m[0]
    names = (
        "east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east",
    )  # fmt: skip
    return f"facing {names[round(math.atan2(north, east) / (math.pi / 4)) % 8]}"
