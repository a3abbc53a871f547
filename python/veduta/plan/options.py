"""The options of `veduta plan`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, field_validator

from veduta.plan.sun import read_time
from veduta.run.options import Options

RoofKind = Literal["auto", "hip", "gable", "pyramid", "mansard", "half-hip", "flat", "none"]
FrameKind = Literal["surround", "bottom", "none"]
LightKind = Literal["ceiling", "wall", "none"]


PAGES = r"^[1-9]\d{0,4}(-[1-9]\d{0,4})?(,[1-9]\d{0,4}(-[1-9]\d{0,4})?)*$"
_MOST_PAGES = 100
"""So many are looked at: far more than a house has storeys."""


class InputOptions(Options):
    """What of the files is read."""

    pages: Annotated[str, Field(pattern=PAGES, max_length=200)] | None = Field(
        default=None,
        description=(
            "pages of a PDF, such as 2-3,5: a storey each, the lowest first; all pages if not given"
        ),
    )

    @field_validator("pages")
    @classmethod
    def _ascending(cls, pages: str | None) -> str | None:
        for part in (pages or "").split(","):
            first, _, last = part.partition("-")
            if last and int(last) < int(first):
                raise ValueError(f"{part} runs backwards; single pages may be in any order")
        return pages

    def page_numbers(self) -> list[int] | None:
        """The pages from 1 in the order in which they were named; None for all."""
        if self.pages is None:
            return None
        found: list[int] = []
        for part in self.pages.split(","):
            first, _, last = part.partition("-")
            found += range(int(first), min(int(last or first), int(first) + _MOST_PAGES) + 1)
        return found[:_MOST_PAGES]


class ScaleOptions(Options):
    """How large the drawing is."""

    scale: Annotated[float, Field(gt=0.0, le=10_000.0)] | None = Field(
        default=None,
        description=(
            "millimetres of the house that a pixel of the drawing (a unit of a DXF) stands for; by"
            " what the drawing says if not given"
        ),
    )


class HouseOptions(Options):
    """What no plan shows: heights, the roof, frames and how doors stand."""

    storey_height: Annotated[float, Field(ge=2.0, le=6.0)] = Field(
        default=2.8, description="from one floor to the next (m), where a plan is read"
    )
    slab: Annotated[float, Field(ge=0.1, le=0.6)] = Field(
        default=0.25, description="thickness of the slab between two storeys (m)"
    )
    plinth: Annotated[float, Field(ge=0.0, le=1.0)] = Field(
        default=0.04, description="height of the ground floor above the ground (m)"
    )
    roof: RoofKind = Field(
        default="auto",
        description="type of roof; auto: hipped, or flat where a hipped one cannot be built",
    )
    roof_slope: Annotated[float, Field(ge=5.0, le=75.0)] | None = Field(
        default=None,
        description=(
            "slope of the roof (degrees), of a mansard that of its lower part; 32, of a mansard"
            " 68, if not given"
        ),
    )
    overhang: Annotated[float, Field(ge=0.0, le=2.0)] = Field(
        default=0.45, description="how far the roof reaches over the walls (m)"
    )
    window_frames: FrameKind = Field(
        default="surround", description="frame on all edges of windows, on the lowest, or on none"
    )
    door_frames: FrameKind = Field(
        default="surround", description="frame on all edges of doors, on the lowest, or on none"
    )
    doors: Literal["open", "closed"] = Field(
        default="open", description="how doors stand in the model; each can be opened in any case"
    )
    lights: LightKind = Field(
        default="ceiling",
        description="lamps of rooms at their ceilings, on their walls, or none at all",
    )
    flat: bool = Field(
        default=False,
        description=(
            "it is a flat: no roof of its own, no garden, and the tour stays inside; so it is where"
            " the sheet says so"
        ),
    )
    terraced: bool = Field(
        default=False,
        description=(
            "it stands in a row: closed walls to its neighbours, over which the roof goes on, a"
            " garden before and behind it, and the tour stays inside; so it is where the sheet says"
            " so"
        ),
    )
    neighbours: bool = Field(
        default=False, description="blank houses beside one that stands in a row (invented)"
    )
    surroundings: Literal["garden", "none"] = Field(
        default="garden", description="what lies around the house: ground with plants, or nothing"
    )
    ground_slope: Annotated[float, Field(ge=0.0, le=15.0)] = Field(
        default=0.0,
        description="how steeply the ground falls before the house and rises behind it (degrees)",
    )
    no_furniture: bool = Field(default=False, description="leave the rooms empty")
    seed: Annotated[int, Field(ge=0, le=2**31)] = Field(
        default=0, description="of the furniture: another number furnishes the house otherwise"
    )
    catalogue: Path | None = Field(
        default=None,
        description="SQLite file with objects of your own, which are used, too (docs/plan.md)",
    )
    varied_furniture: bool = Field(
        default=False,
        description="choose among all objects each time; else one model of a type but for pictures",
    )
    furniture_detail: Literal["fine", "coarse"] = Field(
        default="fine", description="how finely furniture is modelled; coarse: seen from afar"
    )
    no_tour: bool = Field(default=False, description="make no guided tour")
    tour_speed: Annotated[float, Field(ge=0.3, le=3.0)] = Field(
        default=1.2, description="how fast the tour walks (m/s)"
    )


class SiteOptions(Options):
    """Where the house stands, when it is looked at, and what is seen around it."""

    north: Annotated[float, Field(ge=-360.0, le=360.0)] | None = Field(
        default=None,
        description="where north is on the page, clockwise from up (degrees); up if nobody knows",
    )
    place: tuple[float, float] | None = Field(
        default=None,
        description="where the house stands, for the sun: latitude and longitude (degrees)",
    )
    time: Annotated[str, Field(max_length=64)] | None = Field(
        default=None,
        description=(
            "when it is looked at, for the sun, such as 2026-06-21T15:00 (by the clock of the"
            " longitude's zone) or 2026-06-21T15:00+02:00"
        ),
    )
    panorama: Annotated[str, Field(min_length=1, max_length=8192)] | None = Field(
        default=None,
        description=(
            "picture around the house: a file that shows all of it, with north in its middle, or"
            " four such as N=a.jpg,E=b.jpg,S=c.jpg,W=d.jpg"
        ),
    )

    @field_validator("place")
    @classmethod
    def _on_earth(cls, place: tuple[float, float] | None) -> tuple[float, float] | None:
        if place is None:
            return None
        latitude, longitude = place
        if not -90.0 <= latitude <= 90.0:
            raise ValueError(
                f"{latitude:g} is no latitude: it goes from -90 to 90, and comes first"
            )
        if not -180.0 <= longitude <= 180.0:
            raise ValueError(f"{longitude:g} is no longitude: it goes from -180 to 180")
        return place

    @field_validator("time")
    @classmethod
    def _is_time(cls, text: str | None) -> str | None:
        if text is not None:
            read_time(text)
        return text


class PlanOptions(Options):
    """All options of the verb that change its result."""

    input: InputOptions = InputOptions()
    scale: ScaleOptions = ScaleOptions()
    house: HouseOptions = HouseOptions()
    site: SiteOptions = SiteOptions()
