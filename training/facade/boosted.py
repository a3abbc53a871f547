"""Train the generic detector of `veduta.facade.elements`: modillions, consoles, doors.

    python training/facade/boosted.py DATA OUT.json [--fronts 5] [--stumps 80]

Modillions and consoles are those of rendered fronts of styles (seeds from 0; the benchmark has
those from 100 on). Doors are those of CMP's pictures b0001 to b0240 (CC BY-SA), the fold that the
eyes are trained on. Negatives are windows by chance, then those that a first detector takes for
elements. Boosting is AdaBoost over stumps, each a difference of two rectangles by chance.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benchmarks" / name) for name in ("facade", "measuring")]

from element_fronts import STYLES, element_front  # noqa: E402
from facade_measures import Matches, match, overlaps  # noqa: E402
from facade_truth import cmp_picture_labels, components  # noqa: E402

from veduta.facade.document import CLASSES  # noqa: E402
from veduta.facade.elements.boosted import SIZES, Boosted, found_by, stump_values  # noqa: E402

Float = NDArray[np.float64]
Pixels = NDArray[np.uint8]
Boxes = NDArray[np.float64]
WINDOWS = {"modillion": (12, 12, 0.35), "console": (10, 18, 0.25), "door": (14, 22, 0.15)}
"""Width, height (px) and margin of the windows of a kind."""
FEATURES, BINS, FIRST = 600, 16, 16
EACH, JITTER, SEED = 3, 0.05, 5
NEGATIVES, HARD = 160, 80
KEPT = 0.98
"""Share of the positives that the first stumps and the whole keep hope for."""
DOOR_PICTURES = range(1, 241, 8)


@dataclass(frozen=True)
class Example:
    """A picture and its elements."""

    pixels: Pixels
    boxes: Boxes


def main() -> None:
    """Train each kind, and write all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--fronts", type=int, default=5, help="of each style")
    parser.add_argument("--styles", nargs="+", default=list(STYLES))
    parser.add_argument("--stumps", type=int, default=80)
    call = parser.parse_args()
    fronts = [element_front(style, seed) for style in call.styles for seed in range(call.fronts)]
    told = {}
    for kind in WINDOWS:
        if kind == "door":
            examples = _doors(call.data)
        else:
            examples = [Example(front.pixels, front.boxes[kind]) for front in fronts]
        trained = train(kind, examples, call.stumps)
        told[kind] = {
            key: value.tolist() if isinstance(value, np.ndarray) else value
            for key, value in vars(trained).items()
        }
    call.out.write_text(json.dumps(told) + "\n", encoding="utf-8")


def _doors(data: Path) -> list[Example]:
    found = []
    for number in DOOR_PICTURES:
        path = data / f"facades/cmp/cmp_b{number:04d}.png"
        boxes = components(cmp_picture_labels(path), CLASSES.index("door"), 200)
        if len(boxes):
            pixels = cv2.imread(str(path.with_suffix(".jpg")))[..., ::-1]
            found.append(Example(np.ascontiguousarray(pixels), boxes))
    return found


def train(kind: str, examples: Sequence[Example], stumps: int) -> Boosted:
    """A detector of the elements of a kind."""
    rng = np.random.default_rng(SEED)
    width, height, margin = WINDOWS[kind]
    empty = Boosted(
        width, height, margin, _rectangles(width, height, rng), np.zeros(0), np.zeros(0), 0, 0, 0
    )
    good = np.concatenate([_patches(empty, one, _jittered(one.boxes, rng)) for one in examples])
    bad = np.concatenate([_patches(empty, one, _elsewhere(kind, one, rng)) for one in examples])
    own = _boosted(empty, good, bad, stumps // 2)
    print(kind, len(good), len(bad), flush=True)
    for _ in range(2):
        hard = [_patches(empty, one, _mistaken(kind, own, one)) for one in examples]
        bad = np.concatenate([bad, *hard])
        print(kind, len(good), len(bad), flush=True)
        own = _boosted(empty, good, bad, stumps)
    return replace(own, least=_best_level(kind, own, examples))


def _best_level(kind: str, own: Boosted, examples: Sequence[Example]) -> float:
    """The sum from which on the detector does best on the pictures that it was trained on (F1)."""
    every = [found_by(own, one.pixels, replace(SIZES[kind], row=0)) for one in examples]
    scored = []
    for level in np.linspace(
        own.least, max([own.least + 1.0, *(s.max(initial=0.0) for _, s in every)]), 40
    ):
        total = Matches(0, 0, 0)
        for (boxes, scores), one in zip(every, examples, strict=True):
            total += match(boxes[scores > level], one.boxes)
        scored.append((total.f1, float(level)))
    return max(scored)[1]


def _rectangles(width: int, height: int, rng: np.random.Generator) -> NDArray[np.int64]:
    x = np.sort(rng.integers(0, width + 1, (4 * FEATURES, 2, 2)), axis=2)
    y = np.sort(rng.integers(0, height + 1, (4 * FEATURES, 2, 2)), axis=2)
    found = np.stack([x[..., 0], y[..., 0], x[..., 1], y[..., 1]], axis=2)
    sound = ((x[..., 1] > x[..., 0]) & (y[..., 1] > y[..., 0])).all(axis=1)
    return found[sound][:FEATURES].astype(np.int64)


def _jittered(boxes: Boxes, rng: np.random.Generator) -> Boxes:
    size = np.tile(boxes[:, 2:] - boxes[:, :2], 2)
    return np.concatenate(
        [boxes + rng.normal(0.0, JITTER, boxes.shape) * size for _ in range(EACH)]
    )


def _elsewhere(kind: str, one: Example, rng: np.random.Generator) -> Boxes:
    """Boxes by chance that are no elements."""
    rows, columns = one.pixels.shape[:2]
    longer, sizes = max(rows, columns), SIZES[kind]
    width, height, _ = WINDOWS[kind]
    high = longer * np.exp(rng.uniform(np.log(sizes.low), np.log(sizes.high), NEGATIVES))
    wide = high * width / height
    x, y = (
        rng.uniform(0, 1, NEGATIVES) * (columns - wide),
        rng.uniform(0, 1, NEGATIVES) * (rows - high),
    )
    boxes = np.column_stack([x, y, x + wide, y + high])
    return boxes[_is_wrong(boxes, one)]


def _mistaken(kind: str, own: Boosted, one: Example) -> Boxes:
    """What a detector takes for elements, and is none."""
    boxes, _ = found_by(own, one.pixels, replace(SIZES[kind], row=0, alike=9.0))
    return boxes[_is_wrong(boxes, one)][:HARD]


def _is_wrong(boxes: Boxes, one: Example) -> NDArray[np.bool_]:
    if not len(one.boxes):
        return np.ones(len(boxes), np.bool_)
    return np.asarray(overlaps(boxes, one.boxes).max(axis=1, initial=0.0) < 0.3, np.bool_)


def _patches(own: Boosted, one: Example, boxes: Boxes) -> Pixels:
    """(n, height, width) windows around boxes."""
    grey = cv2.cvtColor(one.pixels, cv2.COLOR_RGB2GRAY)
    found = np.zeros((len(boxes), own.height, own.width), np.uint8)
    for place, (left, top, right, bottom) in enumerate(boxes.tolist()):
        wide, high = own.margin * (right - left), own.margin * (bottom - top)
        across = (right - left + 2 * wide) / own.width
        down = (bottom - top + 2 * high) / own.height
        # As the detector sees it: the whole picture at the scale of the element, then the window.
        scale = 1.0 / max(across, down, 1e-3)
        reach = slice(max(0, int(top - 2 * high) - 2), int(bottom + 2 * high) + 3)
        span = slice(max(0, int(left - 2 * wide) - 2), int(right + 2 * wide) + 3)
        part = grey[reach, span]
        if min(part.shape) < 2:
            continue
        way = cv2.INTER_AREA if scale < 1.0 else cv2.INTER_LINEAR
        small = cv2.resize(part, None, fx=scale, fy=scale, interpolation=way)
        x = 0.5 * (left + right) - span.start
        y = 0.5 * (top + bottom) - reach.start
        middle = (x * small.shape[1] / part.shape[1], y * small.shape[0] / part.shape[0])
        found[place] = cv2.getRectSubPix(
            small, (own.width, own.height), (middle[0] - 0.5, middle[1] - 0.5)
        )
    return found


def _boosted(empty: Boosted, good: Pixels, bad: Pixels, stumps: int) -> Boosted:
    """AdaBoost, with stumps at quantiles of the features."""
    values = stump_values(empty, np.concatenate([good, bad]))
    sign = np.concatenate([np.ones(len(good)), -np.ones(len(bad))])
    cuts = np.quantile(values, np.linspace(0.02, 0.98, BINS), axis=0)
    bins = (values[None] > cuts[:, None]).sum(axis=0).astype(np.int64)  # (n, k): 0 to BINS
    flat = bins + (BINS + 1) * np.arange(bins.shape[1])
    mass = np.where(sign > 0, 0.5 / len(good), 0.5 / len(bad))
    chosen, thresholds, weights = [], [], []
    for _ in range(stumps):
        told = np.repeat(sign * mass, bins.shape[1])
        sums = np.bincount(flat.ravel(), told, (BINS + 1) * bins.shape[1]).reshape(-1, BINS + 1)
        below = sums.cumsum(axis=1)[:, :-1]  # of the bins up to each cut
        edge = (
            sums.sum(axis=1)[:, None] - 2.0 * below
        )  # right less wrong, where above is an element
        feature, cut = np.unravel_index(int(np.abs(edge).argmax()), edge.shape)
        gain = float(np.clip(edge[feature, cut], -0.999, 0.999))
        weight = 0.5 * np.log((1.0 + gain) / (1.0 - gain))
        said = np.where(values[:, feature] > cuts[cut, feature], 1.0, -1.0)
        mass = mass * np.exp(-weight * sign * said)
        mass /= mass.sum()
        chosen.append(int(feature))
        thresholds.append(float(cuts[cut, feature]))
        weights.append(float(weight))
    said = np.where(values[:, chosen] > np.array(thresholds), 1.0, -1.0) * np.array(weights)
    early, late = said[:, :FIRST].sum(axis=1), said.sum(axis=1)
    is_good = sign > 0
    return replace(
        empty,
        rectangles=empty.rectangles[chosen],
        thresholds=np.array(thresholds),
        weights=np.array(weights),
        first=FIRST,
        hope=float(np.quantile(early[is_good], 1.0 - KEPT)),
        least=_balanced(late[is_good], late[~is_good]),
    )


def _balanced(good: Float, bad: Float) -> float:
    """The level at which as many positives are lost as negatives are taken, and zero at least."""
    levels = np.quantile(good, np.linspace(0.0, 0.5, 101))
    lost = np.linspace(0.0, 0.5, 101)
    taken = (bad[:, None] > levels).mean(axis=0)
    return max(0.0, float(levels[int(np.abs(lost - taken).argmin())]))


if __name__ == "__main__":
    main()
