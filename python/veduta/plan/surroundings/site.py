"""Where a house stands: north on its page, its place on the earth, and when it is looked at.

What is not known is assumed, and said: north is up on the page, and the sun is that of a spring
afternoon.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from veduta.place.manifest import PlaceSun
from veduta.plan.document import PlanDocument
from veduta.plan.options import SiteOptions
from veduta.plan.sun import (
    USUAL_SUN,
    USUAL_TIME,
    SunPosition,
    in_zone,
    read_time,
    sun_position,
)
from veduta.run.errors import InputError

Assumed = Literal["north", "place", "time"]


@dataclass(frozen=True)
class Site:
    """north_deg: clockwise from up on the page; None: not known. place_deg: latitude, longitude.

    time: ISO 8601 with an offset; None where the place is not known. sun: where it stands.
    """

    north_deg: float | None = None
    place_deg: tuple[float, float] | None = None
    time: str | None = None
    sun: SunPosition = USUAL_SUN
    assumed: tuple[Assumed, ...] = ("north", "place", "time")

    @property
    def turn_deg(self) -> float:
        """Of north from up on the page, clockwise: assumed to be none where it is not known."""
        return self.north_deg or 0.0

    @property
    def toward_sun(self) -> tuple[float, float, float]:
        """Unit vector to the sun in the plan frame."""
        return self.sun.toward(self.turn_deg)

    def measures(self) -> dict[str, object]:
        """In numbers, for the report."""
        return {
            "sun_azimuth_deg": round(self.sun.azimuth_deg, 2),
            "sun_elevation_deg": round(self.sun.elevation_deg, 2),
            "sun_assumed": list(self.assumed),
        }

    def facts(self) -> list[tuple[str, str]]:
        """In words, for the report: what is known and what is assumed."""
        north = f"{self.turn_deg:g} degrees clockwise from up on the page"
        if self.north_deg is None:
            north = "up on the page: assumed, --north says it"
        told = "a spring afternoon's: assumed, --place and --time say it"
        if self.place_deg is not None:
            latitude, longitude = self.place_deg
            when = "" if self.time is None else f", {self.time.replace('T', ' ')}"
            told = f"at latitude {latitude:g}, longitude {longitude:g}{when}"
            told += " (the time is assumed)" if "time" in self.assumed else ""
        where = (
            f"azimuth {self.sun.azimuth_deg:.1f}, elevation {self.sun.elevation_deg:.1f} degrees"
        )
        return [("north", north), ("sun", f"{where}; {told}")]

    def for_place(self) -> PlaceSun:
        """What `place.json` says of it."""
        latitude, longitude = self.place_deg or (None, None)
        return PlaceSun(
            latitude_deg=latitude,
            longitude_deg=longitude,
            time=self.time,
            assumed=list(self.assumed),
        )


def with_site(document: PlanDocument, options: SiteOptions) -> PlanDocument:
    """The document with what the options say of north, place and time; the rest stays."""
    given: dict[str, object] = {}
    if options.north is not None:
        given["north_deg"] = options.north % 360.0
    if options.place is not None:
        given["place_deg"] = options.place
    if options.time is not None:
        given["time"] = options.time
    return document.model_copy(update=given)


def check_site(document: PlanDocument | None, options: SiteOptions) -> None:
    """InputError where a time is given for a place that nobody knows."""
    known = document is not None and document.place_deg is not None
    if options.time is not None and options.place is None and not known:
        raise InputError(
            "--time",
            "says where the sun stands only for a place that is known",
            "Give --place LATITUDE LONGITUDE, too.",
        )


def site_of(document: PlanDocument) -> Site:
    """Where the house of a document stands, and the sun over it."""
    north, place = document.north_deg, document.place_deg
    assumed: list[Assumed] = [] if north is not None else ["north"]
    if place is None:
        return Site(north, assumed=(*assumed, "place", "time"))
    if document.time is None:
        assumed.append("time")
    when = in_zone(read_time(document.time or USUAL_TIME), place[1])
    return Site(north, place, when.isoformat(), sun_position(*place, when), tuple(assumed))
