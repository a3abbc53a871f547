"""`georef.json`: where each component lies in the world, how well that is known, and why."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from veduta.photos.world.georeference import Fit, Georeference
from veduta.photos.world.georeferencing import Georeferenced
from veduta.place.manifest import IDENTITY, Finite, Matrix, Positive, Vector
from veduta.run.atomic import write_bytes

GEOREF = "georef.json"


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class FitResidual(_Record):
    """What is left at one facade, photo or control point."""

    name: str
    distance_m: Finite


class FitRecord(_Record):
    """One way to lay the component into the world."""

    transform: Matrix = Field(
        description="world_from_component, 4x4, column-major; metres about the origin, scale within"
    )
    scale: Positive = Field(description="metres in a unit of the component's own frame")
    scale_sd: Finite = Field(description="one deviation, relative")
    rotation_sd_rad: Vector = Field(description="one deviation about east, north and up")
    shift_sd_m: Vector = Field(description="one deviation of the middle of the photos")
    rms_m: Finite | None = Field(description="of the residuals that count")
    score: Finite = Field(description="the higher the better; of a model in nats")
    residuals: list[FitResidual]


class TriedReference(_Record):
    """What one kind of reference says."""

    method: Literal["model", "gps", "gcp"]
    accepted: bool
    why: str
    crs: str | None
    origin: Vector
    best: FitRecord | None
    second: FitRecord | None


class ComponentGeoref(_Record):
    """A component: `sparse/<component>`."""

    component: int = Field(ge=0)
    accepted: Literal["model", "gps", "gcp"] | None = Field(
        description="what it is laid into the world by; null: it is in a frame of its own"
    )
    crs: str | None = Field(description="EPSG code of the metres; null in a frame of its own")
    origin: Vector = Field(description="in that CRS, where the axes meet")
    transform: Matrix = Field(
        default=IDENTITY,
        description="what was done to its own frame, upright and of any unit: world_from_component",
    )
    tried: list[TriedReference]


class GeorefDocument(_Record):
    """The document."""

    schema_: Literal["veduta/georef"] = Field(default="veduta/georef", alias="schema")
    version: Annotated[Literal[1], Field()] = 1
    components: list[ComponentGeoref]


def georef_document(found: Sequence[Georeferenced]) -> GeorefDocument:
    """The document of all components, in their order."""
    return GeorefDocument(components=[_component(number, one) for number, one in enumerate(found)])


def write_georef(document: GeorefDocument, path: Path) -> None:
    """Write it; the file appears whole or not at all."""
    write_bytes(path, document.model_dump_json(by_alias=True, indent=2).encode())


def _component(number: int, found: Georeferenced) -> ComponentGeoref:
    accepted = found.accepted
    tried = [_tried(one) for one in found.tried]
    if accepted is None or accepted.best is None:
        return ComponentGeoref(
            component=number, accepted=None, crs=None, origin=(0.0, 0.0, 0.0), tried=tried
        )
    return ComponentGeoref(
        component=number,
        accepted=accepted.method,
        crs=accepted.crs,
        origin=accepted.origin_m,
        transform=_matrix(accepted.best),
        tried=tried,
    )


def _tried(one: Georeference) -> TriedReference:
    return TriedReference(
        method=one.method,
        accepted=one.accepted,
        why=one.why,
        crs=one.crs,
        origin=one.origin_m,
        best=None if one.best is None else _fit(one.best),
        second=None if one.second is None else _fit(one.second),
    )


def _fit(fit: Fit) -> FitRecord:
    return FitRecord(
        transform=_matrix(fit),
        scale=fit.world_from_model.scale,
        scale_sd=fit.scale_sd,
        rotation_sd_rad=_vector(fit.rotation_sd_rad),
        shift_sd_m=_vector(fit.shift_sd_m),
        rms_m=fit.rms_m if np.isfinite(fit.rms_m) else None,
        score=fit.score,
        residuals=[FitResidual(name=one.name, distance_m=one.distance_m) for one in fit.residuals],
    )


def _matrix(fit: Fit) -> tuple[float, ...]:
    matrix = np.eye(4)
    world = fit.world_from_model
    matrix[:3, :3] = world.scale * world.rotation
    matrix[:3, 3] = world.shift
    return tuple(matrix.T.ravel().tolist())


def _vector(values: np.ndarray) -> Vector:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
