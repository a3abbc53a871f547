"""`plans/uk-dimensions`: two flats whose rooms' sizes are printed, in metres and in feet."""

from __future__ import annotations

import re
import statistics
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from plan_data import PLANS, picture
from plan_reading import read_plans
from plan_truth import Layout, found_layout
from record import Row
from shapely import unary_union
from shapely.geometry import Polygon

from veduta.plan.document import ScaleEvidence, Storey
from veduta.synthetic.plans import curves
from veduta.synthetic.plans.house import Wall

PRINTED: Mapping[str, tuple[tuple[str, str], ...]] = {
    "45719584.jpg": (
        ("2.55 x 2.50", "8'4 x 8'2"), ("4.76 x 3.79", "15'7 x 12'5"),
        ("2.55 x 2.23", "8'4 x 7'4"), ("3.72 x 3.00", "12'2 x 9'10"),
        ("3.97 x 3.61", "13'0 x 11'10"),
    ),
    "47541863.jpg": (
        ("15'9 x 10'0", "4.81 x 3.06"), ("12'6 x 8'0", "3.82 x 2.45"),
        ("16'2 x 14'10", "4.94 x 4.53"), ("14'3 x 8'0", "4.35 x 2.45"),
        ("12'0 x 11'1", "3.67 x 3.39"), ("10'0 x 8'7", "3.06 x 2.62"),
    ),
}  # fmt: skip
"""What is printed in each room, as one reads it."""
GROSS_M2: Mapping[str, float] = {"47541863.jpg": 82.0}
"""Printed gross internal area."""
TOLERANCE = 0.03
Value = str | int | float | bool | None


def rows(jobs: int, pictures: Path | None) -> list[Row]:
    """Asked for: each room's size within 3 % of what the others' scale says, and the gross area."""
    paths = [PLANS / "uk-dimensions" / name for name in PRINTED]
    table: list[Row] = []
    for path, reading in zip(paths, read_plans(paths, jobs), strict=True):
        row: dict[str, Value] = {
            "set": "uk-dimensions",
            "part": path.stem,
            "not read": int(reading.storey is None),
            "rooms printed": len(PRINTED[path.name]),
            "seconds": reading.seconds,
        }
        found: Layout | None = None
        px_from_m = np.eye(3)
        if reading.storey is not None:
            evidence = reading.storey.scale.evidence
            errors = leave_one_out(evidence, PRINTED[path.name])
            row["sizes predicted"] = len(errors)
            row["sizes within 3 %"] = sum(error <= TOLERANCE for error in errors)
            row["size error (largest)"] = max(errors, default=None)
            if path.name in GROSS_M2:
                row["gross area error"] = gross_area_m2(reading.storey) / GROSS_M2[path.name] - 1
            scale = 1.0 / reading.storey.scale.metres_per_px
            px_from_m = np.diag([scale, -scale, 1.0])
            found = found_layout(reading.storey, px_from_m, single_line=False)
        table.append(row)
        if pictures is not None:
            picture(path, path.stem, found, None, px_from_m, pictures)
    return table


def leave_one_out(
    evidence: Sequence[ScaleEvidence], printed: Sequence[tuple[str, str]]
) -> list[float]:
    """For each room with evidence: how far the others' scale is from what its size says.

    A room printed twice, in metres and in feet, is left out as a whole.
    """
    sizes = [item for item in evidence if item.kind == "dimension"]
    by_room = [[item for item in sizes if _same(item.text, texts)] for texts in printed]
    errors = []
    for index, own in enumerate(by_room):
        others = [
            item.metres_per_px for at, group in enumerate(by_room) if at != index for item in group
        ]
        if own and others:
            said = statistics.median(item.metres_per_px for item in own)
            errors.append(abs(statistics.median(others) / said - 1))
    return errors


def _same(text: str, printed: Sequence[str]) -> bool:
    """Whether the digits are those printed: marks of feet and inches are easily misread."""
    digits = re.sub(r"\D", "", text)
    return any(digits == re.sub(r"\D", "", one) for one in printed)


def gross_area_m2(storey: Storey) -> float:
    """Rooms and the walls between them, in the document's own metres."""
    at = {junction.id: junction.at_m for junction in storey.junctions}
    inner = [
        Wall(wall.id, at[wall.start], at[wall.end], wall.bulge, wall.thickness_m, None, None)
        for wall in storey.walls
        if not wall.outer and at[wall.start] != at[wall.end]
    ]
    rooms = [Polygon(room.outline_m).buffer(0) for room in storey.rooms if not room.outdoors]
    bands = [curves.band(wall, 0.0, curves.wall_length(wall)) for wall in inner]
    return float(unary_union([*rooms, *bands]).area)
