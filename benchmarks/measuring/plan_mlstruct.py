"""`plans/mlstruct`: two large plans whose truth is rectangles of structural walls."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from plan_data import PLANS, picture
from plan_reading import read_plans
from plan_scores import iou
from plan_truth import Affine, Layout, found_layout
from record import Row
from shapely import unary_union
from shapely.geometry import Polygon


def truths() -> list[tuple[Path, Affine, Layout]]:
    """Each plan with its affine from the truth's metres to pixels, and its walls."""
    folder = PLANS / "mlstruct"
    fields = json.loads((folder / "fp.json").read_text())
    found = []
    for number, floor in fields["floor"].items():
        scale = float(floor["scale"])  # pixel = (x, -y) * scale
        walls = unary_union(
            [
                Polygon(list(zip(wall["x"], wall["y"], strict=True))).convex_hull
                for wall in fields["rect"].values()
                if str(wall["floorID"]) == number
            ]
        )
        px_from_m = np.diag([scale, -scale, 1.0])
        found.append(
            (folder / floor["image"], px_from_m, Layout(walls, walls, (), (), 1.0 / scale))
        )
    return found


def rows(jobs: int, pictures: Path | None) -> list[Row]:
    """Recall and IoU of walls: asked for is 0.90 of the first on both plans."""
    known = truths()
    readings = read_plans([path for path, _, _ in known], jobs)
    table: list[Row] = []
    for (path, px_from_m, true), reading in zip(known, readings, strict=True):
        found = None
        if reading.storey is not None:
            found = found_layout(reading.storey, px_from_m, single_line=False)
        row: dict[str, str | int | float | bool | None] = {
            "set": "mlstruct",
            "part": path.stem[:8],
            "not read": int(found is None),
            "wall recall": 0.0,
            "wall IoU": 0.0,
            "seconds": reading.seconds,
        }
        if found is not None:
            row["wall recall"] = found.solid.intersection(true.solid).area / true.solid.area
            row["wall IoU"] = iou(found.solid, true.solid)
        table.append(row)
        if pictures is not None:
            words = f"recall {row['wall recall']:.2f} IoU {row['wall IoU']:.2f}"
            picture(path, words, found, true, px_from_m, pictures)
    return table
