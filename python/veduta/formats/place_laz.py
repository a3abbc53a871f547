"""The points of a place as LAZ: all its clouds in one file, in the place's own CRS."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.formats.laz import write_laz
from veduta.place.place import Place
from veduta.run.atomic import atomic_write
from veduta.run.errors import InputError


def write_place_laz(place: Place, path: Path) -> None:
    """Write the points; InputError where the place has none."""
    if not place.clouds:
        raise InputError(path, "the place has no points", "Choose a format for surfaces.")
    # The other layers are the same points in colours that tell something.
    clouds = [cloud for cloud in place.clouds if cloud.layer == "points"] or place.clouds[:1]
    points = np.concatenate([cloud.points_m for cloud in clouds]).astype(np.float64)
    colours = np.concatenate([cloud.colours for cloud in clouds])
    classes = [cloud.classes for cloud in clouds]
    known = [one for one in classes if one is not None]
    every = np.concatenate(known) if len(known) == len(classes) else None
    east, north, up = place.origin_m
    with atomic_write(path) as temporary:
        write_laz(points, colours, temporary, crs=place.crs, origin_m=(east, north, up),
                  classes=every)  # fmt: skip
