"""Laying a component into the world by what there is: control points, a city model, GPS.

With `auto` they are tried in this order, and the first that is believed counts; all that was tried
is kept with the reason, so that GPS in place of a model is never taken for the model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.photos.cameras.orient import transformed
from veduta.photos.city.crs import between
from veduta.photos.city.facades import facades_of
from veduta.photos.city.model import CityModel
from veduta.photos.city.reading import read_city_model
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.options import ModelOptions, PhotosOptions
from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall
from veduta.photos.world.control_file import ControlPoints, read_control
from veduta.photos.world.control_fit import control_georeference
from veduta.photos.world.eye_height import Feet
from veduta.photos.world.gauss_newton import UP_SD_RAD
from veduta.photos.world.georeference import Georeference, Method
from veduta.photos.world.gps_fit import gps_georeference
from veduta.photos.world.gps_positions import gps_positions
from veduta.photos.world.ground import on_the_feet
from veduta.photos.world.position_file import PhotoPositions, read_positions
from veduta.photos.world.register import register
from veduta.photos.world.rough import roughly
from veduta.run.digests import input_digest
from veduta.run.errors import InputError


@dataclass(frozen=True)
class References:
    """What says where the place lies, read; None where none is given."""

    model: CityModel | None
    control: ControlPoints | None
    positions: PhotoPositions | None = None

    @property
    def notes(self) -> list[str]:
        """What was assumed or left out in reading them."""
        model = () if self.model is None else self.model.notes
        return [*model, *(() if self.control is None else self.control.notes)]


@dataclass(frozen=True)
class Georeferenced:
    """All that was tried for a component, in order."""

    tried: tuple[Georeference, ...]

    @property
    def accepted(self) -> Georeference | None:
        """The first that is believed."""
        return next((one for one in self.tried if one.accepted), None)


def require_walls(options: PhotosOptions) -> None:
    """InputError where walls alone could lay the photos into a model, and none are looked for."""
    world = options.world
    by_walls = world.georef == "model" or (world.georef == "auto" and world.gcp is None)
    if options.walls.no_walls and world.model is not None and by_walls:
        raise InputError(
            "--no-walls",
            "leaves nothing to lay onto the facades of --model",
            "Leave it out, or say what else tells where the place lies (--gcp, --georef gps).",
        )


def read_references(options: ModelOptions) -> References:
    """The model and the control points; InputError where a file or an option cannot be used."""
    for method, given in (("model", options.model), ("gcp", options.gcp)):
        if options.georef == method and given is None:
            fault = f"asks for --{method}, which is not given"
            raise InputError(f"--georef {method}", fault, f"Add --{method} FILE.")
    model = None if options.model is None else read_city_model(options.model, options)
    control = None if options.gcp is None else read_control(options.gcp)
    if model is not None and control is not None:
        control = _in_crs_of(control, model)
    positions = None if options.positions is None else read_positions(options.positions)
    return References(model, control, positions)


def digests_of(options: ModelOptions) -> list[str]:
    """Of the files that the references lie in; InputError where one cannot be read."""
    given = (options.model, options.gcp, options.positions)
    return [input_digest(path) for path in given if path is not None]


def georeference(
    structure: Structure,
    walls: Sequence[Wall],
    photos: Sequence[PhotoRecord],
    references: References,
    method: str,
    seed: int,
    up_sd_rad: float = UP_SD_RAD,
) -> Georeferenced:
    """What the references say of an upright structure; walls are in its frame.

    up_sd_rad: how well it is known that the structure's z is up.
    """
    if method == "off":
        return Georeferenced(())
    model, control = references.model, references.control
    crs = None if model is None else model.crs
    origin = None if model is None else model.origin_m
    gps, prior = None, None
    positions = gps_positions(structure, photos, crs, origin)
    if positions is not None:
        gps, prior = gps_georeference(structure, positions, seed)
    tried: list[Georeference] = []
    is_auto = method in ("auto", "rough")
    if control is not None and (is_auto or method == "gcp"):
        tried.append(control_georeference(structure, control, origin))
    if model is not None and (is_auto or method == "model") and not _is_settled(tried):
        tried.append(register(structure, walls, model, prior, seed, up_sd_rad))
    if (is_auto or method == "gps") and not _is_settled(tried):
        if gps is not None and gps.best is not None and model is not None:
            feet = Feet(facades_of(model))
            gps = replace(gps, best=on_the_feet(gps.best, structure, feet))
        if gps is not None:
            tried.append(gps)
        elif method == "gps":
            why = "no photo that was placed has GPS"
            tried.append(Georeference("gps", False, why, crs, origin or (0.0, 0.0, 0.0), None))
    if method == "rough" and not _is_settled(tried):
        tried = roughly(tried)
    return Georeferenced(tuple(tried))


def in_the_world(structure: Structure, found: Georeference | None) -> Structure:
    """The structure in metres about the origin; as it is where nothing is believed."""
    if found is None or found.best is None or not found.accepted:
        return structure
    world = found.best.world_from_model
    return transformed(structure, world.scale, world.rotation, world.shift)


def method_name(method: Method) -> str:
    """For a person."""
    return {"model": "the city model", "gps": "GPS", "gcp": "ground control points"}[method]


def _is_settled(tried: Sequence[Georeference]) -> bool:
    return any(one.accepted for one in tried)


def _in_crs_of(control: ControlPoints, model: CityModel) -> ControlPoints:
    """The control points in the CRS of the model, either way round."""
    if control.exchanged is not None:
        other = replace(control.exchanged, exchanged=None)
        control = replace(control, exchanged=_in_crs_of(other, model))
    if model.crs is None or control.crs == model.crs:
        return control
    way = between(control.crs, model.crs)
    places = np.array([point.place_m for point in control.points])
    east, north = way.transform(places[:, 0], places[:, 1])
    moved = np.column_stack([east, north, places[:, 2]])
    points = tuple(
        replace(point, place_m=place) for point, place in zip(control.points, moved, strict=True)
    )
    note = f"control points were converted from {control.crs} to {model.crs}, that of the model"
    return replace(control, crs=model.crs, points=points, notes=(*control.notes, note))
