"""Booleans of random solids beside manifold3d, which is installed by hand.

The pairs and the volumes that `veduta-geometry` finds come from its own test, whose generator has
pairs whose faces lie on each other, or nearly.
"""

from __future__ import annotations

import importlib
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from veduta._core import triangulate_polygons

PAIRS = 4000
NEAR = 1e-4
"""The share of both volumes that may lie between the two: solids nearly on each other differ."""


def solid(mesh: dict[str, Any]) -> Any:
    """A mesh of polygons with holes as a manifold."""
    manifold3d = importlib.import_module("manifold3d")
    rings = [ring for face in mesh["faces"] for ring in face]
    points = np.asarray(mesh["points"], dtype=np.float64)
    centre = points.mean(axis=0)
    corners = np.concatenate([np.asarray(ring, dtype=np.int64) for ring in rings])
    ring_offsets = np.cumsum([0] + [len(ring) for ring in rings])
    face_offsets = np.cumsum([0] + [len(face) for face in mesh["faces"]])
    found = triangulate_polygons(points[corners] - centre, ring_offsets, face_offsets, 1e-6)
    triangles = corners[np.asarray(found[0])]
    made = manifold3d.Mesh64(vert_properties=points - centre, tri_verts=triangles.astype(np.uint64))
    return manifold3d.Manifold(made).translate(tuple(centre))


def main(path: Path) -> None:
    """Prints how many volumes agree, by kind of pair."""
    counts: Counter[tuple[str, str]] = Counter()
    for line in path.read_text().splitlines():
        pair = json.loads(line)
        kind = pair["kind"]
        if pair["volumes"] is None:
            counts[kind, "refused"] += 1
            continue
        a, b = solid(pair["a"]), solid(pair["b"])
        if a.is_empty() or b.is_empty():
            counts[kind, "not taken by manifold3d"] += 1
            continue
        truth = [(a + b).volume(), (a - b).volume(), (a ^ b).volume()]
        off = np.abs(np.subtract(truth, pair["volumes"])).max() / (a.volume() + b.volume())
        counts[kind, "agree" if off < NEAR else "differ"] += 1
        if off >= NEAR:
            print(f"pair {pair['pair']} ({kind}): {pair['volumes']} here, {truth} there")
    for (kind, what), count in sorted(counts.items()):
        print(f"{kind:28} {what:24} {count}")


def written(folder: Path) -> Path:
    """The pairs, as the test of the crate writes them."""
    path = folder / "pairs.jsonl"
    test = ["cargo", "test", "--quiet", "-p", "veduta-geometry", "--test", "booleans_random"]
    told = {"BOOLEANS_TO": str(path), "FUZZ_CASES": str(PAIRS)}
    # It fails where a pair is refused; the table says so.
    subprocess.run(test, env=os.environ | told, check=False, stdout=subprocess.DEVNULL)
    return path


if __name__ == "__main__":
    if importlib.util.find_spec("manifold3d") is None:
        print("skipped: `pip install manifold3d` for a second opinion on booleans")
        sys.exit(0)
    with tempfile.TemporaryDirectory() as folder:
        main(Path(sys.argv[1]) if len(sys.argv) > 1 else written(Path(folder)))
