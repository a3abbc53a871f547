"""The roads of a call in the frame of its lots: those in the file of lots and of `--roads`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from veduta.geometry.crs import moved
from veduta.grammar.frames import Frame
from veduta.grammar.line_layers import road_lines
from veduta.grammar.outline import Found, Road
from veduta.grammar.rings import RingFault
from veduta.grammar.roads import Roads
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

DEGREES = 4326
"""Of coordinates that are longitudes and latitudes, where no CRS is named."""


def roads_among(path: Path | None, found: Found, frame: Frame) -> Roads:
    """The roads about the origin of the lots (m); how many there are becomes a note.

    path: a file of road lines beside those that were found with the lots.
    """
    roads = list(found.roads)
    if path is not None:
        try:
            require_file(path)
        except FileNotFoundError as error:
            raise InputError(path, "does not exist", "Check its name.") from error
        others, epsg = road_lines(path, found.epsg if found.is_settled else None)
        wanted = DEGREES if found.epsg is None and frame.zone is not None else found.epsg
        roads += [_in_crs(path, road, epsg, wanted) for road in others]
    placed = []
    for road in roads:
        try:
            placed.append(replace(road, points=frame.local(road.points)))
        except RingFault:
            continue  # where no lot can be, either
    if placed:
        lines = "1 road line says" if len(placed) == 1 else f"{len(placed)} road lines say"
        found.notes.append(f"{lines} where the fronts of lots are")
    return Roads(placed)


def _in_crs(path: Path, road: Road, own: int | None, wanted: int | None) -> Road:
    """The road in the CRS of the lots; where one of both names none they are taken for the same."""
    if own is None or wanted is None or own == wanted:
        return road
    points = moved(road.points[:, :2], own, wanted)
    if not np.isfinite(points).all():
        fault = f"cannot be brought from EPSG:{own} to EPSG:{wanted}"
        raise InputError(path, fault, "Save it in the CRS of the lots.")
    return replace(road, points=np.column_stack([points, road.points[:, 2]]))
