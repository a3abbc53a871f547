"""Sizes in text: `4.94 x 3.06`, `12'-0" x 11'1`, `17,4 m2`, `3450`, `1:100`.

What is written can mean several things (`345` on a dimension line is centimetres or millimetres;
in `157 x 125` the marks of feet were lost), so that a text gives readings, each with a trust, and
the vote over the whole sheet (`vote`) decides. All in metres and square metres.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

FOOT_M = 0.3048
INCH_M = 0.0254
Kind = Literal["size", "length", "area", "ratio"]


@dataclass(frozen=True)
class Quantity:
    """One reading of a text.

    `values` holds two sides (size), a length, an area, or the N of 1:N (ratio). `step` is the unit
    of the last digit that is written, in metres (size, length) or square metres (area): what is
    printed was rounded to it. `trust` is 0 to 1.
    """

    kind: Kind
    values: tuple[float, ...]
    step: float
    trust: float


_LENGTH_M = (0.3, 100.0)  # sides of rooms and of what dimension lines measure
_AREA_M2 = (0.3, 5000.0)
_RATIOS = (
    10,
    20,
    25,
    30,
    40,
    48,
    50,
    60,
    75,
    96,
    100,
    125,
    150,
    192,
    200,
    250,
    300,
    400,
    500,
    1000,
)

MARKED_TRUST = 0.6
"""Of `103"`, which is 10'3" where the mark of feet was lost, if rooms are so large ..."""

LOST_MARK_TRUST = 0.5
"""Of `157`, which is 15'7 where both marks were lost."""

LEAST_ROOM_M, LEAST_INCHES = 1.2, 48
"""... and may be inches in all, of rooms."""
TATAMI_M2 = 1.62
"""A mat (jo) as agents in Japan count it, at least: 1.62 m2 by their rule of fair display ..."""
TATAMI_STEP_M2 = 0.25
"""... and how exactly it says an area: real mats are 1.55 to 1.82 m2."""
TSUBO_M2 = 400.0 / 121.0
BARE_FEET, BARE_METRES = (5, 40), (2, 12)
"""Whole sides as in 11x12 are feet, seldom metres, of rooms between these sizes ..."""
BARE_FEET_TRUST, BARE_METRES_TRUST = 0.7, 0.3
BARE_STEP = 0.5
"""... and mean no more than the nearest half of the unit."""

_METRIC = r"(?P<{0}m>\d{{1,2}}[.]\d{{1,3}})\s*(?:m(?=\W|x|$))?"
_FEET = (
    r"(?P<{0}f>\d{{1,3}})\s*(?:'|ft(?![a-wyz])\.?)\s*-?\s*"
    r"(?:(?P<{0}i>\d{{1,2}}(?:[.]\d+)?)(?!\d)(?:\s*(?P<{0}p>\d)/(?P<{0}q>\d{{1,2}}))?"
    r"\s*(?:\"|''?|in(?![a-wyz])\.?)?)?"
)
_WHOLE = r"(?P<{0}n>\d{{2,5}})\s*(?:(?P<{0}u>mm|cm)|(?P<{0}k>\"))?"
_SIDE = rf"(?:{_METRIC}|{_FEET}|{_WHOLE})"
_SIZE = re.compile(
    rf"(?<![\d.=]){_SIDE.format('a')}\s*x+\s*{_SIDE.format('b')}(?![\d.])", re.IGNORECASE
)
_ALONE = re.compile(rf"^\W*{_SIDE.format('a')}\W*$", re.IGNORECASE)
_WITH_UNIT = re.compile(r"(?<![\d.=])(\d{1,3}(?:[.]\d{1,3})?)\s*m(?![\w²?*])", re.IGNORECASE)
_BARE_M = re.compile(r"(?<![\d.=])(\d{1,3}[.]\d)\s*m(?![\w²?*])")
_SQUARE_M = re.compile(
    r"(?<![\d.])(\d{1,4}(?:[.]\d{1,2})?)\s*"
    r"(?:(?P<sure>[mM]\s?[2²]|㎡|sq\.?\s?m\w*\b|sqm\b|qm\b|kvm\b|mq\b)|(?P<slip>[mn]\s?[?*z°ª\"'2]|rn2))"
)
_SQUARE_FT = re.compile(
    r"(?<![\d.])(\d{2,5}(?:[.]\d{1,2})?)\s*(?:sq\.?\s?f(?:ee)?t\b|ft\s?[2²]|sqft\b|sf\b)", re.I
)
_BARE = re.compile(
    r"(?<![\d.'\"=])(\d{1,2})\s*x\s*(\d{1,2})(?![\d.'\"]|\s*(?:cm|mm))", re.IGNORECASE
)
_MATS = re.compile(r"(\d{1,2}(?:[.]\d{1,2})?)\s*(?:帖|畳|疊|叠|tatami|jo\b|mats?\b)", re.IGNORECASE)
_TSUBO = re.compile(r"(\d{1,3}(?:[.]\d{1,2})?)\s*(?:坪|tsubo)", re.IGNORECASE)
_HEIGHT = re.compile(
    r"[<>≤≥]|\b(?:ht|hsp|rh|clg|hauteur|höhe|hoehe|height|ceiling|dachschr\w*)\b|\bh\s?[=:]",
    re.IGNORECASE,
)
"""A height of a ceiling or of a sloping roof (`<1,80m`, `ht. 1.35`) is no length on the plan."""
_RATIO = re.compile(r"(?<![\d.])1\s?[:/]\s?(\d{2,4})(?!\d)")
_INCH_RATIO = re.compile(r"(?<!\d)(\d{1,2})/(\d{1,2})\s?(?:\"|'')\s?=\s?1\s?'")


def read_quantities(text: str) -> list[Quantity]:
    """All readings of a text as sizes; none where it holds no size."""
    plain = _plain(text)
    areas = list(_areas(plain))
    found = [*_ratios(plain), *_sizes(plain), *_bare_feet(plain), *areas]
    if not found:
        found = list(_lengths(plain))
    return found


def _plain(text: str) -> str:
    """One character for each meaning: of times, feet, inches, decimals and thousands."""
    plain = re.sub(r"[×хХ✕*]|\bby\b", "x", text)
    plain = re.sub(r"[’‘′`´ʹ]", "'", plain)
    # In small print the mark of inches is read as that of degrees.
    plain = re.sub(r"[”“″ʺ]|''|(?<=\d)\s?[°º]", '"', plain)
    plain = re.sub(r"[–—−]", "-", plain)
    plain = re.sub(r"(?<=\d)\s?[,.]\s?(?=\d)", ".", plain)
    plain = re.sub(r"(?<=[\d.'])[oO](?=[\d.'\" ]|$)", "0", plain)
    plain = re.sub(r"(?<![\w])[lI|](?=[\d.'])|(?<=[\d.'])[lI|](?=[\d.'\" ]|$)", "1", plain)
    return re.sub(r"(?<=\b\d) (?=\d{3}\b)", "", plain)


def _ratios(plain: str) -> Iterator[Quantity]:
    for match in _RATIO.finditer(plain):
        if int(match[1]) in _RATIOS:
            yield Quantity("ratio", (float(match[1]),), 0.0, 1.0)
    for match in _INCH_RATIO.finditer(plain):
        if int(match[1]) and int(match[2]):
            yield Quantity("ratio", (12.0 * int(match[2]) / int(match[1]),), 0.0, 1.0)


def _areas(plain: str) -> Iterator[Quantity]:
    for match in _SQUARE_M.finditer(plain):
        step = 10.0 ** -len(match[1].partition(".")[2])
        trust = 1.0 if match["sure"] else 0.7
        yield from _within("area", (float(match[1]),), step, trust)
    for match in _SQUARE_FT.finditer(plain):
        yield from _within("area", (float(match[1]) * FOOT_M**2,), FOOT_M**2, 1.0)
    for match in _MATS.finditer(plain):
        yield from _within("area", (float(match[1]) * TATAMI_M2,), TATAMI_STEP_M2, 0.7)
    for match in _TSUBO.finditer(plain):
        yield from _within("area", (float(match[1]) * TSUBO_M2,), 0.1 * TSUBO_M2, 1.0)


def _bare_feet(plain: str) -> Iterator[Quantity]:
    """`11X12` of a bedroom: whole feet, or whole metres, without a mark."""
    readings = (
        (FOOT_M, BARE_FEET, BARE_FEET_TRUST),
        (1.0, BARE_METRES, BARE_METRES_TRUST),
    )
    for match in _BARE.finditer(plain):
        sides = (int(match[1]), int(match[2]))
        for unit, (low, high), trust in readings:
            if low <= min(sides) and max(sides) <= high:
                values = (sides[0] * unit, sides[1] * unit)
                yield Quantity("size", values, BARE_STEP * unit, trust)


def _sizes(plain: str) -> Iterator[Quantity]:
    for match in _SIZE.finditer(plain):
        first, second = list(_side(match, "a")), list(_side(match, "b"))
        for unit, a, step, trust_a in first:
            for other, b, _, trust_b in second:
                trust = min(trust_a, trust_b)
                # A hob or a tile of 24" x 36" is no room of two feet four by three feet six, and
                # 11 x 12 are feet, not a foot one by a foot two.
                guessed = trust == MARKED_TRUST or (unit == "ft" and trust == LOST_MARK_TRUST)
                no_room = guessed and min(a, b) < LEAST_ROOM_M
                if unit == other and not no_room:
                    yield from _within("size", (a, b), step, trust)


def _lengths(plain: str) -> Iterator[Quantity]:
    if _HEIGHT.search(plain):
        return
    # The raised 2 is the first thing to be lost in print: `17,4 m` may be an area.
    for match in _BARE_M.finditer(plain):
        step = 10.0 ** -len(match[1].partition(".")[2])
        yield from _within("area", (float(match[1]),), step, 0.3)
    alone = _ALONE.match(plain)
    if alone:
        readings = _side(alone, "a") if alone["an"] is None else _whole(alone["an"], alone["au"])
        for unit, value, step, trust in readings:
            if alone["an"] is None or unit != "ft":  # `157` alone is not taken for 15 feet 7
                yield from _within("length", (value,), step, trust)
        return
    for match in _WITH_UNIT.finditer(plain):
        step = 10.0 ** -len(match[1].partition(".")[2])
        yield from _within("length", (float(match[1]),), step, 0.7)


def _side(match: re.Match[str], which: str) -> Iterator[tuple[str, float, float, float]]:
    """Readings of one side: unit, metres, metres of the last digit, trust."""
    metres, feet, whole = match[which + "m"], match[which + "f"], match[which + "n"]
    if metres:
        yield "m", float(metres), 10.0 ** -len(metres.partition(".")[2]), 1.0
    elif feet:
        inches = float(match[which + "i"] or 0.0)
        if match[which + "p"] and int(match[which + "q"]):
            inches += int(match[which + "p"]) / int(match[which + "q"])
        if inches < 12.0:
            yield "ft", int(feet) * FOOT_M + inches * INCH_M, INCH_M, 1.0
    else:
        yield from _whole(whole, match[which + "u"], bool(match[which + "k"]))


def _whole(
    digits: str, unit: str | None, inches_marked: bool = False
) -> Iterator[tuple[str, float, float, float]]:
    """What a whole number can mean. Trusts follow what draughtsmen write, not a measurement."""
    number = int(digits)
    if inches_marked:
        yield from _feet_of(digits, MARKED_TRUST)
        if number >= LEAST_INCHES:
            yield "ft", number * INCH_M, INCH_M, 0.4
        if len(digits) < 4:
            return
    if unit == "mm" or (unit is None and len(digits) >= 3):
        yield "mm", number / 1000.0, 0.005, 0.9 if len(digits) >= 4 or unit else 0.4
    if unit == "cm" or (unit is None and 2 <= len(digits) <= 4):
        yield "cm", number / 100.0, 0.01, 0.9 if unit else (0.5 if len(digits) == 3 else 0.2)
    if unit is None:
        yield from _feet_of(digits, LOST_MARK_TRUST)


def _feet_of(digits: str, trust: float) -> Iterator[tuple[str, float, float, float]]:
    """Feet and inches whose mark between was lost."""
    for cut in range(1, min(3, len(digits))):
        inches = digits[cut:]
        if len(inches) <= 2 and int(inches) < 12 and (len(inches) == 1 or inches[0] != "0"):
            yield "ft", int(digits[:cut]) * FOOT_M + int(inches) * INCH_M, INCH_M, trust


def _within(kind: Kind, values: tuple[float, ...], step: float, trust: float) -> Iterator[Quantity]:
    low, high = _AREA_M2 if kind == "area" else _LENGTH_M
    if all(low <= value <= high for value in values):
        yield Quantity(kind, values, step, trust)
