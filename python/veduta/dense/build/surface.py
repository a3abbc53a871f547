"""A surface where the depth maps agree that there is one; where none saw, it ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.dense.document import DepthMap, Views, camera_row
from veduta.run.errors import NotFoundError
from veduta.surfaces import compact, vertex_pieces


@dataclass(frozen=True)
class SurfaceParameters:
    """voxel_px: side of a voxel where none is given, in pixels at the middle depth. truncation:
    voxels before and behind a surface. least_weight: sum of confidences that a voxel must have.
    coarser: by which voxels grow where memory does not suffice. least_share: parts of the mesh with
    fewer triangles (of all) are dropped, unless they have as many as large_triangles, and always with
    fewer than least_triangles.
    """

    voxel_px: float = 1.4
    truncation: float = 5.0
    least_weight: float = 0.6
    coarser: float = 1.4
    least_share: float = 0.01
    least_triangles: int = 60
    large_triangles: int = 40_000


@dataclass(frozen=True, eq=False)
class RawSurface:
    """points_m: (v, 3) float64 world. triangles: (m, 3) uint32, counter-clockwise seen from the
    cameras. voxel_m: as it came to be. dropped: triangles of small loose parts.
    """

    points_m: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    voxel_m: float
    dropped: int = 0


def natural_voxel_m(
    views: Views, depth_map: Callable[[int], DepthMap], order: list[int], voxel_px: float
) -> float:
    """What a pixel covers at the middle depth (m), times voxel_px."""
    sizes = []
    for view in order:
        depths = depth_map(view).depths_m
        known = depths[np.isfinite(depths)]
        if known.size:
            sizes.append(float(np.median(known)) / views.cameras[view].focal_px[0])
    if not sizes:
        raise NotFoundError("a surface", "no depth is known", "Give photos that overlap more.")
    return float(np.median(sizes)) * voxel_px


def build_surface(
    views: Views,
    depth_map: Callable[[int], DepthMap],
    order: list[int],
    voxel_m: float,
    most_blocks: int,
    parameters: SurfaceParameters,
) -> RawSurface:
    """Signed distances from all depth maps, and surface nets over them.

    most_blocks: of 8 x 8 x 8 voxels; where more would be needed, voxels grow.
    """
    while True:
        try:
            volume = _filled(views, depth_map, order, voxel_m, most_blocks, parameters)
        except _core.StereoFault as fault:
            if "blocks" not in str(fault):
                raise
            voxel_m *= parameters.coarser
            continue
        points, triangles = volume.surface(parameters.least_weight)
        del volume
        return _without_crumbs(RawSurface(points, triangles, voxel_m), parameters)


def _filled(
    views: Views,
    depth_map: Callable[[int], DepthMap],
    order: list[int],
    voxel_m: float,
    most: int,
    parameters: SurfaceParameters,
) -> _core.DepthVolume:
    volume = _core.DepthVolume(voxel_m, parameters.truncation, most)
    for view in order:
        known = depth_map(view)
        volume.add(known.depths_m, camera_row(views.cameras[view]), known.confidence)
    return volume


def _without_crumbs(surface: RawSurface, parameters: SurfaceParameters) -> RawSurface:
    """Without loose parts of a few triangles, and without vertices that nothing uses."""
    faces = surface.triangles
    if not len(faces):
        reason = "no surface is seen by enough photos at one spot"
        raise NotFoundError("a surface", reason, "Give more photos, or --agree 1.")
    sizes = part_sizes(faces, len(surface.points_m))
    share = min(parameters.least_share * len(faces), parameters.large_triangles)
    least = max(parameters.least_triangles, share)
    kept = faces[sizes >= min(least, sizes.max())]
    points, triangles = compact(surface.points_m, kept)
    return RawSurface(points, triangles, surface.voxel_m, len(faces) - len(kept))


def part_sizes(faces: NDArray[np.integer], vertices: int) -> NDArray[np.int32]:
    """(m,) how many triangles hang together with each, by vertices that they share."""
    part = vertex_pieces(faces, vertices)
    own = part[faces[:, 0]]
    counts = np.bincount(own, minlength=part.max() + 1)
    return np.asarray(counts[own], dtype=np.int32)


def cut_surface(surface: RawSurface, box: tuple[float, ...]) -> RawSurface:
    """The triangles wholly in a box: xmin ymin zmin xmax ymax zmax (m). NotFoundError if none is."""
    low, high = np.array(box[:3]), np.array(box[3:])
    between = (surface.points_m >= low) & (surface.points_m <= high)
    inside = np.asarray(between.all(axis=1))
    kept = surface.triangles[inside[surface.triangles].all(axis=1)]
    if not len(kept):
        raise NotFoundError("a surface", "none lies in the box", "Give a larger --box.")
    points, triangles = compact(surface.points_m, kept)
    return RawSurface(points, triangles, surface.voxel_m, surface.dropped)
