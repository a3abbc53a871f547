"""What the canvas of plans draws is as large as it is told."""

from __future__ import annotations

import numpy as np
import pytest
from shapely.geometry import box

from veduta.synthetic.plans.canvas import Canvas


@pytest.mark.parametrize("thick_m", [0.1, 0.137, 0.3, 0.02])
def test_walls_are_as_thick_as_they_are(thick_m: float) -> None:
    canvas = Canvas((0.0, 0.0, 2.0, 2.0), 0.01, (255, 255, 255))
    canvas.fill(box(0.703, 0.5, 0.703 + thick_m, 1.5), (0, 0, 0))
    ink = 1.0 - canvas.picture()[60:140].astype(np.float64).mean(axis=2) / 255.0
    assert ink.sum(axis=1).mean() == pytest.approx(100.0 * thick_m, abs=0.15)
