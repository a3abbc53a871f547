"""The segments as a place: a mesh each, the scan points with their classes, the images, a tour."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.bodies import Body
from veduta.drive.build.body_mesh import houses_mesh
from veduta.drive.build.meshes import CLASS_COLOURS
from veduta.drive.build.outcome import Outcome, placed_meshes, with_filled
from veduta.drive.build.segment import Textured
from veduta.drive.record import DriveRecord, Shot
from veduta.place.manifest import PlaceCamera, Start, Tour
from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, ModelFile, Place, PlacedPart, Standing

PICTURES = "pictures"
_EYE_EVERY_M, _SPEED_M_S = 2.0, 3.0


def drive_place(
    record: DriveRecord,
    outcomes: Sequence[Outcome],
    line: NDArray[np.float64],
    road_m: float,
    folder: Path,
) -> Place:
    """The place, with its models already written into `folder`, one segment after the other.

    line: (c, 3) the path of the scanner, along which the tour goes. The lowest ground is at z = 0:
    what is shown below that is hidden there. The origin moves the other way, so that all
    coordinates in the world stay.
    """
    lift = max(-min((one.lowest_m for one in outcomes), default=0.0), 0.0)
    up = np.array([0.0, 0.0, lift])
    x, y, z = record.origin_m
    place = Place(title=record.name, crs=record.crs, origin_m=(x, y, z - lift))
    if record.vertical_datum is not None:
        place.description = f"Heights count from {record.vertical_datum}."
    for one in outcomes:
        for mesh, standing in placed_meshes(one.load(), lift, one.raw):
            row = PlacedPart(
                mesh.id, standing, partial(_again, one.load, mesh.id, lift),
                file=ModelFile(f"parts/{mesh.id}.glb"),
                _content=mesh,
            ).save(folder)  # fmt: skip
            placed = PlacedPart.standing_as(row, partial(_again, one.load, mesh.id, lift))
            placed.lies = True
            place.parts[mesh.id] = placed
    taken_out = np.concatenate([one.taken_out for one in outcomes])
    # Otherwise what was taken out would stand in the street again, as points and in the photos.
    place.hidden = ("points", "cameras", "photos")
    colours = np.concatenate([one.colours for one in outcomes])
    place.clouds.append(Cloud("taken-out", taken_out + up, colours))
    place.cameras = [_camera(shot, up) for shot in record.shots]
    if len(line) > 1:
        place.tours.append(_tour(line + up, road_m))
        ahead = line[min(len(line) - 1, 100)]
        eye, target = line[0] + up, np.array([ahead[0], ahead[1], line[0][2]]) + up
        place.start = Start(eye=tuple(eye.tolist()), target=tuple(target.tolist()))
    return place


def add_houses(place: Place, bodies: Sequence[Body], record: DriveRecord) -> None:
    """What stands behind the facades, as one part; nothing where nothing is known of it."""
    if not bodies:
        return
    middle = np.mean([one.front.mean(axis=0) for one in bodies], axis=0)
    transform = np.eye(4)
    transform[:3, 3] = middle + [0.0, 0.0, record.origin_m[2] - place.origin_m[2]]
    place.add(houses_mesh(bodies, middle), Standing("Behind the facades", transform))


def _again(load: Callable[[], Textured], identity: str, lift_m: float) -> Mesh:
    """A mesh of a segment, from what is on disk."""
    return next(mesh for mesh, _ in placed_meshes(load(), lift_m) if mesh.id == identity)


def _camera(shot: Shot, up: NDArray[np.float64]) -> PlaceCamera:
    pose = shot.world_from_cam.copy()
    pose[:3, 3] += up
    return PlaceCamera(
        id=shot.name, name=shot.name, picture=f"{PICTURES}/{shot.name}.jpg",
        width_px=shot.width_px, height_px=shot.height_px, focal_px=shot.focal_px,
        centre_px=shot.centre_px, transform=tuple(pose.T.ravel().tolist()),
    )  # fmt: skip


def classified(outcomes: Sequence[Outcome]) -> Iterator[Cloud]:
    """The points of one segment after the other, coloured by their classes."""
    table = np.zeros((256, 3), dtype=np.uint8)
    for value, colour in CLASS_COLOURS.items():
        table[value] = colour
    for one in outcomes:
        points, kinds = with_filled(one.load().geometry)
        yield Cloud("points", points, table[kinds], kinds)


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
