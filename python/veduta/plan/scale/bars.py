"""Scale bars: the numbers `0 1 2 3 5 m` in a row, each under its mark."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np

from veduta.plan.document import Text
from veduta.plan.scale.evidence import Hypothesis, Voter
from veduta.plan.scale.quantities import FOOT_M

_NUMBER = r"\d+(?:[.,]\d+)?"
_NUMBERS = re.compile(rf"^\W*({_NUMBER}(?:\s+{_NUMBER})*)\s*(m|ft|feet|metres|meters|Meter)?\W*$")
_MARKED = 3  # so many numbers in proportion are no chance
_DIGIT = 0.55  # width of a digit over the height of its line
_LETTER_GAP = 0.15  # positions of numbers, in heights of the line
_STRAIGHT = 0.02  # of the bar's length, by which numbers may stand off their proportion


@dataclass(frozen=True)
class _Number:
    value: float
    x: float
    y: float
    height: float
    unit: str


def bar_voters(texts: list[Text]) -> list[Voter]:
    """Evidence from rows of numbers that begin with 0 and grow in proportion to their place."""
    numbers = [number for text in texts for number in _numbers(text)]
    voters = []
    for zero in numbers:
        if zero.value == 0.0:
            row = _row(zero, numbers)
            if len(row) >= _MARKED:
                voters.append(_voter(row))
    return voters


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
