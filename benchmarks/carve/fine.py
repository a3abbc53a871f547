"""The hull of the dinosaur at 256 to 1,024 voxels a side: how much memory it takes.

`python benchmarks carve/fine [--most 10] [--no-keep]`: only blocks of 8 x 8 x 8 voxels that the
surface may pass have values, so that memory grows with the surface and not with the cube.
"""

from __future__ import annotations

import argparse
import resource
import time

from objects import DATA, views_of
from record import Row, keep_or_print

from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.hull import carve_hull, root_of


def peak_mb() -> float:
    """The most memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    """Carve at each size, the smallest first: the peak is that of the last."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=10)
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    views = views_of(DATA / "vgg-dino")
    bounds, before = find_bounds(views), peak_mb()
    rows: list[Row] = []
    for levels in range(8, given.most + 1):
        used = time.process_time()
        hull = carve_hull(views, root_of(bounds, levels))
        carved = time.process_time() - used
        own = peak_mb()
        _, triangles = hull.surface()
        rows.append(
            {
                "voxels a side": 2**levels,
                "a cube of 4 bytes each, MB": 4.0 * 8.0**levels / 1e6,
                "hull, processor s": carved,
                "with mesh, processor s": time.process_time() - used,
                "triangles": len(triangles),
                "peak MB with the hull": own,
                "peak MB with the mesh": peak_mb(),
            }
        )
        del hull, triangles
    notes = [
        f"With the 36 photos and silhouettes alone the process had {before:.0f} MB.",
        "The hull alone, no colours.",
    ]
    keep_or_print("carve-fine", rows, notes, not given.no_keep)


if __name__ == "__main__":
    main()
