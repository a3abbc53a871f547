"""Silhouettes: what differs from the background and is no shadow, cleaned and followed in time."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.read.background import Background, most_apart
from veduta.run.errors import NotFoundError

Masks = NDArray[np.bool_]


@dataclass(frozen=True)
class SilhouetteLooks:
    """What an animal's silhouette is, and what it is not."""

    noise: float = 5.0
    """So many times the noise, a pixel differs from the background."""
    least: float = 18.0
    """And by so many grey levels at least."""
    otsu_share: float = 0.6
    """And by this share of what parts both kinds of pixels best (Otsu)."""
    shadow: tuple[float, float] = (0.35, 0.95)
    """A shadow leaves this share of the background's light, and its colour as it is."""
    shadow_colour: float = 0.06
    """How far the shares of the three colours may be from each other in a shadow."""
    blur_px: float = 1.2
    """Of the frame, where shadows are told by their colour."""
    smallest: float = 2e-4
    """An animal covers this share of a frame at least."""
    second: float = 0.5
    """Another thing of this share of the largest one's area is a second animal."""
    many: float = 0.6
    """In this share of the frames, for then it is no passing thing."""
    border: float = 0.01
    """A silhouette that touches the frame's border along this share of its outline is cut."""
    spread: float = 0.35
    """A frame whose area is farther from the usual one by this share is no good frame."""
    about: int = 9
    """Of an animal with legs the usual area is that of so many frames about each one: it may turn,
    or come nearer."""
    widely: float = 2.5
    """But it is not so many times as large as in the usual frame, nor so many times smaller."""
    shown: float = 0.3
    """Where frames that the border cuts are taken, so much of the usual area is to be seen."""


@dataclass(frozen=True, eq=False)
class Silhouettes:
    """masks: (t, h, w) bool of the good frames, given by `rows` of the footage. score: (t,) 0..1.
    left_out: (row, reason) of the others. cut: (t,) where the frame's border cuts the animal;
    corners: (t, 4, 2) px of what each frame shows of a canvas, None: all of it.
    """

    masks: Masks
    rows: NDArray[np.int64]
    score: NDArray[np.float64]
    left_out: tuple[tuple[int, str], ...]
    cut: NDArray[np.bool_] | None = None
    corners: NDArray[np.float64] | None = None

    def of(self, kept: NDArray[np.int64] | slice) -> Silhouettes:
        """Some of the good frames."""
        cut = None if self.cut is None else self.cut[kept]
        corners = None if self.corners is None else self.corners[kept]
        return replace(
            self, masks=self.masks[kept], rows=self.rows[kept], score=self.score[kept], cut=cut,
            corners=corners,
        )  # fmt: skip

    def shown(self) -> list[Masks | None]:
        """Of each frame that the border cuts, (h, w) what it shows; None: the animal is whole."""
        found: list[Masks | None] = []
        for row, mask in enumerate(self.masks):
            if self.cut is None or not self.cut[row]:
                found.append(None)
            elif self.corners is None:
                found.append(np.ones_like(mask))
            else:
                inside = np.zeros(mask.shape, np.uint8)
                cv2.fillConvexPoly(inside, np.round(self.corners[row] - 0.5).astype(np.int32), 1)
                found.append(cv2.erode(inside, np.ones((5, 5), np.uint8)) > 0)
        return found


def differing(frames: NDArray[np.uint8], background: Background, looks: SilhouetteLooks) -> Masks:
    """(t, h, w) where each frame differs from the background and is no shadow on it."""
    found = np.empty(frames.shape[:3], dtype=np.bool_)
    light = np.maximum(background.pixels.astype(np.float32), 1.0)
    for row, frame in enumerate(frames):
        apart = most_apart(frame, background.pixels)
        parted, _ = cv2.threshold(apart, 0, 255, cv2.THRESH_BINARY | cv2.THRESH_OTSU)
        level = max(looks.noise * background.noise, looks.least, looks.otsu_share * float(parted))
        differs = apart > level
        # One pixel's noise would be a colour of its own.
        calm = np.asarray(cv2.GaussianBlur(frame, (0, 0), looks.blur_px))
        there = light[differs]
        share = calm[differs].astype(np.float32) / there
        low = np.minimum(np.minimum(share[:, 0], share[:, 1]), share[:, 2])
        high = np.maximum(np.maximum(share[:, 0], share[:, 1]), share[:, 2])
        grey = (high - low) < looks.shadow_colour + background.noise / there.mean(axis=1)
        shadow = grey & (low > looks.shadow[0]) & (high < looks.shadow[1])
        differs[differs] = ~shadow
        found[row] = differs
    return found


def silhouettes_of(
    raw: Masks, looks: SilhouetteLooks, what: str, corners: NDArray[np.float64] | None = None, *,
    with_cut: bool = False,
) -> Silhouettes:  # fmt: skip
    """The animal's own silhouette in each frame; NotFoundError where there is no such thing.

    raw: (t, h, w), everything that differs, or masks that somebody made. corners: (t, 4, 2) px of
    what each frame shows of a canvas; None: all of it. with_cut: frames in which the border cuts it
    are good ones, too, and so are those of an animal that comes nearer or turns.
    """
    area_px = raw.shape[1] * raw.shape[2]
    masks = np.zeros_like(raw)
    areas, seconds = np.zeros(len(raw)), np.zeros(len(raw))
    cut = np.zeros(len(raw), dtype=np.bool_)
    before: Masks | None = None
    for row, mask in enumerate(raw):
        clean, second = _animal(mask, before)
        masks[row], areas[row] = clean, float(clean.sum())
        seconds[row] = second / max(areas[row], 1.0)
        cut[row] = _touches_border(clean, looks.border, None if corners is None else corners[row])
        before = clean if areas[row] > looks.smallest * area_px else before
    seen = areas > looks.smallest * area_px
    _require_one_animal(seen, seconds, cut, looks, what)
    usual = float(np.median(areas[seen & ~cut]))
    spread = np.abs(areas - usual) / usual
    taken = np.zeros_like(seen)
    if with_cut:
        about = _about(areas, seen & ~cut, looks.about)
        widely = (areas < looks.widely * usual) & (areas > usual / looks.widely)
        spread = np.where(widely, np.abs(areas - about) / about, spread)
        taken = seen & cut & (areas > looks.shown * about) & (areas < (1.0 + looks.spread) * about)
    reasons = {
        "nothing differs from the background there": ~seen,
        "the frame's border cuts the animal": seen & cut & ~taken,
        "its silhouette is not as large as in the others": seen & ~cut & (spread > looks.spread),
    }
    left_out = [
        (int(row), reason) for reason, rows in reasons.items() for row in np.flatnonzero(rows)
    ]
    good = taken | (seen & ~cut & (spread <= looks.spread))
    score = np.clip(1.0 - spread, 0.0, 1.0) * np.clip(1.0 - seconds, 0.0, 1.0)
    own = None if corners is None else corners[good]
    rows = np.flatnonzero(good)
    return Silhouettes(masks[good], rows, score[good], tuple(sorted(left_out)), cut[good], own)


def _about(areas: NDArray[np.float64], good: NDArray[np.bool_], frames: int) -> NDArray[np.float64]:
    """(t,) the median area of the good frames that are nearest to each one."""
    rows = np.flatnonzero(good)
    away = np.abs(np.arange(len(areas))[:, None] - rows)
    # Of two that are as far the earlier one, on all processors.
    near = np.argsort(away, axis=1, kind="stable")[:, :frames]
    return np.asarray(np.median(areas[rows][near], axis=1))


def frame_scores(silhouettes: Silhouettes, number: NDArray[np.int64]) -> list[tuple[int, float]]:
    """Of each good frame its number in the record and how sure its silhouette is.

    number: (t,) of all frames.
    """
    return [
        (int(frame), round(float(score), 4))
        for frame, score in zip(number[silhouettes.rows], silhouettes.score, strict=True)
    ]


def _require_one_animal(
    seen: Masks, seconds: NDArray[np.float64], cut: Masks, looks: SilhouetteLooks, what: str
) -> None:
    if seen.sum() < 2:
        raise NotFoundError(
            "an animal",
            f"nothing in {what} differs from its background in more than {int(seen.sum())} frames",
            "Give a background image (--background) or masks (--masks), or other footage.",
        )
    double = float((seconds[seen] > looks.second).mean())
    if double > looks.many:
        raise NotFoundError(
            "one animal",
            f"two things of nearly the same size differ from the background in {double:.0%} of"
            " the frames",
            "Give masks of one of them (--masks), or cut the footage to it.",
        )
    if not (seen & ~cut).any():
        raise NotFoundError(
            "the whole animal",
            f"the border of the frame cuts it in all {int(seen.sum())} frames that show it",
            "Give footage in which it is seen whole.",
        )


def _animal(mask: Masks, before: Masks | None) -> tuple[Masks, float]:
    """The thing that is the animal, without gaps, and the area of the next largest.

    It is the one that overlaps most with what it was before; at the beginning the largest one.
    """
    closed = cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    shape = cv2.morphologyEx(closed, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(shape, connectivity=8)
    if count < 2:
        return np.zeros_like(mask), 0.0
    areas = stats[1:, cv2.CC_STAT_AREA].astype(np.float64)
    worth = areas.copy()
    if before is not None:
        reach = cv2.dilate(before.astype(np.uint8), np.ones((9, 9), np.uint8)) > 0
        inside = np.bincount(labels[reach], minlength=count)[1:]
        worth = areas * (0.1 + inside / np.maximum(areas, 1.0))
    chosen = int(worth.argmax())
    rest = np.delete(areas, chosen)
    outline, _ = cv2.findContours(
        (labels == chosen + 1).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
    )
    filled = np.zeros_like(shape)
    cv2.drawContours(filled, outline, -1, 1, cv2.FILLED)
    return filled.astype(np.bool_), float(rest.max()) if len(rest) else 0.0


def _touches_border(mask: Masks, share: float, corners: NDArray[np.float64] | None = None) -> bool:
    outline = np.sqrt(float(mask.sum())) * 4.0
    if corners is None:
        edges = (mask[0], mask[-1], mask[:, 0], mask[:, -1])
        return bool(sum(int(edge.sum()) for edge in edges) > share * outline)
    rim = np.zeros(mask.shape, np.uint8)
    # Two pixels wide: what is cut by a turned border ends within its pixels, not on them.
    cv2.polylines(rim, [np.round(corners - 0.5).astype(np.int32)], True, 1, 2)
    return bool(0.5 * float((mask & (rim > 0)).sum()) > share * outline)
