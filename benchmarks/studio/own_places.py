"""A place of each kind, made without any data, for what measures the studio."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import cv2
import numpy as np
from nadir_village import write_survey
from numpy.typing import NDArray

VEDUTA = Path(sys.executable).parent / "veduta"

LOT_M = (14.0, 12.0)
STREET_M = 14.0
"""Between two rows of lots that face each other; the rows behind stand back to back."""
WALL, INNER = 14, 10
"""Thickness of the walls on the drawing (pixels)."""


def own_places(folder: Path, kinds: Iterable[str]) -> dict[str, Path]:
    """The folders of places by their kinds; those that are there already are taken as they are.

    CalledProcessError where a verb fails.
    """
    made = {}
    for kind in kinds:
        own = folder / kind.replace(" ", "-").replace(",", "")
        own.mkdir(parents=True, exist_ok=True)
        made[kind] = KINDS[kind](own)
    return made


def _call(out: Path, place: Path, *words: str | Path) -> Path:
    """The place that a verb writes below `out`; nothing is done where it is there."""
    if not (place / "place.json").exists():
        subprocess.run([VEDUTA, *words, "-o", out], check=True, capture_output=True)
    return place


def _facade(folder: Path) -> Path:
    out = folder / "demo"
    return _call(out, out / "place", "demo")


def _house(folder: Path) -> Path:
    drawing = folder / "plan.png"
    cv2.imwrite(str(drawing), _drawing())
    return _call(folder / "out", folder / "out", "plan", drawing)


def _street(folder: Path) -> Path:
    return _call(folder / "out", folder / "out", "grammar", "derive", "haussmann")


def _lots_of(count: int, along: int) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        lots = folder / "lots.geojson"
        lots.write_text(json.dumps(_lots(count, along)))
        out = folder / "out"
        return _call(out, out, "grammar", "derive", "haussmann", "--lots", lots)

    return make


def _photos(folder: Path) -> Path:
    survey = folder / "photos"
    if not survey.exists():
        survey.mkdir()
        write_survey(survey, seed=1)
    return _call(folder / "out", folder / "out", "photos", survey)


def _walk(folder: Path) -> Path:
    out = folder / "demo"
    return _call(out, out / "walk", "demo", "--walk")


KINDS: dict[str, Callable[[Path], Path]] = {
    "facade": _facade,
    "house": _house,
    "street of 14": _street,
    "60 lots": _lots_of(60, 30),
    "town of 2,000": _lots_of(2000, 40),
    "photos": _photos,
    "walk": _walk,
}
"""A town, photos and a walk take some minutes of a core each, the others less than one."""


def _lots(count: int, along: int) -> dict[str, object]:
    """Rows of so many lots each, two and two along a street."""
    wide, deep = LOT_M
    features = []
    for number in range(count):
        row, x = number // along, wide * (number % along)
        y = (row // 2) * (2 * deep + STREET_M) + (row % 2) * (deep + STREET_M)
        ring = [[x, y], [x + wide, y], [x + wide, y + deep], [x, y + deep], [x, y]]
        features.append(
            {
                "type": "Feature",
                "properties": {"id": f"lot-{number}", "height": 18.0 + number % 5},
                "geometry": {"type": "Polygon", "coordinates": [ring]},
            }
        )
    return {"type": "FeatureCollection", "features": features}


def _drawing() -> NDArray[np.uint8]:
    """A storey of three rooms with doors and windows, black on white."""
    page = np.full((700, 900, 3), 255, dtype=np.uint8)
    left, top, right, bottom = 100, 100, 800, 600
    outside = [
        (left, top, right, top + WALL), (left, bottom - WALL, right, bottom),
        (left, top, left + WALL, bottom), (right - WALL, top, right, bottom),
    ]  # fmt: skip
    inside = [
        (440, top, 440 + INNER, 330), (440, 390, 440 + INNER, bottom),
        (left, 340, 250, 340 + INNER), (310, 340, 440, 340 + INNER),
    ]  # fmt: skip
    for x0, y0, x1, y1 in outside + inside:
        cv2.rectangle(page, (x0, y0), (x1, y1), (0, 0, 0), -1)
    cv2.rectangle(page, (200, bottom - WALL - 2), (260, bottom + 2), (255, 255, 255), -1)
    doors = [
        ((200, 586), -90, (200, 526)),
        ((450, 390), -90, (510, 390)),
        ((250, 350), 0, (250, 410)),
    ]
    for hinge, start_deg, end in doors:
        cv2.ellipse(page, hinge, (60, 60), 0, start_deg, start_deg + 90, (0, 0, 0), 2)
        cv2.line(page, hinge, end, (0, 0, 0), 2)
    for x in (180, 340, 560, 680):
        cv2.rectangle(page, (x, top), (x + 70, top + WALL), (255, 255, 255), -1)
        cv2.rectangle(page, (x, top), (x + 70, top + WALL), (0, 0, 0), 2)
        cv2.line(page, (x, top + WALL // 2), (x + 70, top + WALL // 2), (0, 0, 0), 2)
    return page
