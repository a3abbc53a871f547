"""The segments as a place: a mesh each, the scan points with their classes, the images, a tour."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.meshes import CLASS_COLOURS
from veduta.drive.build.outcome import Outcome
from veduta.drive.record import DriveRecord
from veduta.place.manifest import PlaceCamera, Start, Tour
from veduta.place.place import Cloud, Place

PICTURES = "pictures"
_EYE_EVERY_M, _SPEED_M_S = 2.0, 3.0


def drive_place(
    record: DriveRecord,
    outcomes: Sequence[Outcome],
    line: NDArray[np.float64],
    road_m: float,
) -> Place:
    """line: (c, 3) the path of the scanner, along which the tour goes."""
    place = Place(title=record.name, crs=record.crs, origin_m=record.origin_m)
    for one in outcomes:
        for mesh, standing in one.meshes:
            place.add(mesh, standing)
    taken_out = np.concatenate([one.taken_out for one in outcomes])
    # Otherwise what was taken out would stand in the street again, as points and in the photos.
    place.hidden = ("points", "cameras", "photos")
    colours = np.concatenate([one.colours for one in outcomes])
    place.clouds.append(Cloud("taken-out", taken_out, colours))
    place.cameras = [
        PlaceCamera(
            id=shot.name, name=shot.name, picture=f"{PICTURES}/{shot.name}.jpg",
            width_px=shot.width_px, height_px=shot.height_px, focal_px=shot.focal_px,
            centre_px=shot.centre_px, transform=tuple(shot.world_from_cam.T.ravel().tolist()),
        )
        for shot in record.shots
    ]  # fmt: skip
    if len(line) > 1:
        place.tours.append(_tour(line, road_m))
        ahead = line[min(len(line) - 1, 100)]
        eye, target = line[0], np.array([ahead[0], ahead[1], line[0][2]])
        place.start = Start(eye=tuple(eye.tolist()), target=tuple(target.tolist()))
    return _above_zero(place)


def _above_zero(place: Place) -> Place:
    """The same place with its lowest ground at z = 0: what is shown below that is hidden there.

    The origin moves the other way, so that all coordinates in the world stay.
    """
    grounds = [one for one in place.parts.values() if one.standing.ground]
    lowest = min((float(one.triangles()[0][:, 2].min()) for one in grounds), default=0.0)
    if lowest >= 0.0 or place.start is None:
        return place
    x, y, z = place.origin_m
    start = place.start
    raised = Place(place.title, crs=place.crs, origin_m=(x, y, z + lowest))
    raised.start = Start(eye=_up(start.eye, -lowest), target=_up(start.target, -lowest))
    return raised.merge(place)


def _up(place: tuple[float, float, float], by_m: float) -> tuple[float, float, float]:
    return place[0], place[1], place[2] + by_m


def classified(outcomes: Sequence[Outcome]) -> Cloud:
    """The scan points of all segments, coloured by their classes."""
    kind = np.concatenate([one.kinds for one in outcomes] or [np.zeros(0, np.uint8)])
    table = np.zeros((256, 3), dtype=np.uint8)
    for value, colour in CLASS_COLOURS.items():
        table[value] = colour
    points = np.concatenate([one.points for one in outcomes] or [np.zeros((0, 3))])
    return Cloud("points", points, table[kind], kind)


def _tour(line: NDArray[np.float64], road_m: float) -> Tour:
    """Along the path as it was driven, looking ahead."""
    spacing = float(np.linalg.norm(np.diff(line[:2, :2], axis=0)))
    every = max(int(round(_EYE_EVERY_M / max(spacing, 1e-3))), 1)
    eyes = line[::every]
    if len(eyes) < 2:
        eyes = line[[0, -1]]
    heading = np.gradient(eyes[:, :2], axis=0)
    heading /= np.linalg.norm(heading, axis=1, keepdims=True)
    directions = np.concatenate([heading, np.zeros((len(eyes), 1))], axis=1)
    step = np.linalg.norm(np.diff(eyes, axis=0), axis=1) / _SPEED_M_S
    times = np.concatenate([[0.0], np.cumsum(np.maximum(step, 0.05))])
    lowered = eyes - [0.0, 0.0, max(road_m - 1.7, 0.0)]
    return Tour(
        id="drive", name="Along the drive", times_s=times.tolist(),
        eyes=[tuple(row) for row in lowered.tolist()],
        directions=[tuple(row) for row in directions.tolist()],
    )  # fmt: skip
