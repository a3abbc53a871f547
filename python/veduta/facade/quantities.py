"""Counts, areas and the ratio of windows to wall, as a table that spreadsheets read."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass

import numpy as np

from veduta.facade.document import Element, FacadeDocument
from veduta.facade.shape import area_share
from veduta.place.part import Part

QUANTITIES = "facade.csv"
_COLUMNS = ("what", "floor", "count", "area_m2", "mean_width_m", "mean_height_m", "ratio")
_COUNTED = ("window", "balcony", "door", "shop", "chimney")


@dataclass(frozen=True)
class Quantities:
    """window_to_wall: area of the windows below the eaves over that of the front to the eaves.

    glazed: the same with doors and shop fronts. front_m2: the front from the ground to the eaves.
    wall_m2: what windows, doors and shops leave of it. As found in the photo; the scale is that of
    the document.
    """

    window_to_wall: float
    glazed: float
    front_m2: float
    wall_m2: float


def quantities(document: FacadeDocument) -> Quantities:
    """The sums over a front. Openings that overlap count once."""
    front = document.facade.width_m * document.facade.height_m
    windows = _covered(document, ("window",))
    openings = _covered(document, ("window", "door", "shop"))
    share = 1.0 / max(front, 1e-9)
    return Quantities(windows * share, openings * share, front, front - openings)


def quantities_csv(document: FacadeDocument, part: Part) -> str:
    """A row for each kind of element and floor, for each in all, for the front, and each surface.

    Sizes in metres, areas in square metres: of elements as seen in the photo, of surfaces as
    built. Ratios are of the front up to the eaves.
    """
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(_COLUMNS)
    found = quantities(document)
    rows.writerow(["front", "", 1, _round(found.front_m2), *_sizes(document), 1.0])
    wall = found.wall_m2 / max(found.front_m2, 1e-9)
    rows.writerow(["wall", "", "", _round(found.wall_m2), "", "", _round(wall)])
    rows.writerow(["window to wall", "", "", "", "", "", _round(found.window_to_wall)])
    rows.writerow(["openings to wall", "", "", "", "", "", _round(found.glazed)])
    for kind in _COUNTED:
        own = [element for element in document.elements if element.class_ == kind]
        if own:
            rows.writerow(_line(kind, "all", own, found.front_m2))
        floors = sorted({e.floor for e in own}, key=lambda floor: (floor is None, floor))
        for floor in floors:
            some = [element for element in own if element.floor == floor]
            name = "roof" if floor is None else str(floor)
            rows.writerow(_line(kind, name, some, found.front_m2))
    for name, count, area in _surfaces(part):
        rows.writerow([f"surface: {name}", "", count, _round(area), "", "", ""])
    return text.getvalue()


def _covered(document: FacadeDocument, kinds: tuple[str, ...]) -> float:
    """The area (m2) of the front that elements of these kinds cover, below the eaves."""
    width, height = document.facade.width_m, document.facade.height_m
    boxes = np.array(
        [
            (e.x_m, e.y_m, e.x_m + e.width_m, e.y_m + e.height_m)
            for e in document.elements
            if e.class_ in kinds
        ]
    ).reshape(-1, 4)
    boxes = np.clip(boxes, 0.0, (width, height, width, height))
    x = np.unique(boxes[:, 0::2])
    y = np.unique(boxes[:, 1::2])
    if len(x) < 2 or len(y) < 2:
        return 0.0
    middle_x, middle_y = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    across = (boxes[:, 0, None] < middle_x) & (middle_x < boxes[:, 2, None])
    up = (boxes[:, 1, None] < middle_y) & (middle_y < boxes[:, 3, None])
    hit = up.T.astype(np.int64) @ across.astype(np.int64) > 0
    return float((hit * np.outer(np.diff(y), np.diff(x))).sum())


def _line(kind: str, floor: str, elements: list[Element], front_m2: float) -> list[str | float]:
    area = sum(e.width_m * e.height_m * area_share(e) for e in elements)
    width = float(np.mean([element.width_m for element in elements]))
    height = float(np.mean([element.height_m for element in elements]))
    ratio = area / max(front_m2, 1e-9)
    sizes = (_round(area), _round(width), _round(height), _round(ratio))
    return [kind, floor, len(elements), *sizes]


def _sizes(document: FacadeDocument) -> tuple[float, float]:
    return _round(document.facade.width_m), _round(document.facade.height_m)


def _surfaces(part: Part) -> list[tuple[str, int, float]]:
    """Name, number and area (m2) of the surfaces of each class of the building."""
    names = [part.features.semantic(row).value for row in range(len(part.features))]
    return [
        (
            name,
            names.count(name),
            float(sum(a for n, a in zip(names, part.feature_area_m2, strict=True) if n == name)),
        )
        for name in sorted(set(names))
    ]


def _round(value: float) -> float:
    return round(value, 4)
