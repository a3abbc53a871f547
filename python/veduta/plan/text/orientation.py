"""Which way up a sheet is, and whether its scan is a mirror image: as its text can be read.

Regions of text look alike in all eight positions of a sheet, words do not. The longest regions are
read in each position; words for rooms and sizes count most, since letters such as H and O read well
in any of them. A writing that the network does not know (Hebrew, Japanese, somebody's hand) gives
letters that mean nothing in every position, some more than others: only what is read well may turn
a sheet or mirror it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.names.vocabulary import meanings
from veduta.plan.scale.quantities import read_quantities
from veduta.plan.text.engine import Line, read_line, side_by_side
from veduta.plan.text.regions import find_overview
from veduta.plan.text.strips import in_colour, strip_of

_REGIONS = 10  # so many regions are read in eight positions: 80 lines, a few seconds
_FIRST = 5  # so many are read as they stand; where they make sense, that is all
_SENSE = 3.0  # how much more a word or a size counts than letters that are none
_READ = 0.6  # what is read less surely makes no sense
_SIGNS = 2  # nor does a single letter: many are a room's name, and a digit in a mirror is one
_FIGURES = 0.5  # of the letters and digits of a size so many are digits
_SYMMETRIC = frozenset("AHIMOTUVWXY8010o|-")  # the same in a mirror
_MARGIN = 1.5  # another position must read so much better than the one that the sheet is in
_WELL = 0.85  # what is no word known, but read so surely, speaks for a position, too, ...
_LETTERS = 4  # ... if it has so many letters that a mirror does not show alike
_LEAST = 4.0  # and say so much by itself: a short word that makes sense, not a line read as an l


@dataclass(frozen=True)
class Position:
    """How a scan lies: it is set right by `quarter_turns` counter-clockwise, then mirrored.

    `score` is what its text says in this position, `as_it_is` in the scan's own; both are sums over
    characters. Without text on the sheet both are 0 and the scan is left as it is.
    """

    mirrored: bool
    quarter_turns: int
    score: float
    as_it_is: float

    @property
    def is_upright(self) -> bool:
        """Whether nothing is to be done."""
        return not self.mirrored and self.quarter_turns == 0


def find_position(
    pixels: NDArray[np.uint8],
    overview: NDArray[np.float64] | None = None,
) -> Position:
    """The position in which the text of a scan (h, w, 3) or (h, w) reads best.

    `overview` (n, 4, 2) is what `find_overview` gave, where it was called before.
    """
    pixels = in_colour(pixels)
    telling = _telling(find_overview(pixels) if overview is None else overview)
    first = _read_all(pixels, telling[:_FIRST], False, 0)
    as_it_is = sum(map(_weight, first))
    if not telling or sum(map(_makes_sense, first)) * 2 > len(first):
        return Position(False, 0, as_it_is, as_it_is)
    scores = {
        (mirrored, turns): _position_score(pixels, telling, mirrored, turns)
        for mirrored in (False, True)
        for turns in range(4)
    }
    own = scores[False, 0]
    best = max(scores, key=lambda position: scores[position])
    if scores[best] < max(_MARGIN * own, _LEAST):
        best = (False, 0)
    return Position(best[0], best[1], scores[best], own)


def set_right(pixels: NDArray[np.uint8], position: Position) -> NDArray[np.uint8]:
    """A scan turned and mirrored so that its text reads."""
    turned = np.rot90(pixels, position.quarter_turns)
    return np.ascontiguousarray(np.fliplr(turned) if position.mirrored else turned)


def right_from_scan(position: Position, size_px: tuple[int, int]) -> NDArray[np.float64]:
    """The affine (3, 3) that takes pixels of a scan of this width and height to those set right."""
    width, height = size_px
    matrix = np.eye(3)
    for _ in range(position.quarter_turns % 4):
        # A quarter turn counter-clockwise: what was right is on top.
        matrix = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, width], [0.0, 0.0, 1.0]]) @ matrix
        width, height = height, width
    if position.mirrored:
        matrix = np.array([[-1.0, 0.0, width], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]) @ matrix
    return matrix


def _telling(regions: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """The regions with most letters, by their length over their width; lines of notes are few."""

    def length(quad: NDArray[np.float64]) -> float:
        sides = np.linalg.norm(quad - np.roll(quad, -1, axis=0), axis=1)
        return float(min(sides.max() / max(sides.min(), 1.0), 6.0))

    return sorted(regions, key=length, reverse=True)[:_REGIONS]


def _position_score(
    pixels: NDArray[np.uint8],
    regions: Iterable[NDArray[np.float64]],
    mirrored: bool,
    turns: int,
) -> float:
    """What speaks for a position: of the sheet's own all that is read, of others what is sure."""
    lines = _read_all(pixels, regions, mirrored, turns)
    as_it_is = not mirrored and turns == 0
    return sum(_weight(line) for line in lines if as_it_is or is_well_read(line))


def _read_all(
    pixels: NDArray[np.uint8],
    regions: Iterable[NDArray[np.float64]],
    mirrored: bool,
    turns: int,
) -> list[Line]:
    return side_by_side(lambda quad: _read_at(pixels, quad, mirrored, turns), regions)


def _read_at(
    pixels: NDArray[np.uint8], quad: NDArray[np.float64], mirrored: bool, turns: int
) -> Line:
    """What a region says if the sheet lies so. A region across the line of reading is left out."""
    quad = np.roll(quad, -turns, axis=0)
    across = np.linalg.norm(quad[1] - quad[0])
    if np.linalg.norm(quad[3] - quad[0]) > 1.5 * across:
        return Line("", 0.0)
    strip = strip_of(pixels, quad)
    return read_line(np.ascontiguousarray(strip[:, ::-1]) if mirrored else strip)


def _makes_sense(line: Line) -> bool:
    """Whether it is a word for a room, or a size in digits.

    Sizes are read from letters that look like digits, too: in a mirror 2,78 reads as 8T,S.
    """
    signs = [sign for sign in line.text if sign.isalnum()]
    if line.score <= _READ or len(signs) < _SIGNS:
        return False
    figures = sum(map(str.isdecimal, signs)) >= _FIGURES * len(signs)
    return bool(meanings(line.text) or (figures and read_quantities(line.text)))


def is_well_read(line: Line) -> bool:
    """Whether a line is a word for a room, a size, or letters that are read without doubt."""
    if _makes_sense(line):
        return True
    telling = [one for one in _latin(line.text) if one not in _SYMMETRIC and one.isalpha()]
    return line.score >= _WELL and len(telling) >= _LETTERS


def _latin(text: str) -> list[str]:
    return [letter for letter in text if letter.isalnum() and ord(letter) < 0x250]


def _weight(line: Line) -> float:
    """How much a reading says for its position."""
    telling = sum(0.3 if letter in _SYMMETRIC else 1.0 for letter in _latin(line.text))
    return line.score**2 * telling * (_SENSE if _makes_sense(line) else 1.0)
