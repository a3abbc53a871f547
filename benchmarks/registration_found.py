"""Simulated streets of the project's own planner, with the walls that the finder finds in them."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import numpy as np
from registration_streets import SimulatedStreet
from simulated_street import simulated_street

from veduta.photos.cameras.orient import oriented
from veduta.photos.city.model import CityModel
from veduta.photos.city.reading import read_city_model
from veduta.photos.options import ModelOptions, WallOptions
from veduta.photos.walls.find_walls import find_walls
from veduta.photos.world.absolute_orientation import absolute_orientation
from veduta.photos.world.georeference import Similarity
from veduta.synthetic.streets.gps import gps_places
from veduta.synthetic.streets.house import House, Street
from veduta.synthetic.streets.model_files import city_json


def found_street(seed: int) -> SimulatedStreet:
    """The structure upright as the verb makes it; the truth by the true places of the photos."""
    street, simulated, structure = simulated_street(seed)
    upright = oriented(structure).structure
    walls = find_walls(upright, WallOptions(), 0)
    model = _model(street, (*street.houses, *street.others))
    removed = _model(street, street.others)
    true = np.array([camera.position_m for camera in simulated.cameras])
    # Models are told from their own lower corner.
    apart = np.array(street.origin_m) - np.array(model.origin_m)
    moved = np.array(model.origin_m) - np.array(removed.origin_m)
    world = absolute_orientation(upright.centres(), true + apart)
    gps = gps_places(true, seed) + apart
    removed = CityModel(
        tuple(
            type(one)(one.id, one.part, _plus(one.offset_m, -moved)) for one in removed.buildings
        ),
        removed.crs,
        model.origin_m,
    )
    return SimulatedStreet(
        upright, walls, model, removed, Similarity(world.scale, world.rotation, world.shift), gps
    )


def _plus(offset_m: tuple[float, float, float], shift_m: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in np.array(offset_m) + shift_m)
    return x, y, z


def _model(street: Street, houses: tuple[House, ...]) -> CityModel:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.city.json"
        path.write_text(json.dumps(city_json(street, houses)))
        return read_city_model(path, ModelOptions())
