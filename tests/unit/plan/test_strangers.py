"""The sheets of strangers: what is drawn is what their truth says."""

from __future__ import annotations

import numpy as np
import pytest
from shapely.geometry import Polygon

from veduta.synthetic.plans.strangers import FAMILIES, Family, strangers_sheet


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", [31_000, 31_001, 31_002])
def test_walls_lie_where_the_truth_has_them(family: Family, seed: int) -> None:
    picture, truths = strangers_sheet(seed, family)
    assert len(truths) == (1 if family == "plot" else 2)
    grey = picture.mean(axis=2)
    paper = float(np.median(grey))
    for truth in truths:
        to_px = truth.px_from_m
        shares = []
        for wall in truth.storey.walls:
            openings = [one for one in truth.storey.openings if one.wall == wall.id]
            if wall.bulge or openings:
                continue
            middle = (np.array(wall.start_m) + np.array(wall.end_m)) / 2.0
            column, row = (to_px[:2, :2] @ middle + to_px[:2, 2]).astype(int)
            shares.append(grey[row, column] < paper - 60)
        assert np.mean(shares) > 0.95
        outlines = [Polygon(room.outline_m).area for room in truth.storey.rooms]
        assert min(outlines) > 0.5


def test_the_same_seed_gives_the_same_sheet() -> None:
    first, second = (strangers_sheet(31_005, "plot")[0] for _ in range(2))
    assert (first == second).all()
