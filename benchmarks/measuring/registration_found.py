"""Simulated streets of the project's own planner, with the walls that the finder finds in them."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from registration_streets import SimulatedStreet
from simulated_street import simulated_street, structure_of_simulated

from veduta.photos.cameras.orient import oriented
from veduta.photos.city.model import CityModel
from veduta.photos.city.reading import read_city_model
from veduta.photos.options import ModelOptions, WallOptions
from veduta.photos.structure import Structure
from veduta.photos.walls.find_walls import find_walls
from veduta.photos.world.georeference import Similarity
from veduta.synthetic.streets.gps import gps_places
from veduta.synthetic.streets.house import House, Street
from veduta.synthetic.streets.model_files import city_json
from veduta.synthetic.streets.plan import plan_street
from veduta.synthetic.streets.simulated import SimulatedStructure, simulate
from veduta.synthetic.streets.walk import walk_part

Places = NDArray[np.float64]


def found_street(seed: int) -> SimulatedStreet:
    """The structure upright as the verb makes it; the truth by the true places of the photos."""
    street, simulated, structure = simulated_street(seed)
    true = np.array([camera.position_m for camera in simulated.cameras])
    return _laid(street, structure, simulated, gps_places(true, seed))


def part_street(seed: int, photos: int = 24) -> SimulatedStreet:
    """The same of a car's photos that show parts of the rows; GPS hangs together to decimetres."""
    street = plan_street(seed)
    simulated = simulate(street, walk_part(street, photos, (0.3, 0.6)), seed)
    true = np.array([camera.position_m for camera in simulated.cameras])
    rng = np.random.default_rng(seed)
    gps = true + rng.normal(0.0, 0.8, 3) + rng.normal(0.0, 0.3, true.shape)
    return _laid(street, structure_of_simulated(simulated), simulated, gps)


def _laid(
    street: Street, structure: Structure, simulated: SimulatedStructure, gps: Places
) -> SimulatedStreet:
    upright = oriented(structure).structure
    walls = find_walls(upright, WallOptions(), 0)
    model = _model(street, (*street.houses, *street.others))
    removed = _model(street, street.others)
    # Models are told from their own lower corner.
    apart = np.array(street.origin_m) - np.array(model.origin_m)
    moved = np.array(model.origin_m) - np.array(removed.origin_m)
    world = _truth(upright, simulated, apart)
    removed = CityModel(
        tuple(
            type(one)(one.id, one.part, _plus(one.offset_m, -moved)) for one in removed.buildings
        ),
        removed.crs,
        model.origin_m,
    )
    return SimulatedStreet(
        upright,
        walls,
        model,
        removed,
        world,
        gps + apart,
    )


def _truth(upright: Structure, simulated: SimulatedStructure, apart: Places) -> Similarity:
    """The rotation by how the cameras are turned: where they stand in a line leaves it open."""
    true = np.array([camera.position_m for camera in simulated.cameras]) + apart
    turns = np.array([camera.cam_from_world[:3, :3] for camera in simulated.cameras])
    left, _, right = np.linalg.svd(
        np.einsum("nji,njk->ik", turns, upright.cam_from_world[:, :, :3])
    )
    rotation = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    own = upright.centres() @ rotation.T
    about = own - own.mean(axis=0)
    scale = float((about * (true - true.mean(axis=0))).sum() / (about**2).sum())
    return Similarity(scale, rotation, true.mean(axis=0) - scale * own.mean(axis=0))


def _plus(offset_m: tuple[float, float, float], shift_m: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in np.array(offset_m) + shift_m)
    return x, y, z


def _model(street: Street, houses: tuple[House, ...]) -> CityModel:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.city.json"
        path.write_text(json.dumps(city_json(street, houses)))
        return read_city_model(path, ModelOptions())
