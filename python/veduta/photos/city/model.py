"""A coarse city model as parts in metres: what photos are laid into, and what they texture."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.place.part import Part


@dataclass(frozen=True)
class CityBuilding:
    """One building: polygons of known class about `offset_m`, from the model's origin."""

    id: str
    part: Part
    offset_m: tuple[float, float, float]


@dataclass(frozen=True)
class CityModel:
    """Buildings about `origin_m` in `crs`; x east, y north, z up.

    crs: "EPSG:28992" and the like, None where the file names none.
    notes: what was assumed or left out, for the report.
    """

    buildings: tuple[CityBuilding, ...]
    crs: str | None
    origin_m: tuple[float, float, float]
    notes: tuple[str, ...] = ()
