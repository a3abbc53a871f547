"""What a depth map said of a front, as the document keeps it, and what the model takes from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from pydantic import BaseModel, ConfigDict, Field

if TYPE_CHECKING:
    from veduta.facade.document import Element

Metres = Annotated[float, Field(ge=-100.0, le=100.0)]


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Elevation(_Record):
    """A depth map that fits its photo; its pixels are not read yet.

    metres_per_px: of the photo. detail_m: what is smaller is smoothed away in it.
    """

    wall: str
    metres_per_px: float
    detail_m: float
    width_px: int
    height_px: int
    sha256: str


class ClassDepth(_Record):
    """The depths of the elements of one class, out of the wall's surface (m).

    spread_m: 1.4826 times the median deviation of the elements' depths from their median.
    """

    kind: str
    measured: int = Field(ge=0, description="elements with a depth of their own")
    found: int = Field(ge=0, description="elements of the class below the eaves")
    median_m: Metres
    spread_m: Metres


class Ledge(_Record):
    """A cornice or string course: a band of the rectified photo that stands before the wall."""

    y_px: float
    height_px: float
    out_m: Annotated[float, Field(gt=0.0, le=100.0)]
    spread_m: Metres = 0.0


class MeasuredDepths(_Record):
    """known: share of the front's pixels that have a depth. wall_spread_m: of the wall about its
    surface. detail_m: what is smaller is smoothed away in the depth map. The depths of the elements
    are theirs (`depth_m`).
    """

    wall: str = Field(description="the wall of the depth map, by its name in walls.json")
    known: float = Field(ge=0.0, le=1.0)
    wall_spread_m: Metres
    detail_m: Annotated[float, Field(ge=0.0, le=1000.0)] = 0.0
    classes: tuple[ClassDepth, ...] = ()
    ledges: tuple[Ledge, ...] = ()

    def median_m(self, kind: str) -> float | None:
        """The median of a class; None where no element of it was measured."""
        return next((one.median_m for one in self.classes if one.kind == kind), None)


@dataclass(frozen=True)
class Recess:
    """How far an opening lies back, or a balcony juts out (m), and whether that is its own."""

    m: float
    is_measured: bool


def recess(element: Element, depths: MeasuredDepths | None) -> Recess | None:
    """How far an opening lies behind the wall: its own, else its class's median; None unknown.

    What stands before the wall (a bay window) lies 0 behind it.
    """
    found = _depth(element, depths)
    return None if found is None else Recess(max(0.0, -found[0]), found[1])


def projection(element: Element, depths: MeasuredDepths | None) -> Recess | None:
    """How far a balcony juts out: its own, else its class's median; None where unknown."""
    found = _depth(element, depths)
    return None if found is None or found[0] <= 0.0 else Recess(*found)


def _depth(element: Element, depths: MeasuredDepths | None) -> tuple[float, bool] | None:
    if element.depth_m is not None:
        return element.depth_m, True
    median = None if depths is None else depths.median_m(element.class_)
    return None if median is None else (median, False)
