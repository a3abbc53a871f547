"""Single windows, balconies, doors and shops from what the network says of middles and borders."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes.element import SeenElement
from veduta.facade.eyes.look import BOX_STEP_PX, Seen
from veduta.facade.eyes.shops import ShopParameters, between_shops, shop_fronts

Boxes = NDArray[np.float64]
_SHOPS = ShopParameters()

_MIDDLE_PX = 2.5
"""Where in a cell of the grid its distances to the borders are taken from (`training/facade`)."""


@dataclass(frozen=True)
class ElementParameters:
    """When a middle is one, and which of two elements stays.

    `least_*`: how sure a middle of that kind must be; on pictures that the network was trained on
    the F1 hardly changes from 0.3 to 0.5. `same`: the overlap (intersection over union) from which
    two elements of a kind are one; `inside`: the share of the smaller one's area. `other`: the
    overlap from which two of different kinds are one, but for balconies, which hang before windows.
    """

    least_window: float = 0.35
    least_balcony: float = 0.4
    least_door: float = 0.45
    least_shop: float = 0.4
    same: float = 0.35
    inside: float = 0.7
    other: float = 0.5


def seen_elements(seen: Seen, parameters: ElementParameters | None = None) -> list[SeenElement]:
    """All elements of a picture, the surest first."""
    p = parameters or ElementParameters()
    least = {"window": p.least_window, "balcony": p.least_balcony}
    least |= {"door": p.least_door, "shop": p.least_shop}
    found: list[SeenElement] = []
    for index, kind in enumerate(seen.kinds):
        boxes, scores = _peaks(seen, index, least[kind])
        kept = _apart(boxes, scores, p.same, p.inside)
        found += [_element(kind, boxes[i], scores[i]) for i in kept]
    found = _whole_shops(found, seen)
    return _one_kind_each(sorted(found, key=lambda e: -e.score), p.other)


def _element(kind: str, box: Boxes, score: float) -> SeenElement:
    x0, y0, x1, y1 = (float(v) for v in box)
    return SeenElement(kind, x0, y0, x1, y1, float(score))


def _whole_shops(elements: list[SeenElement], seen: Seen) -> list[SeenElement]:
    """Shop fronts in the place of the single shops that they hold.

    Sets differ in what one shop is, a pane or the whole ground floor; a front in one piece is one,
    but where its single shops are parted by what is none.
    """
    fronts: list[SeenElement] = []
    gone: set[int] = set()
    for box, chance in shop_fronts(seen, _SHOPS):
        front = _element("shop", box, min(1.0, chance))
        held = [i for i, e in enumerate(elements) if e.kind == "shop" and _has_middle_in(e, front)]
        own = np.array([[e.x0, e.y0, e.x1, e.y1] for e in (elements[i] for i in held)])
        if len(held) < 2 or between_shops(seen, own) > _SHOPS.parted:
            fronts.append(front)
            gone.update(held)
    return [e for i, e in enumerate(elements) if i not in gone] + fronts


def _has_middle_in(e: SeenElement, front: SeenElement) -> bool:
    x, y = 0.5 * (e.x0 + e.x1), 0.5 * (e.y0 + e.y1)
    return front.x0 <= x <= front.x1 and front.y0 <= y <= front.y1


def _peaks(seen: Seen, index: int, least: float) -> tuple[Boxes, NDArray[np.float64]]:
    """Boxes (n, 4) and scores (n,) at the local maxima of a kind's centres."""
    heat = seen.centres[index]
    highest = cv2.dilate(heat, np.ones((3, 3), np.uint8))
    rows, columns = np.nonzero((heat >= highest) & (heat > least))
    left, top, right, bottom = seen.borders[:, rows, columns].astype(np.float64)
    x, y = columns * BOX_STEP_PX + _MIDDLE_PX, rows * BOX_STEP_PX + _MIDDLE_PX
    boxes = np.stack([x - left, y - top, x + right, y + bottom], axis=1)
    boxes /= (seen.across, seen.down, seen.across, seen.down)
    size = (seen.width_px, seen.height_px, seen.width_px, seen.height_px)
    return np.clip(boxes, 0, size), heat[rows, columns].astype(np.float64)


def _apart(boxes: Boxes, scores: NDArray[np.float64], same: float, inside: float) -> list[int]:
    """Which boxes stay, the surest first: none that a surer one covers."""
    kept: list[int] = []
    for i in np.argsort(-scores, kind="stable").tolist():
        shared, areas = _shared(boxes[i], boxes[kept])
        own = _area(boxes[i])
        union = np.maximum(own + areas - shared, 1e-9)
        least = np.maximum(np.minimum(own, areas), 1e-9)
        if not ((shared / union > same) | (shared / least > inside)).any():
            kept.append(i)
    return kept


def _area(box: Boxes) -> float:
    return float((box[2] - box[0]) * (box[3] - box[1]))


def _shared(box: Boxes, others: Boxes) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Area shared with each of the others (n, 4), and their own areas (n,)."""
    low = np.maximum(box[:2], others[:, :2])
    high = np.minimum(box[2:], others[:, 2:])
    return np.clip(high - low, 0, None).prod(-1), (others[:, 2:] - others[:, :2]).prod(-1)


def _one_kind_each(elements: list[SeenElement], other: float) -> list[SeenElement]:
    """Where a window, a door and a shop are the same thing, the surest of them."""
    kept: list[SeenElement] = []
    for element in elements:
        rivals = [k for k in kept if "balcony" not in (k.kind, element.kind)]
        box = np.array([element.x0, element.y0, element.x1, element.y1])
        others = np.array([[k.x0, k.y0, k.x1, k.y1] for k in rivals]).reshape(-1, 4)
        shared, areas = _shared(box, others)
        if not (shared > other * np.maximum(_area(box) + areas - shared, 1e-9)).any():
            kept.append(element)
    return kept
