"""One cloud of what all depth maps show, each spot once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta import _core
from veduta.dense.document import DepthMap, Views, camera_row


@dataclass(frozen=True)
class CloudParameters:
    """most_px, most_share: when the pixels of two views are the same spot
    (`veduta_stereo::consistent`, Rust). stray_beside: points around one that are asked.
    stray_factor: a point whose points around are so many times farther away than theirs is stray.
    at_once: points that are asked at a time, so that it takes little memory.
    """

    most_px: float = 2.0
    most_share: float = 0.01
    stray_beside: int = 6
    stray_factor: float = 4.0
    at_once: int = 200_000


@dataclass(frozen=True, eq=False)
class DenseCloud:
    """points_m: (n, 3) float64 world. normals: (n, 3) float32 unit, towards the cameras. colours:
    (n, 3) uint8 sRGB. views: (n,) uint8, how many photos show the point.
    """

    points_m: NDArray[np.float64]
    normals: NDArray[np.float32]
    colours: NDArray[np.uint8]
    views: NDArray[np.uint8]


def fuse_cloud(
    views: Views,
    links: dict[int, tuple[int, ...]],
    depth_map: Callable[[int], DepthMap],
    least: int,
    parameters: CloudParameters,
    most: int | None = None,
) -> tuple[DenseCloud, int]:
    """Every spot that `least` views show, from the view that comes first.

    links: for each view with a depth map, those that it is compared with. most: points that there
    may be; with more, every second is left, and so on: the number says one of how many.
    """
    used = {view: _packed(np.zeros(_pixels(views, view), dtype=bool)) for view in links}
    parts: list[list[NDArray[Any]]] = []
    every = 1
    for view in sorted(links):
        shown = [view, *(one for one in links[view] if one in links)]
        maps = [depth_map(one) for one in shown]
        masks = [_unpacked(used[one], views, one) for one in shown]
        points, normals, colours, counts, taken = _core.fuse_depths(
            [one.depths_m for one in maps],
            np.stack([camera_row(views.cameras[one]) for one in shown]),
            [one.normals for one in maps],
            [views.pixels(one).reshape(-1, 3) for one in shown],
            masks,
            most_px=parameters.most_px,
            most_share=parameters.most_share,
            least=min(least, len(shown)),
        )
        for one, marked, pixels in zip(shown, masks, taken, strict=True):
            marked.ravel()[pixels] = True
            used[one] = _packed(marked)
        found: list[NDArray[Any]] = [points, normals, colours, counts]
        parts.append([column[::every].copy() for column in found])
        while most is not None and sum(len(part[0]) for part in parts) > most:
            every *= 2
            parts = [[column[::2].copy() for column in part] for part in parts]
    return _joined(parts), every


def _joined(parts: list[list[NDArray[Any]]]) -> DenseCloud:
    """One cloud; parts is emptied column by column, so that nothing is in memory twice for long."""
    columns = []
    for at in range(4):
        columns.append(np.concatenate([part[at] for part in parts]))
        for part in parts:
            part[at] = part[at][:0]
    return DenseCloud(columns[0], columns[1], columns[2], columns[3])


def _pixels(views: Views, view: int) -> tuple[int, int]:
    return views.cameras[view].height_px, views.cameras[view].width_px


def _packed(marked: NDArray[np.bool_]) -> NDArray[np.uint8]:
    return np.packbits(marked)


def _unpacked(bits: NDArray[np.uint8], views: Views, view: int) -> NDArray[np.bool_]:
    height, width = _pixels(views, view)
    return np.unpackbits(bits, count=height * width).astype(bool).reshape(height, width)


def within_box(cloud: DenseCloud, box: tuple[float, ...]) -> DenseCloud:
    """The points in a box: xmin ymin zmin xmax ymax zmax (m)."""
    low, high = np.array(box[:3]), np.array(box[3:])
    inside = (cloud.points_m >= low) & (cloud.points_m <= high)
    return _chosen(cloud, np.asarray(inside.all(axis=1)))


def without_strays(cloud: DenseCloud, parameters: CloudParameters) -> DenseCloud:
    """Without points that stand alone: far from those around by the spacing that these have.

    The spacing is measured anew at each spot, as a street's points grow sparse with the distance.
    """
    beside = parameters.stray_beside
    if len(cloud.points_m) <= beside:
        return cloud
    tree, count = cKDTree(cloud.points_m), len(cloud.points_m)
    reach = np.empty(count, dtype=np.float32)
    index = np.empty((count, beside), dtype=np.int32)
    for first in range(0, count, parameters.at_once):
        some = slice(first, first + parameters.at_once)
        away, near = tree.query(cloud.points_m[some], k=beside + 1, workers=-1)
        reach[some], index[some] = np.asarray(away)[:, -1], np.asarray(near)[:, 1:]
    del tree
    keep = np.empty(count, dtype=bool)
    for first in range(0, count, parameters.at_once):
        some = slice(first, first + parameters.at_once)
        usual = np.median(reach[index[some]], axis=1)
        keep[some] = reach[some] <= parameters.stray_factor * usual
    return _chosen(cloud, keep)


def _chosen(cloud: DenseCloud, keep: NDArray[np.bool_]) -> DenseCloud:
    return DenseCloud(
        cloud.points_m[keep], cloud.normals[keep], cloud.colours[keep], cloud.views[keep]
    )
