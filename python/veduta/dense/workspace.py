"""`--colmap`: the result as a workspace that COLMAP's own dense programs go on with."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np

from veduta.dense.document import DepthMap, Views
from veduta.dense.read.sparse import SparsePoints
from veduta.formats.colmap_dense import IMAGES, KIND, STEREO, write_map, write_workspace
from veduta.formats.colmap_model import ColmapCamera, ColmapImage, ColmapPoints
from veduta.run.work import Work

FOLDER = "colmap"
LEAST_SEEN = 2
"""Photos that must show a point of the model: COLMAP takes a track of one for none."""


def write_colmap(
    work: Work,
    views: Views,
    sparse: SparsePoints,
    pictures: dict[int, Path],
    depth_map: Callable[[int], DepthMap],
) -> None:
    """Photos, cameras, sure points, maps of depths and normals, and the cloud.

    pictures: of each view with a depth map, its photo without distortion, in the work's folder.
    """
    with work.step("COLMAP workspace") as step:
        folder = work.folder / FOLDER
        order = sorted(pictures)
        images, points = _model(views, sparse, order, {one: pictures[one].name for one in order})
        cameras = {
            one.camera: _camera(views, view) for one, view in zip(images, order, strict=True)
        }
        write_workspace(folder, cameras, images, points)
        for view in order:
            name, found = pictures[view].name, depth_map(view)
            shutil.copyfile(work.folder / pictures[view], folder / IMAGES / name)
            normals = found.normals.reshape(*found.depths_m.shape, 3)
            known = np.where(found.known[..., None], normals, np.nan)
            write_map(folder / STEREO / "depth_maps" / f"{name}.{KIND}.bin", found.depths_m)
            write_map(folder / STEREO / "normal_maps" / f"{name}.{KIND}.bin", known)
        shutil.copyfile(work.folder / "cloud.ply", folder / "fused.ply")
        step.counts.update(images=len(images), points=len(points.numbers))
    work.file(f"{FOLDER}/", "a workspace of COLMAP: photos, cameras, maps of depths and normals")


def _camera(views: Views, view: int) -> ColmapCamera:
    one = views.cameras[view]
    return ColmapCamera("PINHOLE", one.width_px, one.height_px, (*one.focal_px, *one.centre_px))


def _model(
    views: Views, sparse: SparsePoints, order: list[int], names: dict[int, str]
) -> tuple[list[ColmapImage], ColmapPoints]:
    """Images and points by numbers from 1; points in the colours of the photo that shows them."""
    count = np.zeros(len(sparse.points_m), dtype=np.intp)
    for view in order:
        count[sparse.visible[view]] += 1
    kept = count >= LEAST_SEEN
    colours = np.zeros((len(count), 3), dtype=np.uint8)
    images = []
    for view in order:
        camera = views.cameras[view]
        shown = np.unique(sparse.visible[view])
        shown = shown[kept[shown]]
        places, _ = camera.project(sparse.points_m[shown])
        most = (camera.width_px - 1, camera.height_px - 1)
        at = np.clip(np.floor(places), 0, most).astype(np.intp)
        colours[shown] = views.pixels(view)[at[:, 1], at[:, 0]]
        number = view + 1
        images.append(
            ColmapImage(number, names[view], number, camera.cam_from_world, places, shown + 1)
        )
    numbers = np.flatnonzero(kept)
    return images, ColmapPoints(numbers + 1, sparse.points_m[numbers], colours[numbers])
