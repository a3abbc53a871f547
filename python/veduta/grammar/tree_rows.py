"""A derivation as rows that a person reads: shapes alike beside each other are one row."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from veduta.grammar.derivation import Choice, Shape
from veduta.grammar.outline import Attribute

MAX_ROWS = 20_000


@dataclass(frozen=True)
class Row:
    """One shape, or several neighbours that are alike down to the last row.

    last: for it and each shape above it but the first, whether it is the last of its parent's.
    count: how many shapes the row stands for. hidden: how many shapes are below it that have no
    row, as they lie deeper than was asked for. path, size_m, parameters: those of the first.
    """

    last: tuple[bool, ...]
    name: str
    path: tuple[int, ...]
    parameters: dict[str, Attribute]
    choices: tuple[Choice, ...]
    size_m: tuple[float, float, float]
    surface_class: str
    is_leaf: bool
    count: int = 1
    hidden: int = 0

    @property
    def depth(self) -> int:
        """0 for the shape that the rows begin with."""
        return len(self.last)


@dataclass
class _Branch:
    """A shape with the branches that are shown below it."""

    shape: Shape
    below: list[tuple[_Branch, int]]
    hidden: int
    likeness: tuple[object, ...]


def tree_rows(shape: Shape, depth: int) -> list[Row]:
    """The rows of a shape and of what is below it, down to `depth` rules; at most MAX_ROWS."""
    rows = []
    for row in _rows(_branch(shape, depth), 1, ()):
        rows.append(row)
        if len(rows) >= MAX_ROWS:
            break
    return rows


def _branch(shape: Shape, depth: int) -> _Branch:
    name, leaf = shape.name, shape.is_leaf
    choices = tuple(choice.index for choice in shape.choices)
    if depth == 0:
        hidden = sum(1 for _ in shape.walk()) - 1
        return _Branch(shape, [], hidden, (name, leaf, choices, hidden))
    below: list[tuple[_Branch, int]] = []
    for child in shape.children:
        branch = _branch(child, depth - 1)
        if below and below[-1][0].likeness == branch.likeness:
            below[-1] = (below[-1][0], below[-1][1] + 1)
        else:
            below.append((branch, 1))
    inner = tuple((branch.likeness, count) for branch, count in below)
    return _Branch(shape, below, 0, (name, leaf, choices, inner))


def _rows(branch: _Branch, count: int, last: tuple[bool, ...]) -> Iterator[Row]:
    shape = branch.shape
    yield Row(
        last=last,
        name=shape.name,
        path=shape.path,
        parameters=shape.parameters,
        choices=tuple(shape.choices),
        size_m=shape.size_m,
        surface_class=shape.surface_class,
        is_leaf=shape.is_leaf,
        count=count,
        hidden=branch.hidden,
    )
    for number, (child, times) in enumerate(branch.below, 1):
        yield from _rows(child, times, (*last, number == len(branch.below)))
