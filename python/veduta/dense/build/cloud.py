"""One cloud of what all depth maps show, each spot once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

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
    """

    most_px: float = 2.0
    most_share: float = 0.01
    stray_beside: int = 6
    stray_factor: float = 4.0


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
) -> DenseCloud:
    """Every spot that `least` views show, from the view that comes first.

    links: for each view with a depth map, those that it is compared with.
    """
    used = {
        view: np.zeros((views.cameras[view].height_px, views.cameras[view].width_px), dtype=bool)
        for view in links
    }
    parts = []
    for view in sorted(links):
        shown = [view, *(one for one in links[view] if one in links)]
        maps = [depth_map(one) for one in shown]
        *found, taken = _core.fuse_depths(
            [one.depths_m for one in maps],
            np.stack([camera_row(views.cameras[one]) for one in shown]),
            [one.normals for one in maps],
            [views.pixels(one).reshape(-1, 3) for one in shown],
            [used[one] for one in shown],
            most_px=parameters.most_px,
            most_share=parameters.most_share,
            least=min(least, len(shown)),
        )
        for one, pixels in zip(shown, taken, strict=True):
            used[one].ravel()[pixels] = True
        parts.append(found)
    columns = [np.concatenate(column) for column in zip(*parts, strict=True)]
    return DenseCloud(columns[0], columns[1], columns[2], columns[3])


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
    found = cKDTree(cloud.points_m).query(cloud.points_m, k=beside + 1, workers=-1)
    away, index = (np.asarray(one) for one in found)
    reach = away[:, -1]
    usual = np.median(reach[index[:, 1:]], axis=1)
    return _chosen(cloud, np.asarray(reach <= parameters.stray_factor * usual))


def _chosen(cloud: DenseCloud, keep: NDArray[np.bool_]) -> DenseCloud:
    return DenseCloud(
        cloud.points_m[keep], cloud.normals[keep], cloud.colours[keep], cloud.views[keep]
    )
