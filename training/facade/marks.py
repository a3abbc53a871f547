"""Rectangles that were marked by hand in pictures of the training sets (`marks.json`)."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from classes import place
from numpy.typing import NDArray

MARKS = Path(__file__).with_name("marks.json")


def apply_marks(name: str, sets: NDArray[np.uint8], ids: NDArray[np.uint16]) -> None:
    """Write the marks of a picture into its labels, in place.

    A mark is [class, x0, y0, x1, y1] in percent of the picture's width and height.
    """
    height, width = sets.shape
    for kind, *box in _marks().get(name, []):
        x0, x1 = (round(v * width / 100) for v in box[0::2])
        y0, y1 = (round(v * height / 100) for v in box[1::2])
        sets[y0:y1, x0:x1] = place(kind)
        ids[y0:y1, x0:x1] = 0


def _marks() -> dict[str, list[tuple[str, float, float, float, float]]]:
    if not MARKS.exists():
        return {}
    marks: dict[str, list[tuple[str, float, float, float, float]]] = json.loads(MARKS.read_text())
    return marks
