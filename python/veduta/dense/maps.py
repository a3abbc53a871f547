"""What the cloud says of the walls and of the ground: rasters for whoever goes on with them."""

from __future__ import annotations

import json

import numpy as np
from PIL import Image

from veduta.cameras import CameraSet
from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.elevation import ElevationParameters, wall_depth
from veduta.dense.build.ground_map import ground_map, write_maps
from veduta.dense.build.showing import share_picture
from veduta.dense.document import Elevation
from veduta.run.page import Table
from veduta.run.work import Work

WALLS = "walls"
DSM, ORTHO = "dsm.tif", "orthophoto.tif"


def write_maps_of(
    work: Work,
    cloud: DenseCloud,
    cameras: CameraSet,
    walls: list[Elevation],
    parameters: ElevationParameters,
) -> None:
    """Elevations of the walls that there are; surface model and orthophoto where there is a CRS."""
    if walls:
        with work.step("elevations") as step:
            step.counts["walls"] = _elevations(work, cloud, cameras.scale, walls, parameters)
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
    cloud: DenseCloud,
    scale: str,
    walls: list[Elevation],
    parameters: ElevationParameters,
) -> int:
    (work.folder / WALLS).mkdir(exist_ok=True)
    rows: list[list[str | int | float | bool | None]] = []
    for wall in walls:
        found = wall_depth(cloud.points_m, wall, parameters)
        known = np.isfinite(found.depths_m)
        if not known.any():
            work.note(f"No point lies on wall {wall.id}: it has no elevation.")
            continue
        stem = work.folder / WALLS / f"{wall.id}_depth"
        picture = Image.fromarray(found.depths_m, mode="F")
        picture.save(stem.with_suffix(".tif"), compression="tiff_lzw")
        told = {
            "schema": "veduta/elevation",
            "version": 1,
            "unit": scale,
            "wall": wall.id,
            "units_per_px": wall.pixel_m,
            "left": wall.left_m,
            "upper": wall.upper_m,
            "cell_px": found.cell_px,
        }
        stem.with_suffix(".json").write_text(json.dumps(told, indent=1) + "\n")
        low, high = (float(one) for one in np.nanquantile(found.depths_m, [0.02, 0.98]))
        share = round(100.0 * float(known.mean()), 1)
        rows.append([wall.id, share, found.cell_px, round(low, 3), round(high, 3)])
        note = f"from {low:.2f} (blue, behind the wall's plane) to {high:.2f} (red, before it)"
        shown = share_picture((found.depths_m - low) / max(high - low, 1e-9), known)
        work.picture(f"Wall {wall.id}", note, shown)
    columns = ("wall", "known, %", "cell, px", "2 % lie behind", "2 % lie before")
    work.table(Table("Elevations with depth", columns, rows))
    if rows:
        work.file("walls/", "elevations: distance from each wall's plane, on its picture's pixels")
    return len(rows)
