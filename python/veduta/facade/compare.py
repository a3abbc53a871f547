"""A facade document beside the truth: for photos whose facade is known exactly.

Everything is compared where the photo can decide it. Windows are what is visible of them: the
part behind a balcony's railing belongs to the balcony, on both sides of the comparison.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from veduta.facade.document import Element, FacadeClass, FacadeDocument
from veduta.facade.outputs import rasterise
from veduta.geometry import homography
from veduta.place.semantics import LABELS
from veduta.synthetic.truth import FacadeTruth, TrueElement

# left, top, right, bottom in rectified pixels, or left, bottom, right, top in facade metres
Box = NDArray[np.float64]
MIN_IOU = 0.5
_UNSEEN = 255


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Windows(_Record):
    """Windows matched one to one at an intersection over union of at least `MIN_IOU`."""

    true: int
    found: int
    matched: int
    elsewhere: int = Field(description="found with the middle off the house; they count as wrong")
    cut_off: int = Field(description="outside the rectified image, so that nothing could find them")
    missed: tuple[str, ...] = Field(description="where the true windows are that were not found")

    @property
    def precision(self) -> float:
        """The share of found windows that are right."""
        return self.matched / self.found if self.found else 0.0

    @property
    def recall(self) -> float:
        """The share of true windows that were found."""
        return self.matched / self.true if self.true else 1.0


class Pair(_Record):
    """A number of the document beside the true one."""

    found: float
    true: float


class Comparison(_Record):
    """The document's numbers beside the true ones."""

    windows: Windows
    storeys: Pair
    columns: Pair
    width_m: Pair
    height_m: Pair
    corners_off_m: tuple[float, ...] = Field(
        description="distance of each corner of the matched windows, each in its own facade frame"
    )
    accuracy: float = Field(
        description="share of the compared pixels with the right class; a chimney is roof"
    )
    compared: float = Field(
        description="share of the photo's pixels with house or sky that the document covers"
    )
    class_recall: dict[FacadeClass, float]

    @property
    def window_count(self) -> Pair:
        """How many windows there are."""
        return Pair(found=self.windows.found, true=self.windows.true)

    def off_m(self, quantile: float) -> float:
        """How far window corners are off (m) at a quantile, NaN where no window matches."""
        return float(np.quantile(self.corners_off_m, quantile)) if self.corners_off_m else np.nan


def compare(document: FacadeDocument, truth: FacadeTruth) -> Comparison:
    """Set a document beside the truth about its photo."""
    found = [(e, _visible_px(e, document)) for e in document.elements if e.class_ == "window"]
    windows = [(e, _rectified_box(e, document)) for e in truth.elements if e.label == "window"]
    true = [(e, box) for e, box in windows if _in_picture(box, document)]
    pairs = match([box for _, box in found], [box for _, box in true])
    matched = {j for _, j in pairs}
    off = [_off_m(found[i][0], found[i][1], true[j][0], document) for i, j in pairs]
    accuracy, compared, recall = _pixels(document, truth)
    return Comparison(
        windows=Windows(
            true=len(true),
            found=len(found),
            matched=len(pairs),
            elsewhere=sum(not _on_house(box, document, truth) for _, box in found),
            cut_off=len(windows) - len(true),
            missed=tuple(_name(e) for j, (e, _) in enumerate(true) if j not in matched),
        ),
        storeys=Pair(found=document.storeys, true=truth.storeys),
        columns=Pair(found=_columns(document), true=truth.columns),
        width_m=Pair(found=document.facade.width_m, true=truth.width_m),
        height_m=Pair(found=document.facade.height_m, true=truth.height_m),
        corners_off_m=tuple(value for window in off for value in window),
        accuracy=accuracy,
        compared=compared,
        class_recall=recall,
    )


def match(found: list[Box], true: list[Box]) -> list[tuple[int, int]]:
    """Pairs (found, true), each used once, the best overlap first."""
    scores = [(iou(a, b), i, j) for i, a in enumerate(found) for j, b in enumerate(true)]
    pairs: list[tuple[int, int]] = []
    used: tuple[set[int], set[int]] = (set(), set())
    for score, i, j in sorted(scores, key=lambda s: (-s[0], s[1], s[2])):
        if score >= MIN_IOU and i not in used[0] and j not in used[1]:
            pairs.append((i, j))
            used[0].add(i)
            used[1].add(j)
    return pairs


def iou(a: Box, b: Box) -> float:
    """Intersection over union of two boxes."""
    overlap = np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2])
    shared = float(np.prod(np.clip(overlap, 0.0, None)))
    whole = float(np.prod(a[2:] - a[:2]) + np.prod(b[2:] - b[:2])) - shared
    return shared / whole if whole > 0 else 0.0


def _visible_px(window: Element, document: FacadeDocument) -> Box:
    """What is left of a window when the balconies that are painted over it are taken off."""
    left, top = window.x_px, window.y_px
    right, bottom = left + window.width_px, top + window.height_px
    for balcony in document.elements:
        if balcony.class_ != "balcony":
            continue
        spans = min(right, balcony.x_px + balcony.width_px) - max(left, balcony.x_px)
        reaches = balcony.y_px + balcony.height_px >= bottom - 0.15 * window.height_px
        if spans > 0.8 * window.width_px and top < balcony.y_px < bottom and reaches:
            bottom = balcony.y_px
    return np.array([left, top, right, bottom])


def _rectified_box(element: TrueElement, document: FacadeDocument) -> Box:
    rectified_from_source = np.array(document.rectification.rectified_from_source)
    corners = homography.apply(rectified_from_source, element.quad_px)
    return np.concatenate([corners.min(axis=0), corners.max(axis=0)])


def _in_picture(box: Box, document: FacadeDocument) -> bool:
    """Whether at least half of a box is inside the rectified image."""
    size = np.array([document.rectification.width_px, document.rectification.height_px])
    inside = np.clip(np.minimum(box[2:], size) - np.maximum(box[:2], 0.0), 0.0, None)
    return bool(np.prod(inside) >= 0.5 * np.prod(box[2:] - box[:2]))


def _off_m(found: Element, box: Box, true: TrueElement, document: FacadeDocument) -> list[float]:
    """Distances of the four corners (m)."""
    hidden_m = (found.y_px + found.height_px - box[3]) * document.scale.metres_per_px
    low, high = found.y_m + hidden_m, found.y_m + found.height_m
    seen = true.visible
    dx = (found.x_m - seen.x_m, found.x_m + found.width_m - seen.right_m)
    dy = (low - seen.y_m, high - seen.top_m)
    return [float(np.hypot(x, y)) for x in dx for y in dy]


def _on_house(box: Box, document: FacadeDocument, truth: FacadeTruth) -> bool:
    """Whether the middle of a found box lies on what the photo shows of the true house."""
    middle = np.array([[(box[0] + box[2]) / 2, (box[1] + box[3]) / 2]])
    back = homography.inverse(np.array(document.rectification.rectified_from_source))
    x, y = np.floor(homography.apply(back, middle)[0]).astype(int)
    height, width = truth.labels.shape
    inside = 0 <= x < width and 0 <= y < height
    return inside and LABELS[truth.labels[y, x]] not in ("other", "sky")


def _columns(document: FacadeDocument) -> int:
    return len({e.column for e in document.elements if e.class_ == "window"} - {None})


def _name(element: TrueElement) -> str:
    floor = "roof" if element.floor is None else f"floor {element.floor}"
    return floor if element.column is None else f"{floor} column {element.column}"


def _pixels(
    document: FacadeDocument, truth: FacadeTruth
) -> tuple[float, float, dict[FacadeClass, float]]:
    """Accuracy, the share of the photo's decided pixels that were compared, recall by class."""
    found = labels_in_photo(document, truth.labels.shape)
    to_truth = [LABELS.index(_merged(name)) for name in document.classes]
    table = np.full(256, _UNSEEN, np.uint8)
    table[: len(to_truth)] = to_truth
    merged = np.array([LABELS.index(_merged(name)) for name in LABELS], np.uint8)[truth.labels]
    decided = merged != LABELS.index("other")
    compared = decided & (found != _UNSEEN)
    right = compared & (table[found] == merged)
    recall = {}
    for name in dict.fromkeys(_merged(label) for label in LABELS if label != "other"):
        of_class = compared & (merged == LABELS.index(name))
        if of_class.any():
            recall[name] = float(right[of_class].mean())
    total = max(1, int(compared.sum()))
    share = float(compared.sum() / max(1, int(decided.sum())))
    return float(right.sum() / total), share, recall


def _merged(name: FacadeClass) -> FacadeClass:
    return "roof" if name == "chimney" else name


def labels_in_photo(document: FacadeDocument, shape: tuple[int, ...]) -> NDArray[np.uint8]:
    """The document's labels (h, w) seen through the photo; 255 where the photo was cut off."""
    rectified_from_source = np.array(document.rectification.rectified_from_source)
    centre = homography.translation(0.5, 0.5)
    pixels = homography.translation(-0.5, -0.5) @ rectified_from_source @ centre
    labels = cv2.warpPerspective(
        rasterise(document),
        pixels,
        (shape[1], shape[0]),
        flags=cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=(_UNSEEN,),
    )
    return np.asarray(labels, np.uint8)
