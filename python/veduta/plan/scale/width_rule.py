"""The paper's width rule: areas in rooms whose outline is not known (FPSE, AV3D).

The width of the room is the free run of paper through the text, between inked walls.
"""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import Text
from veduta.plan.scale.evidence import Hypothesis, Voter
from veduta.plan.scale.quantities import read_quantities

WIDTH_RULE = 0.68
"""Depth of a room over its width (the paper: width = sqrt(area / 0.68); 17 m2 are 5 m wide)."""
_SIGMA = 0.2  # rooms of 1:1 to 1:2 lie within one and a half of these


def width_rule_voters(
    texts: list[Text], rooms_px: list[NDArray[np.float64]], ink: NDArray[np.float32]
) -> list[Voter]:
    """A weak vote for each area that stands in no known room, where its room has two sides."""
    rooms = [Polygon(outline) for outline in rooms_px]
    inked = (ink > 0.5).astype(np.uint8)
    walls = np.asarray(cv2.erode(inked, np.ones((3, 3), np.uint8)), dtype=np.uint8)
    voters = []
    for text in texts:
        areas = [one for one in read_quantities(text.text) if one.kind == "area"]
        at = np.mean(text.box_px, axis=0)
        if not areas or any(room.contains(Point(at)) for room in rooms):
            continue
        width = _free_run(walls, text)
        if width is not None:
            metres = math.sqrt(areas[0].values[0] / WIDTH_RULE)
            reading = Hypothesis(math.log(metres / width), _SIGMA, 0.5 * areas[0].trust)
            place = f"around ({at[0]:.0f}, {at[1]:.0f})"
            voters.append(Voter("area", text.text, place, (reading,), mass=0.3 * text.score))
    return voters


def _free_run(walls: NDArray[np.uint8], text: Text) -> float | None:
    """Pixels between the walls left and right of a text; None where one side has none."""
    box = np.asarray(text.box_px)
    row = int(np.clip(box[:, 1].mean(), 0, walls.shape[0] - 1))
    left, right = int(max(box[:, 0].min(), 0)), int(box[:, 0].max())
    before = np.nonzero(walls[row, :left])[0]
    after = np.nonzero(walls[row, right:])[0]
    if not len(before) or not len(after):
        return None
    return float(right + after[0] - before[-1])
