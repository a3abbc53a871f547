"""Rectangles in a wall as nested splits of a rule file: rows within columns within rows.

Cuts run through the whole of what they cut, as `split` does it. Rectangles that stand around each
other like the sails of a windmill cannot be parted so; the smallest of them is then left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.rectangles import Rectangle

# Sizes in rule files are whole millimetres.
DECIMALS = 3
LEAST_M = 0.0005


@dataclass(frozen=True)
class Cell:
    """A rectangle, and what stands in it in the words of the rule file.

    upright: the same with wall below and above it, with places for the three heights; or nothing.
    """

    rectangle: Rectangle
    content: str
    upright: str = ""


class StuckError(ValueError):
    """No cut parts these cells from each other."""

    def __init__(self, cells: Sequence[Cell]) -> None:
        super().__init__(f"no cut parts {len(cells)} cells")
        self.cells = tuple(cells)


def metres(value_m: float) -> str:
    """The length as rule files have it."""
    text = f"{value_m:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def snapped(rectangle: Rectangle) -> Rectangle:
    """The rectangle with its edges on whole millimetres."""
    sides = (rectangle.x0, rectangle.z0, rectangle.x1, rectangle.z1)
    return Rectangle(*(round(side, DECIMALS) for side in sides))


def parted(cells: Sequence[Cell], region: Rectangle) -> tuple[list[Cell], list[Cell]]:
    """The cells that splits can part from each other, and those left out for it."""
    kept, dropped = list(cells), []
    while True:
        try:
            splits(kept, region, "Wall.")
        except StuckError as stuck:
            smallest = min(stuck.cells, key=lambda cell: cell.rectangle.area)
            kept.remove(smallest)
            dropped.append(smallest)
        else:
            return kept, dropped


def splits(cells: Sequence[Cell], region: Rectangle, rest: str, height: str = "{}") -> str:
    """The operations that cut the region into the cells; what is between them is `rest`.

    Cells keep their sizes, and what is between them takes what is left. `height` makes of a height
    what it is along y of the shape that is split. StuckError where no row of cuts parts the cells.
    """
    if not cells:
        return rest
    column = _column(cells, region)
    if column:
        return column
    for axis in ("x", "z"):
        groups = _groups(cells, axis)
        low, high = _ends(region, axis)
        whole = len(groups) == 1 and _is_near(groups[0][0], low) and _is_near(groups[0][1], high)
        if not whole:
            return _split(groups, region, axis, rest, height)
    if len(cells) > 1:
        raise StuckError(cells)
    return cells[0].content


def _column(cells: Sequence[Cell], region: Rectangle) -> str:
    """A cell that is as wide as the region, with what is below and above it, in its own words."""
    (cell, *others), place = cells, cells[0].rectangle
    heights = (place.z0 - region.z0, place.height, region.z1 - place.z1)
    is_wide = _is_near(place.x0, region.x0) and _is_near(place.x1, region.x1)
    if others or not is_wide or min(heights) <= LEAST_M:
        return ""
    return cell.upright.format(*map(metres, heights))


Group = tuple[float, float, list[Cell]]


def _groups(cells: Sequence[Cell], axis: str) -> list[Group]:
    """The cells in the order of the axis; those that overlap along it are in one group."""
    groups: list[Group] = []
    for cell in sorted(cells, key=lambda cell: _ends(cell.rectangle, axis)):
        low, high = _ends(cell.rectangle, axis)
        if groups and low < groups[-1][1] - LEAST_M:
            start, end, members = groups[-1]
            groups[-1] = (start, max(end, high), [*members, cell])
        else:
            groups.append((low, high, [cell]))
    return groups


def _split(groups: Sequence[Group], region: Rectangle, axis: str, rest: str, height: str) -> str:
    at, end = _ends(region, axis)
    parts = []
    shape = "{}" if axis == "x" else height

    def size(value_m: float) -> str:
        return shape.format(metres(value_m))

    for low, high, members in groups:
        if low - at > LEAST_M:
            parts.append(f"~{size(low - at)} : {rest}")
        content = splits(members, _within(region, axis, low, high), rest, height)
        parts.append(f"{size(high - low)} : {content}")
        at = high
    if end - at > LEAST_M:
        parts.append(f"~{size(end - at)} : {rest}")
    name = "x" if axis == "x" else "y"
    return f"split({name}) {{ {' | '.join(parts)} }}"


def _within(region: Rectangle, axis: str, low: float, high: float) -> Rectangle:
    if axis == "x":
        return Rectangle(low, region.z0, high, region.z1)
    return Rectangle(region.x0, low, region.x1, high)


def _ends(rectangle: Rectangle, axis: str) -> tuple[float, float]:
    if axis == "x":
        return rectangle.x0, rectangle.x1
    return rectangle.z0, rectangle.z1


def _is_near(one: float, other: float) -> bool:
    return abs(one - other) <= LEAST_M
