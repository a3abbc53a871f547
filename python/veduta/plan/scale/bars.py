"""Scale bars: the numbers `0 1 2 3 5 m` in a row, each under its mark."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.scale.evidence import Hypothesis, Voter
from veduta.plan.scale.quantities import FOOT_M

_NUMBER = r"\d+(?:[.,]\d+)?"
_NUMBERS = re.compile(rf"^\W*({_NUMBER}(?:\s+{_NUMBER})*)\s*(m|ft|feet|metres|meters|Meter)?\W*$")
_MARKED = 3  # so many numbers in proportion are no chance
_DIGIT = 0.55  # width of a digit over the height of its line
_LETTER_GAP = 0.15  # positions of numbers, in heights of the line
_AROUND = 3.0  # heights of the line between numbers and their bar
_BAR = 0.97  # of a bar that is ink
_ENDS_PX = 3
_LOOSE = 0.04  # of a bar's length, by which numbers may stand off its ends
_STRAIGHT = 0.02  # of the bar's length, by which numbers may stand off their proportion


@dataclass(frozen=True)
class _Number:
    value: float
    x: float
    y: float
    height: float
    unit: str


def bar_voters(texts: list[Text], ink: NDArray[np.bool_] | None = None) -> list[Voter]:
    """Evidence from rows of numbers that begin with 0 and grow in proportion to their place.

    A 0 that was not read is believed where a bar is drawn in the `ink` (h, w) from there on.
    """
    numbers = [number for text in texts for number in _numbers(text)]
    rows = [_row(zero, numbers) for zero in numbers if zero.value == 0.0]
    rows = [row for row in rows if len(row) >= _MARKED]
    if ink is None:
        return [_voter(row) for row in rows]
    if not rows:
        pairs = [_pair(one, other) for one in numbers for other in numbers]
        rows = [row for row in pairs if row and _on_bar(row, ink) is not None][:1]
    return [_voter(_on_bar(row, ink) or row) for row in rows]


def _pair(first: _Number, last: _Number) -> list[_Number]:
    """Two numbers on a line, the last with its unit, and the 0 before them; empty of others."""
    level = abs(first.y - last.y) < 0.5 * first.height
    if not (level and last.unit and 0.0 < first.value < last.value and first.x < last.x):
        return []
    step = (last.x - first.x) / (last.value - first.value)
    zero = _Number(0.0, first.x - first.value * step, first.y, first.height, "")
    return [zero, first, last]


def _on_bar(row: list[_Number], ink: NDArray[np.bool_]) -> list[_Number] | None:
    """The 0 and the last number at the ends of the bar that is drawn from one to the other.

    A line that goes on beyond them is none. None without one.
    """
    first, last = row[0], row[-1]
    reach = _AROUND * first.height
    rows = slice(max(0, round(first.y - reach)), max(0, round(first.y + reach)))
    left, right = round(first.x), round(last.x)
    slack = max(_ENDS_PX, round(_LOOSE * (right - left)))
    if left < 2 * slack or right + 2 * slack >= ink.shape[1] or rows.stop == 0:
        return None
    beside = ink[rows]
    full = beside[:, left + slack : right - slack].mean(axis=1) > _BAR
    bare = ~(
        beside[:, left - 2 * slack : left - slack].any(axis=1)
        | beside[:, right + slack : right + 2 * slack].any(axis=1)
    )
    if not (full & bare).any():
        return None
    drawn = np.flatnonzero(beside[full & bare, left - slack : right + slack].any(axis=0))
    start, end = left - slack + int(drawn[0]), left - slack + int(drawn[-1]) + 1
    return [replace(first, x=float(start)), replace(last, x=float(end))]


def _numbers(text: Text) -> list[_Number]:
    """The numbers of a text that is nothing else, with their centres; the ends of a long one."""
    match = _NUMBERS.match(text.text)
    box = np.asarray(text.box_px)
    side = box[1] - box[0]
    if match is None or abs(side[1]) > 0.2 * abs(side[0]):
        return []
    words = match[1].split()
    unit = match[2] or ""
    height = float(np.linalg.norm(box[3] - box[0]))
    left, right = float(box[:, 0].min()), float(box[:, 0].max())
    y = float(box[:, 1].mean())
    values = [float(word.replace(",", ".")) for word in words]
    centres = np.linspace(
        left + _DIGIT * height * len(words[0]) / 2.0,
        right - _DIGIT * height * (len(words[-1]) / 2.0 + len(unit) + (0.5 if unit else 0.0)),
        len(words),
    )
    if len(words) == 1:
        shift = _DIGIT * height * len(unit) / 2.0
        centres = np.array([(left + right) / 2.0 - shift])
    elif not np.allclose(np.diff(values), values[1] - values[0]):
        # Only of even steps are the places of those between known.
        values, centres = [values[0], values[-1]], centres[[0, -1]]
    return [
        _Number(value, float(x), y, height, unit) for value, x in zip(values, centres, strict=True)
    ]


def _row(zero: _Number, numbers: list[_Number]) -> list[_Number]:
    """The most numbers on the line of `zero`, right of it, that are in proportion."""
    line = [
        one
        for one in numbers
        if one.x > zero.x and one.value > 0 and abs(one.y - zero.y) < 0.5 * zero.height
    ]
    best: list[_Number] = []
    for last in line:
        step = (last.x - zero.x) / last.value
        allowed = _STRAIGHT * (last.x - zero.x) + _LETTER_GAP * zero.height
        fits = [one for one in line if abs(one.x - zero.x - one.value * step) <= allowed]
        if len(fits) > len(best):
            best = fits
    return [zero, *sorted(best, key=lambda one: one.x)]


def _voter(row: list[_Number]) -> Voter:
    values = np.array([one.value for one in row])
    places = np.array([one.x for one in row])
    slope = float(np.polyfit(values, places, 1)[0])  # px for each unit
    spread = math.sqrt(float(np.sum((values - values.mean()) ** 2)))
    sigma = math.hypot(_LETTER_GAP * row[0].height / (slope * spread), 0.005)
    units = {one.unit for one in row if one.unit}
    metre = FOOT_M if units & {"ft", "feet"} else 1.0
    reading = Hypothesis(math.log(metre / slope), sigma, 1.0 if units else 0.7)
    text = " ".join(f"{value:g}" for value in values) + f" {'/'.join(sorted(units))}".rstrip()
    return Voter("bar", text, "bar", (reading,))
