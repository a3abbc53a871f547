"""What a click costs in a town of tiles, without and with trees over its triangles.

`python benchmarks studio/picking FOLDER` serves the place and asks `picking.mjs` from above,
along a street and before a front; keeps `benchmarks/results/studio-picking.md`.
"""

from __future__ import annotations

import argparse
import json
import subprocess
from pathlib import Path

from loading import HERE, ROOT, served
from record import Row, record

VIEWS = {
    "from above": "",
    "along a street": "mode=walk&eye=300,34,1.7&to=301,34,1.7&off=&hour=12",
    "before a front": "mode=walk&eye=300,34,1.7&to=300.3,35,1.9&off=&hour=12",
}
"""Of a town whose first street runs eastward at y = 34 m."""
NOTES = (
    "Chromium, 1280x720: the rays of a grid of points, by the tiles' boxes and then triangle by"
    " triangle, as `Town.firstHit` does. ms: of the page, on a machine that did other things, too.",
    "tree_of_200000_ms: how long a tree (three-mesh-bvh) over 200,000 triangles takes to grow. A"
    " pick by trees would grow one for each tile that it meets before it can answer, or keep one"
    " for each tile that comes, though a town is asked only where somebody clicks.",
)


def main() -> None:
    """Measure and keep."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("place", type=Path)
    place = parser.parse_args().place
    rows: list[Row] = []
    for name, view in VIEWS.items():
        with served(place) as address:
            call: list[str | Path] = ["node", HERE / "picking.mjs", ROOT / "studio", address, view]
            done = subprocess.run(call, capture_output=True, text=True, check=True)
        told: dict[str, float] = json.loads(done.stdout)
        rows.append({"view": name, **{key: round(value, 2) for key, value in told.items()}})
        print(rows[-1], flush=True)
    record("studio-picking", rows, NOTES)


if __name__ == "__main__":
    main()
