"""What the cloud says of the walls and of the ground: rasters for whoever goes on with them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image

from veduta.cameras import Camera, CameraSet
from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.elevation import ElevationParameters, wall_depth, wall_detail_m
from veduta.dense.build.ground_map import ground_map, write_maps
from veduta.dense.build.showing import share_picture
from veduta.dense.document import Elevation
from veduta.run.page import Table
from veduta.run.work import Work

WALLS = "walls"
DSM, ORTHO = "dsm.tif", "orthophoto.tif"


@dataclass(frozen=True, eq=False)
class Lenses:
    """The cameras at the size at which depths are found, and the window that these are found by."""

    cameras: Sequence[Camera]
    window_px: float


@dataclass(frozen=True, eq=False)
class _Given:
    cloud: DenseCloud
    scale: str
    lenses: Lenses


def write_maps_of(
    work: Work,
    cloud: DenseCloud,
    cameras: CameraSet,
    walls: list[Elevation],
    lenses: Lenses,
    parameters: ElevationParameters,
) -> None:
    """Elevations of the walls that there are; surface model and orthophoto where there is a CRS."""
    if walls:
        with work.step("elevations") as step:
            given = _Given(cloud, cameras.scale, lenses)
            step.counts["walls"] = _elevations(work, given, walls, parameters)
    if cameras.crs is not None:
        with work.step("surface model") as step:
            found = ground_map(cloud, 0)
            folder = work.folder
            write_maps(found, cameras.crs, cameras.origin_m, folder / DSM, folder / ORTHO)
            step.counts["cell_m"] = round(found.cell_m, 4)
        work.file(DSM, "heights of the highest points (cloud-optimised GeoTIFF, NaN where unknown)")
        work.file(ORTHO, "the true orthophoto of the same cells, transparent where unknown")


def _elevations(
    work: Work,
    given: _Given,
    walls: list[Elevation],
    parameters: ElevationParameters,
) -> int:
    (work.folder / WALLS).mkdir(exist_ok=True)
    rows: list[list[str | int | float | bool | None]] = []
    for wall in walls:
        points, lenses = given.cloud.points_m, given.lenses
        found = wall_depth(points, wall, parameters)
        known = np.isfinite(found.depths_m)
        if not known.any():
            work.note(f"No point lies on wall {wall.id}: it has no elevation.")
            continue
        stem = work.folder / WALLS / f"{wall.id}_depth"
        detail = wall_detail_m(points, wall, lenses.cameras, lenses.window_px, parameters)
        picture = Image.fromarray(found.depths_m, mode="F")
        picture.save(stem.with_suffix(".tif"), compression="tiff_lzw")
        told = {
            "schema": "veduta/elevation",
            "version": 1,
            "unit": given.scale,
            "wall": wall.id,
            "units_per_px": wall.pixel_m,
            "left": wall.left_m,
            "upper": wall.upper_m,
            "cell_px": found.cell_px,
            "detail": round(detail, 4),
        }
        stem.with_suffix(".json").write_text(json.dumps(told, indent=1) + "\n")
        low, high = (float(one) for one in np.nanquantile(found.depths_m, [0.02, 0.98]))
        share = round(100.0 * float(known.mean()), 1)
        rows.append(
            [wall.id, share, found.cell_px, round(detail, 3), round(low, 3), round(high, 3)]
        )
        note = f"from {low:.2f} (blue, behind the wall's plane) to {high:.2f} (red, before it)"
        shown = share_picture((found.depths_m - low) / max(high - low, 1e-9), known)
        work.picture(f"Wall {wall.id}", note, shown)
    columns = ("wall", "known, %", "cell, px", "detail", "2 % lie behind", "2 % lie before")
    work.table(Table("Elevations with depth", columns, rows))
    if rows:
        work.file("walls/", "elevations: distance from each wall's plane, on its picture's pixels")
    return len(rows)
