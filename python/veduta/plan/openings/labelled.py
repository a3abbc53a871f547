"""Windows that words beside a wall say: `Fenster`, `window`, or the number that a schedule gives.

Some sheets draw no glass. Where a wall that leads outdoors is interrupted beside such a word, or
crossed by two short strokes on both sides of it, that is the window.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Text
from veduta.plan.names.vocabulary import folded
from veduta.plan.openings.classify import Judged
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.lines import runs
from veduta.plan.openings.sky import leads_out
from veduta.plan.openings.strip import Sheet, sample
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.pieces import Piece

WORDS = frozenset({
    "window", "windows", "fenster", "fenetre", "finestra", "ventana", "janela", "raam", "ikkuna",
    "fonster", "vindu", "vindue", "okno", "חלון", "窓",
})  # fmt: skip
"""Folded: without case, accents and sizes."""

NUMBERED = re.compile(r"(w|f|fe|fen|wd|wn|win)[-. ]?(\d{1,2}[a-z]?)")
FEWEST_NUMBERS = 3
"""A number alone may count anything; so many of a kind are those of a schedule, which stand beside
every window of theirs."""

REACH = 1.2
"""A label stands so many doors' widths beside the face of its wall, at most ..."""
ALONG = 0.15
"""... and before its window, or beside it by this part of its width."""

LINE = 1.8
"""A wall that is no thicker than so many thin lines is one."""
TICK_REACH = 0.05
"""A tick reaches beyond the line on both sides by this part of a door at least ..."""
TICK_MOST = 0.35
"""... and on one of them by at most this part: walls go on."""
TICK_THICK = 0.09
"""It is no thicker than this part of a door."""
WIDTHS = (0.4, 4.5)
"""How wide windows are, in doors."""

SAID = 0.8
"""The score of a window that its label says: somebody wrote it there."""


def window_labels(texts: Sequence[Text]) -> list[NDArray[np.float64]]:
    """The middles (2,) of texts that say that a window is here."""
    middles = [np.asarray(one.box_px, float).mean(axis=0) for one in texts]
    found = [at for at, one in zip(middles, texts, strict=True) if _is_word(one.text)]
    numbered: defaultdict[str, list[tuple[str, NDArray[np.float64]]]] = defaultdict(list)
    for at, one in zip(middles, texts, strict=True):
        match = NUMBERED.fullmatch(one.text.strip().casefold())
        if match:
            numbered[match[1]].append((match[2], at))
    for schedule in numbered.values():
        if len({number for number, _ in schedule}) >= FEWEST_NUMBERS:
            found += [at for _, at in schedule]
    return found


def _is_word(text: str) -> bool:
    plain = folded(text)
    return plain in WORDS or plain.split(" ")[0] in WORDS


@dataclass(frozen=True)
class Labels:
    """Labels of windows on a sheet, (2,) px each, how wide its doors and thin lines are."""

    middles: Sequence[NDArray[np.float64]]
    door_px: float
    line_px: float

    def beside(self, line: Piece | Gap, low: float, high: float) -> bool:
        """Whether a label stands beside a stretch of a wall or a gap."""
        if not self.middles:
            return False
        along, across = line.arc.place(np.stack(self.middles))
        slack = ALONG * (high - low)
        near = np.abs(across) <= line.thickness_px / 2.0 + REACH * self.door_px
        return bool((near & (along >= low - slack) & (along <= high + slack)).any())

    def fits(self, width_px: float) -> bool:
        """Whether windows are so wide."""
        return WIDTHS[0] * self.door_px <= width_px <= WIDTHS[1] * self.door_px


def said_window(gap: Gap, labels: Labels) -> Judged | None:
    """A gap as a window, where a label beside it says so and it is as wide as one."""
    if not labels.fits(gap.width_px) or not labels.beside(gap, 0.0, gap.width_px):
        return None
    return Judged(gap, "window", "unknown", "none", "none", SAID)


def with_said(axes: Sequence[Axis], labels: Labels, sheet: Sheet, sky: BaseGeometry) -> list[Axis]:
    """The axes with the windows that labels beside them say."""
    if not labels.middles:
        return list(axes)
    return [_with_said(one, labels, sheet, sky) for one in axes]


def _with_said(axis: Axis, labels: Labels, sheet: Sheet, sky: BaseGeometry) -> Axis:
    line = axis.line
    ticked = _ticked(axis, labels, sheet, sky)
    kept = []
    for one in axis.openings:
        if ticked and one.judged.kind == "window":
            continue  # strokes across a line are what other windows were seen by
        leafless = one.judged.hinge == "none" and one.judged.kind != "window"
        beside = leafless and labels.beside(line, one.first, one.last)
        if beside and leads_out(line, (one.first, one.last), sky):
            said = replace(one.judged, kind="window", type="unknown", score=SAID)
            one = replace(one, judged=said)
        kept.append(one)
    return replace(axis, openings=(*kept, *ticked))


def _ticked(axis: Axis, labels: Labels, sheet: Sheet, sky: BaseGeometry) -> list[OnAxis]:
    """Windows between two short strokes across a wall that is a line, with a label between."""
    line = axis.line
    thin = line.thickness_px <= LINE * labels.line_px
    if line.bulge or not (thin or axis.outline or axis.origin == "inferred"):
        return []
    ticks = ticks_across(line, sheet, labels.door_px)
    found = []
    for low, high in zip(ticks, ticks[1:], strict=False):
        doors = [one for one in axis.openings if one.judged.kind != "window"]
        taken = any(one.first < high and low < one.last for one in doors)
        if not labels.fits(high - low) or taken or not labels.beside(line, low, high):
            continue
        if leads_out(line, (low, high), sky):
            gap = Gap.along(line, low, high)
            said = Judged(gap, "window", "single-line", "none", "none", SAID)
            found.append(OnAxis(said, low, high, along=True))
    return found


def ticks_across(line: Piece, sheet: Sheet, door_px: float) -> list[float]:
    """Places along a straight wall that is a line where a short stroke crosses it, in pixels.

    The wall may be thicker than its line, as those are that no more than a line was found of.
    """
    least, most = max(2.5, TICK_REACH * door_px), TICK_MOST * door_px
    steps = np.arange(0.0, line.thickness_px / 2.0 + most + 2.0)
    along = np.arange(0.0, line.length_px + 0.5)
    sides = []
    for side in (1.0, -1.0):
        marks = sample(sheet.faint, line.arc.at(along[None], side * steps[:, None])) > 0
        sides.append(_reach(marks))
    shorter = np.minimum(*sides)
    half = float(np.median(shorter))
    crossed = (shorter >= half + least) & (shorter <= half + most)
    return [
        float(low + high - 1) / 2.0
        for low, high in zip(*runs(crossed), strict=True)
        if high - low <= max(TICK_THICK * door_px, 4.0)
    ]


def _reach(marks: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(columns,) how far marks (rows, columns) go on from the first row."""
    ended = np.cumsum(~marks, axis=0) > 0
    return np.asarray((~ended).sum(axis=0), np.float64)
