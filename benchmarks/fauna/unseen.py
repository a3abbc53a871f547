"""Real animals with legs: the re-posed model against silhouettes that the fit did not see.

`python benchmarks fauna/unseen [--only mouse|goat] [--kept FILE] [--no-keep]` prints a table and
keeps it in `benchmarks/results/fauna-unseen.md`. Real data is read from `$VEDUTA_DATA`, else from
`../shared/data`. The worm is in `limbless.py`.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path

import cv2
import numpy as np
from kept_clips import KeptClips
from numpy.typing import NDArray
from record import Value, keep_or_print

from veduta.fauna.document.plan import load_plan
from veduta.fauna.read.drawn import drawn_figure
from veduta.fauna.read.footage import read_footage, read_masks
from veduta.fauna.read.limbed import LimbedLooks, LimbedSeen, fit_limbed
from veduta.fauna.read.overlap import overlap
from veduta.fauna.read.silhouettes import SilhouetteLooks, silhouettes_of
from veduta.fauna.read.travel import travelled
from veduta.fauna.read.windows import middles_of

Floats = NDArray[np.float64]
Masks = NDArray[np.bool_]
Row = dict[str, Value]
Filmed = tuple[Masks, NDArray[np.uint8], float | None]
DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
MOUSE_STEP, MOUSE_FRAMES = 4, 57
"""Every fourth frame of 250 a second, about two strides; every other of them is fitted."""
SIDE_PX = 168
"""Rows of the mouse's side view; under it is a view from below."""
DARK = 18
"""Grey levels: what is behind the mouse is darker."""


def main() -> None:
    """Measure all of it and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=("mouse", "goat"))
    parser.add_argument("--kept", type=Path, help="where animals that are done are kept")
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    kept = KeptClips(given.kept)
    makers: dict[str, Callable[[], Filmed]] = {"mouse": mouse_masks, "goat": goat_masks}
    rows = [
        row
        for name, make in makers.items()
        if given.only in (None, name)
        for row in kept.rows(name, partial(_measured, name, make))
    ]
    notes = [
        "Even frames are fitted. `pose unseen`: the figure in an odd frame is the mean of those"
        " before and after. All odd frames are judged; the median is the bound's.",
        "Mouse: its side view, in which the picture's border cuts its back off; what is brighter"
        " than the dark behind it, over the wheel on which it runs. Only what is in the picture"
        " is judged. Its labels are of frames that are not here.",
    ]
    keep_or_print("fauna-unseen", rows, notes, not given.no_keep)


def _measured(name: str, make: Callable[[], Filmed]) -> list[Row]:
    masks, pictures, way = make()
    even = np.arange(0, len(masks), 2)
    # The mouse's back is cut off in each frame: nothing is known above the picture.
    shown = [np.ones_like(masks[0]) if masks[row][0].any() else None for row in even]
    seen = fit_limbed(
        masks[even], even, load_plan("quadruped"), LimbedLooks(), lambda: None,
        pictures=pictures[even], shown=shown,
        ways=None if way is None else np.full(len(even), way),
    )  # fmt: skip
    scores = unseen_scores(seen, masks)
    return [{
        "what": f"{name}: silhouettes that the fit did not see, IoU of the median frame",
        "value": float(np.median(scores)), "bound": "0.85", "worst frame": float(np.min(scores)),
        "seen frames": float(np.median(seen_scores(seen, masks[even]))),
        "frames judged": len(scores),
    }]  # fmt: skip


def unseen_scores(seen: LimbedSeen, masks: Masks) -> list[float]:
    """The IoU in odd frames, the joints between those of both neighbours."""
    joints, deep = _in_picture(seen)
    between = 0.5 * (joints[:-1] + joints[1:])
    return _scores(seen, between, deep, masks[1 : 2 * len(between) : 2])


def seen_scores(seen: LimbedSeen, masks: Masks) -> list[float]:
    """The IoU in the frames that were fitted."""
    return _scores(seen, *_in_picture(seen), masks)


def _in_picture(seen: LimbedSeen) -> tuple[Floats, Floats]:
    scale = seen.fitted.px_per_length
    return seen.windows.in_picture(seen.fitted.joints(), scale), seen.fitted.deep * scale


def _scores(seen: LimbedSeen, joints: Floats, deep: Floats, masks: Masks) -> list[float]:
    shape = (int(masks.shape[1]), int(masks.shape[2]))
    return [
        overlap(drawn_figure(seen.fitted.figure, at, deep, shape), mask)
        for at, mask in zip(joints, masks, strict=True)
    ]


def goat_masks() -> Filmed:
    """(t, h, w) the goat's silhouettes, as the data set has them, its pictures, and which way it
    looks: the fit tells that.
    """
    folder = DATA / "animals" / "goat"
    footage = read_footage(folder / "images", None)
    found = silhouettes_of(read_masks(folder / "masks", footage), SilhouetteLooks(), "goat")
    return found.masks, footage.frames[found.rows], None


def mouse_masks() -> Filmed:
    """(t, h, w) the mouse from the side, over its wheel, its pictures, and which way it looks.

    That is told by the wheel under it in frames that follow each other: between those that are
    fitted it turns by more than its holes are apart.
    """
    footage = read_footage(DATA / "animals" / "mouse" / "test_vid.mp4", None)
    grey = footage.frames[:, :SIDE_PX].max(axis=3)
    still = np.median(grey[:: max(1, len(grey) // 60)], axis=0)
    above = np.arange(SIDE_PX)[:, None] < _wheel(still)[None, :] - 7.0
    spout = cv2.dilate((grey.min(axis=0) > 90).astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
    step = MOUSE_STEP // int(footage.number[1] - footage.number[0])
    count = MOUSE_FRAMES * step
    raw = np.stack([_lit(picture, above & ~spout) for picture in grey[:count]])
    every = footage.frames[:count, :SIDE_PX]
    gone = travelled(raw, middles_of(raw), every)
    return raw[::step], every[::step], float(np.sign(gone))


def _lit(picture: NDArray[np.uint8], where: Masks) -> Masks:
    """(h, w) the largest of what is brighter than the dark behind it."""
    calm = cv2.GaussianBlur(picture, (0, 0), 1.0)
    light = ((calm > DARK) & where).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(light, connectivity=8)
    if count < 2:
        return np.zeros_like(where)
    return np.asarray(labels == 1 + int(stats[1:, cv2.CC_STAT_AREA].argmax()))


def _wheel(still: Floats) -> Floats:
    """(w,) the row of the wheel's upper rim in each column: a circle through its brightest."""
    low = SIDE_PX // 2
    columns = np.arange(still.shape[1], dtype=np.float64)
    rim = low + still[low:].argmax(axis=0).astype(np.float64)
    kept = still[low:].max(axis=0) > 40.0
    for _ in range(5):
        # x^2 + y^2 = 2 a x + 2 b y + c
        matrix = np.stack([2.0 * columns, 2.0 * rim, np.ones_like(rim)], axis=1)
        a, b, c = np.linalg.lstsq(matrix[kept], (columns**2 + rim**2)[kept], rcond=None)[0]
        under = np.maximum(c + a * a + b * b - (columns - a) ** 2, 0.0)
        circle = b - np.sqrt(under)
        kept = np.abs(circle - rim) < 4.0
    return np.asarray(circle)


if __name__ == "__main__":
    main()
