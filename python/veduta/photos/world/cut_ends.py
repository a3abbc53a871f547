"""Which ends of walls are only where the photos end: they say nothing of where a facade ends.

Photos of a street show parts of long rows. Where no two photos would show what lies just beyond
the end of a wall, the end is that of the view; it must not be held against the end of a facade.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall

_SHARES = np.array([0.2, 0.5, 0.8])
"""Places along an end: what is hidden or out of view at one may be seen at another."""


@dataclass(frozen=True)
class CutParameters:
    """beyond: how far past an end is looked, as a share of the typical distance of the photos.

    grazing: cosine between a line of sight and the wall's normal, under which nothing is matched.
    reach: quantile of the distances that the wall's points were seen from; photos further away are
    not counted. fewest: photos that must show the place for a point there to be found: one more
    than the two that a point takes, for not every place has features. rim: of a photo, as a share
    of its size, where features are few.
    """

    beyond: float = 0.06
    grazing: float = 0.12
    reach: float = 0.9
    fewest: int = 3
    rim: float = 0.02


@dataclass(frozen=True)
class CutEnds:
    """edges: (w, 2) start and end of each wall, tops: (w,): whether the view ends there."""

    edges: NDArray[np.bool_]
    tops: NDArray[np.bool_]


def cut_ends(
    structure: Structure, walls: Sequence[Wall], parameters: CutParameters | None = None
) -> CutEnds:
    """Of walls in the structure's frame, z up."""
    known = parameters or CutParameters()
    edges = np.zeros((len(walls), 2), dtype=bool)
    tops = np.zeros(len(walls), dtype=bool)
    centres = structure.centres()
    away = structure.points[structure.point_of] - centres[structure.image_of]
    seen_from = np.linalg.norm(away, axis=1)
    for row, wall in enumerate(walls):
        own = np.isin(structure.point_of, wall.point_rows)
        if not own.any():
            continue
        step = known.beyond * float(np.median(seen_from[own]))
        reach = float(np.quantile(seen_from[own], known.reach))
        beyond = _beyond(wall, step)
        outward = np.array([*wall.outward, 0.0])
        shown = _photos_that_show(structure, centres, beyond, outward, reach, known)
        most = shown.reshape(3, len(_SHARES)).max(axis=1)
        edges[row] = most[:2] < known.fewest
        tops[row] = most[2] < known.fewest
    return CutEnds(edges, tops)


def _beyond(wall: Wall, step: float) -> NDArray[np.float64]:
    """(9, 3) places past the start, the end and the top, three of each."""
    sides = [wall.start - step * wall.along, wall.end + step * wall.along]
    heights = wall.bottom + _SHARES * wall.height
    places = [[*side, height] for side in sides for height in heights]
    tops = wall.start + _SHARES[:, None] * (wall.end - wall.start)
    places += [[*place, wall.top + step] for place in tops]
    return np.array(places)


def _photos_that_show(
    structure: Structure,
    centres: NDArray[np.float64],
    places: NDArray[np.float64],
    outward: NDArray[np.float64],
    reach: float,
    known: CutParameters,
) -> NDArray[np.int64]:
    """(n,) how many photos show each of (n, 3) places on a wall from its front, and near enough."""
    count = np.zeros(len(places), dtype=np.int64)
    for row, pose in enumerate(structure.cam_from_world):
        ray = places - centres[row]
        far = np.linalg.norm(ray, axis=1)
        ahead = places @ pose[:, :3].T + pose[:, 3]
        faces = -(ray @ outward) > known.grazing * far
        before = faces & (far < reach) & (ahead[:, 2] > 1e-9 * far)
        if not before.any():
            continue
        camera = structure.camera(row)
        pixel = np.asarray(camera.img_from_cam(ahead[before]))
        size = np.array([camera.width, camera.height])
        inside = ((pixel > known.rim * size) & (pixel < (1.0 - known.rim) * size)).all(axis=1)
        count[np.flatnonzero(before)[inside]] += 1
    return count
