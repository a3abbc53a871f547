"""Drawings of a structure: walls that stand apart are one plan, whatever strips part them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from veduta.plan.analyse import read_drawings
from veduta.plan.document import Storey, Wall
from veduta.plan.options import PlanOptions
from veduta.plan.pages import find_drawings
from veduta.run.progress import no_progress

THICK_PX = 30


def tees(path: Path) -> Path:
    """Two hollow walls with a stem each, one below the other: ends are free, no room closes."""
    walls = np.zeros((1500, 1400), dtype=bool)
    for top in (150, 850):
        walls[top : top + THICK_PX, 150:1200] = True
        walls[top : top + 450, 650 : 650 + THICK_PX] = True
    inside = walls.copy()
    for axis in (0, 1):
        for step in (-3, 3):
            inside &= np.roll(walls, step, axis)
    Image.fromarray(np.where(walls & ~inside, 0, 255).astype(np.uint8)).convert("RGB").save(path)
    return path


def test_walls_that_close_no_room_are_one_storey(tmp_path: Path) -> None:
    read = read_drawings(find_drawings([tees(tmp_path / "a.png")]), PlanOptions(), [], no_progress)
    (storey,) = read.document.storeys
    upright = [wall for wall in storey.walls if _upright(storey, wall)]
    assert len(upright) == 2
    assert storey.rooms == []
    assert any("bearing walls" in doubt for doubt in storey.doubts)


def _upright(storey: Storey, wall: Wall) -> bool:
    ends = {one.id: one.at_m for one in storey.junctions}
    (x, y), (u, v) = ends[wall.start], ends[wall.end]
    return abs(v - y) > abs(u - x)
