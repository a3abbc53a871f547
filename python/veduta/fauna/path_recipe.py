"""The way of an animal through a place or over a terrain; what was found goes into the report."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.fauna.build.going import Goer
from veduta.fauna.build.into_place import require_place
from veduta.fauna.motion.angles import Floats
from veduta.fauna.path.given import read_path
from veduta.fauna.path.ground import LEVEL, around_others, ground_of, local_points
from veduta.fauna.path.limits import PathLimits
from veduta.fauna.path.terrain import Terrain
from veduta.fauna.path.through import FoundPath, path_through
from veduta.fauna.path_picture import path_picture
from veduta.place.place import Place
from veduta.run.errors import InputError, NotFoundError
from veduta.run.work import Work


def planned(
    work: Work, folder: Path, way: Path | None, goer: Goer
) -> tuple[Place, FoundPath, Terrain]:
    """The place, the animal's path through it, and its ground."""
    with work.step("place"):
        place, terrain = ground_of(folder, goer.length_m)
        require_place(place, folder)
    if LEVEL in place.parts:
        work.doubt("no part of the place is marked as ground: a level one was taken, and is in it")
    with work.step("path") as step:
        points = None if way is None else local_points(read_path(way), place, terrain)
        found = _found(work, place, terrain, points, goer)
        step.counts["cells"] = int(terrain.blocked.size)
        step.counts["free cells"] = int(found.ways.free.sum())
        step.counts["turns on the spot"] = len(found.corners)
    apart = np.linalg.norm(np.diff(found.points_m, axis=0), axis=1)
    work.measure("path_m", float(apart.sum()))
    work.picture(
        "The path over the terrain",
        "north is up; brown: in the way, pale: too near to it; the path blue, its points red",
        path_picture(terrain, found),
        wide=True,
    )
    return place, found, terrain


def _found(
    work: Work, place: Place, terrain: Terrain, points: Floats | None, goer: Goer
) -> FoundPath:
    """The path, clear of those of other animals where it can be."""
    turns = goer.walker is not None and bool(goer.walker.legs)
    others = [animal.name for animal in place.animals if animal.id != goer.name]
    if others:
        clear = around_others(terrain, place, goer.name, goer.length_m)
        try:
            return path_through(clear, points, PathLimits(), goer.length_m, turns=turns)
        except (InputError, NotFoundError):
            work.doubt(
                f"the path crosses that of {', '.join(others[:3])}: no way leads around it; where"
                " they meet, one waits in the studio"
            )
    return path_through(terrain, points, PathLimits(), goer.length_m, turns=turns)
