"""The files of a result."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.composing import place_cameras, stand_up, start_at
from veduta.dense.document import DepthMap, Views
from veduta.dense.read.neighbours import Comparison
from veduta.formats.laz import write_laz
from veduta.formats.ply_oriented import write_oriented_points
from veduta.place.place import Place
from veduta.run.work import Work

PICTURES, DEPTHS = Path("photos"), Path("depth")


def file_names(views: Views, order: list[int]) -> dict[int, str]:
    """A file's name without suffix for each view, each once."""
    found: dict[int, str] = {}
    for view in order:
        stem = Path(views.cameras[view].name).stem or f"view{view:04d}"
        safe = "".join(one if one.isalnum() or one in "-_." else "_" for one in stem)
        found[view] = safe if safe not in found.values() else f"{safe}-{view:04d}"
    return found


def write_depths(
    work: Work,
    views: Views,
    comparisons: list[Comparison],
    depth_map: Callable[[int], DepthMap],
) -> dict[int, Path]:
    """Depth maps as float TIFF, and the photos without distortion; the latter's paths."""
    for folder in (PICTURES, DEPTHS):
        (work.folder / folder).mkdir(exist_ok=True)
    pictures = {}
    for view, name in file_names(views, [one.view for one in comparisons]).items():
        found = depth_map(view)
        depths = Image.fromarray(np.asarray(found.depths_m, dtype=np.float32), mode="F")
        depths.save(work.folder / DEPTHS / f"{name}.tif", compression="tiff_lzw")
        sure = np.round(255.0 * np.clip(found.confidence, 0.0, 1.0)).astype(np.uint8)
        Image.fromarray(sure).save(work.folder / DEPTHS / f"{name}_confidence.png")
        pictures[view] = PICTURES / f"{name}.jpg"
        Image.fromarray(views.pixels(view)).save(work.folder / pictures[view], quality=92)
    work.file("depth/", "depth maps (metres along the camera's z, float TIFF) and confidences")
    work.file("photos/", "the photos without distortion, at the size of the depth maps")
    return pictures


def write_cloud(work: Work, cloud: DenseCloud) -> None:
    """All points as PLY with normals and views, and as LAZ."""
    path = work.folder / "cloud.ply"
    write_oriented_points(path, cloud.points_m, cloud.normals, cloud.colours, cloud.views)
    write_laz(cloud.points_m, cloud.colours, work.folder / "cloud.laz")
    work.file("cloud.ply", "all points with normals, colours and numbers of views")
    work.file("cloud.laz", "the same for survey software")


def write_place(
    work: Work,
    place: Place,
    views: Views,
    pictures: dict[int, Path],
    depth_m: dict[int, float],
    stand: NDArray[np.float64],
) -> None:
    """The place that the studio shows. depth_m: the middle depth of each view. stand: (4, 4)
    place_from_cameras.
    """
    place.cameras = place_cameras(views, pictures)
    place.start = start_at(views, sorted(pictures), depth_m)
    if place.parts:
        place.hidden = ("points",)  # they would lie on the mesh like dust
    stand_up(place, stand).save(work.folder)
    work.file("place.json", "the place: `veduta view` shows it")
