"""Dimension lines: a number along a thin line with marks at its ends (`3450`, `3.45`, `11'4"`).

The line runs in the direction of the text, above, below or through it. Its ends are ticks, arrows,
dots or lines that cross it: places where ink stands on both sides of it. Other lines may cross in
between, and chains of dimensions share their ends, so that several pairs of ends are offered, the
nearest first, and the vote over the sheet decides.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.scale.evidence import Hypothesis, Voter, side_hypothesis
from veduta.plan.scale.quantities import Quantity, read_quantities

_REACH = 2.2  # heights of the text within which its line runs
_INK = 0.4
_GAP_PX = 3  # a thin line may be broken by so much and go on
_MARKS = (0.3, 0.15)  # heights of the text by which end marks stand out of their line: by the
# first they are told from specks, by the second from other lines that run close beside them
_END_TRUSTS = (1.0, 0.6, 0.5, 0.2, 0.1)  # the nearest crossing is the end, else the next ...
_UNDER = (0.45, 0.9, 2.6)  # a height under a width: beside it in widths, below it in heights
_WIDE = 1.5  # groups of marks that are so many times as wide as most are two, as of a thin wall
_LEAST = 1.1  # a dimension line is longer than its number, in widths of the text


@dataclass(frozen=True)
class _Strip:
    """The surroundings of a text, turned so that it runs to the right.

    `ink` (rows, columns) bool; the text is at `left`..`right`, `top`..`bottom`; `height` is its
    height in pixels.
    """

    ink: NDArray[np.bool_]
    left: int
    right: int
    top: int
    bottom: int
    height: float


def line_voters(texts: list[Text], ink: NDArray[np.float32], blur_px: float) -> list[Voter]:
    """Evidence from texts that are lengths and have a dimension line; `ink` is (h, w), 0 to 1."""
    voters = []
    read = {
        id(text): [one for one in read_quantities(text.text) if one.kind == "length"]
        for text in texts
    }
    said = [text for text in texts if read[id(text)]]
    for text in said:
        lengths = read[id(text)]
        if any(is_height_under(text, other) for other in said):
            continue
        readings = [
            reading
            for pixels, trust in dimension_spans(text, ink)
            for reading in _readings(lengths, pixels, trust, blur_px)
        ]
        if readings:
            x, y = np.mean(text.box_px, axis=0)
            place = f"line at ({x:.0f}, {y:.0f})"
            voters.append(Voter("line", text.text, place, tuple(readings), mass=text.score))
    return voters


def is_height_under(text: Text, other: Text) -> bool:
    """Whether a number stands right under another one, beyond the line between them.

    So the height of a window or a door stands under its width, and is no length of that line.
    """
    box, above = (np.asarray(one.box_px, np.float64) for one in (text, other))
    along, down = box[1] - box[0], box[3] - box[0]
    width, height = float(np.hypot(*along)), float(np.hypot(*down))
    own = above[1] - above[0]
    if text is other or min(width, height) < 4.0:
        return False
    along, down = along / width, down / height
    if float(own @ along) < 0.95 * float(np.hypot(*own)):
        return False
    away = box.mean(axis=0) - above.mean(axis=0)
    beside, under = abs(float(away @ along)), float(away @ down)
    return beside <= _UNDER[0] * width and _UNDER[1] * height <= under <= _UNDER[2] * height


def dimension_spans(text: Text, ink: NDArray[np.float32]) -> list[tuple[float, float]]:
    """Pixels that the line of a text may be long, each with a trust; none without a line."""
    strip = _strip(text, ink)
    if strip is None:
        return []
    spans: dict[float, float] = {}
    for (row, start, end), high in itertools.product(_lines(strip), _MARKS):
        marks = _marks(strip, row, (start, end), high)
        middle = (strip.left + strip.right) / 2.0
        before = [mark for mark in marks[::-1] if mark < middle][: len(_END_TRUSTS)]
        after = [mark for mark in marks if mark > middle][: len(_END_TRUSTS)]
        for (one, first), (two, second) in itertools.product(enumerate(before), enumerate(after)):
            length = round(second - first, 1)
            trust = _END_TRUSTS[one] * _END_TRUSTS[two]
            if length >= _LEAST * (strip.right - strip.left):
                spans[length] = max(trust, spans.get(length, 0.0))
    return sorted(spans.items(), key=lambda item: -item[1])[:24]


def _readings(
    lengths: list[Quantity], pixels: float, trust: float, blur_px: float
) -> list[Hypothesis]:
    return [
        side_hypothesis(one.values[0], pixels, one.step, blur_px, trust * one.trust)
        for one in lengths
    ]


def _strip(text: Text, ink: NDArray[np.float32]) -> _Strip | None:
    box = np.asarray(text.box_px, dtype=np.float64)
    along, down = box[1] - box[0], box[3] - box[0]
    width, height = float(np.linalg.norm(along)), float(np.linalg.norm(down))
    if width < 4 or height < 4:
        return None
    # Of a short number the box is no more exact than its pixels: plans are written along axes.
    angle = np.arctan2(along[1], along[0])
    quarter = np.round(angle / (np.pi / 2)) * np.pi / 2
    angle = quarter if abs(angle - quarter) < np.radians(4.0) else angle
    unit = np.array([np.cos(angle), np.sin(angle)])
    normal = np.array([-unit[1], unit[0]])
    half = int(np.hypot(*ink.shape))
    reach = int(_REACH * height)
    rows, columns = int(height) + 2 * reach, 2 * half
    centre = box.mean(axis=0)
    origin = centre - half * unit - rows / 2.0 * normal
    matrix = np.column_stack([unit, normal, origin])  # page from strip
    turned = cv2.warpAffine(
        ink, matrix, (columns, rows), flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    )
    return _Strip(
        ink=np.asarray(turned > _INK),
        left=int(half - width / 2),
        right=int(half + width / 2),
        top=reach,
        bottom=reach + int(height),
        height=height,
    )


def _lines(strip: _Strip) -> list[tuple[int, int, int]]:
    """Rows of thin lines beside or through the text: row, first and last column.

    Neighbouring rows of one line give the longest one.
    """
    found: list[tuple[int, int, int]] = []
    for row in range(strip.ink.shape[0]):
        through = strip.top <= row <= strip.bottom
        run = _run(strip, row, bridge=through)
        if run is not None and not _is_wall(strip, row, run):
            found.append((row, *run))
    best: list[tuple[int, int, int]] = []
    for one in sorted(found, key=lambda line: line[1] - line[2]):
        if all(abs(one[0] - other[0]) > 0.3 * strip.height for other in best):
            best.append(one)
    return best[:3]


def _run(strip: _Strip, row: int, bridge: bool) -> tuple[int, int] | None:
    """The ink run of a row that goes along the whole text, from column to column."""
    line = strip.ink[row].copy()
    if bridge:
        margin = int(0.6 * strip.height)
        sides = (
            line[strip.left - 3 * margin : strip.left - margin],
            line[strip.right + margin : strip.right + 3 * margin],
        )
        if any(len(side) == 0 or side.mean() < 0.5 for side in sides):
            return None
        line[strip.left - margin : strip.right + margin] = True
    edges = np.flatnonzero(np.diff(np.concatenate([[0], line.astype(np.int8), [0]])))
    starts, ends = edges[::2], edges[1::2]
    if not len(starts):
        return None
    joined = np.flatnonzero(np.concatenate([[True], starts[1:] - ends[:-1] > _GAP_PX]))
    starts, ends = starts[joined], ends[np.append(joined[1:] - 1, len(ends) - 1)]
    across = (starts <= strip.left) & (ends >= strip.right)
    if not across.any():
        return None
    index = int(np.flatnonzero(across)[0])
    return int(starts[index]), int(ends[index])


def _is_wall(strip: _Strip, row: int, run: tuple[int, int]) -> bool:
    """Whether the row lies in something thick: ink goes along on both of its sides."""
    away = max(2, round(0.25 * strip.height))
    sides = [
        strip.ink[other, run[0] : run[1]].mean() if 0 <= other < strip.ink.shape[0] else 0.0
        for other in (row - away, row + away)
    ]
    return bool(max(sides) > 0.5)


def _marks(strip: _Strip, row: int, line: tuple[int, int], high: float) -> list[float]:
    """Columns where ink stands out on both sides of a line, from left to right.

    line: its first and last column; high: by how much ink stands out, in heights of the text.
    """
    start, end = line
    out = max(2, round(high * strip.height))
    if row - out < 0 or row + out >= strip.ink.shape[0]:
        return []
    reach = np.ones(2 * out + 1, dtype=bool)
    low = max(0, start - 2 * out)
    columns = slice(low, end + 2 * out)

    def near(inked: NDArray[np.bool_]) -> NDArray[np.bool_]:
        return np.convolve(inked, reach, mode="same") > 0

    crossed = near(strip.ink[row - out, columns]) & near(strip.ink[row + out, columns])
    text = slice(strip.left - low - out, strip.right - low + out)
    if strip.top - out <= row <= strip.bottom + out:
        crossed[max(0, text.start) : max(0, text.stop)] = False
    edges = np.flatnonzero(np.diff(np.concatenate([[0], crossed.astype(np.int8), [0]])))
    firsts, lasts = low + edges[::2].astype(float), low + edges[1::2] - 1.0
    middles = [float(one) for one in (firsts + lasts) / 2.0]
    if len(firsts) < 2:
        return middles
    wide = lasts - firsts + 1.0
    usual = float(np.median(wide))
    both = wide > max(_WIDE * usual, usual + 3.0)
    halves = (firsts[both] + usual / 2.0 - 0.5, lasts[both] - usual / 2.0 + 0.5)
    return sorted([*middles, *(float(one) for half in halves for one in half)])
