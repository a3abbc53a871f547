"""A bowl whose hollow no silhouette shows: what its colours carve, beside the truth.

`python benchmarks carve/bowl [--no-keep]` renders it, and keeps
`benchmarks/results/carve-bowl.md`.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from painted_bowl import HOLLOW, INNER, VOLUME, bowl_views
from record import Row, keep_or_print

from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.consistency import carve_by_colour
from veduta.carve.build.hull import carve_hull, root_of
from veduta.carve.build.measures import measure_mesh


def measured(size: int, levels: int, grain_m: float) -> Row:
    """A row of one size of photos and of the stone's grains."""
    views = bowl_views(size, grain_m)
    hull = carve_hull(views, root_of(find_bounds(views), levels))
    began = time.perf_counter()
    found = carve_by_colour(hull, views)
    seconds = time.perf_counter() - began
    at = np.argwhere(found.carved) * found.root.voxel_m + found.root.low_m
    centres = at + 0.5 * found.root.voxel_m
    hollow = (np.linalg.norm(centres, axis=1) < INNER) & (centres[:, 2] < 0.0)
    before = measure_mesh(*hull.surface(), views).volume
    after = measure_mesh(*found.hull.surface(), views).volume
    return {
        "photos px": size,
        "grains m": grain_m,
        "voxels": 2**found.root.levels,
        "volume m3": VOLUME,
        "hull's error %": 100.0 * (before / VOLUME - 1.0),
        "carved, error %": 100.0 * (after / VOLUME - 1.0),
        "of the hollow carved": float(hollow.sum()) * found.root.voxel_m**3 / HOLLOW,
        "of the carved hollow": float(hollow.mean()) if len(hollow) else None,
        "sweeps": len(found.carved_by_sweep),
        "s": seconds,
    }


def main() -> None:
    """Measure, and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    rows = [measured(240, 6, 0.12), measured(240, 6, 0.24), measured(400, 7, 0.12)]
    notes = [
        "66 photos on five rings, noise of 2 grey levels. Grains: half a wave of the colours.",
        "Nothing was tuned by it but the number of sweeps, which must reach its bottom.",
    ]
    keep_or_print("carve-bowl", rows, notes, not given.no_keep)


if __name__ == "__main__":
    main()
