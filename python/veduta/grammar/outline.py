"""A polygon as a file of lots has it, before it is known where it lies."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.edge_values import edge_texts, without_edges
from veduta.grammar.failures import Failures
from veduta.run.report import Failure

MOST_KINDS = 50
"""Kinds of other things that are told apart."""
MOST_OF_NAME = 200
"""Characters of a lot's name."""
Attribute = bool | float | str


@dataclass(frozen=True)
class Outline:
    """A polygon as the file has it: rings of (n, 3) in the file's own frame."""

    subject: str
    name: str
    rings: list[NDArray[np.float64]]
    attributes: dict[str, Attribute]


@dataclass(frozen=True)
class Road:
    """A road: points (n, 3) along its middle, in the file's own frame; the width of its carriageway
    (m); whether it is a path that no cars take.
    """

    points: NDArray[np.float64]
    width_m: float
    is_path: bool = False


@dataclass
class Found:
    """What a reader finds in a file beside outlines; whole when it has given the last of them.

    epsg: code of the reference system, None where the file names none. others: how many of each
    kind are no polygons. roads: the lines that are roads. is_settled: whether the call says the
    reference system, so that it does not matter what the file names. has_roads: whether the call
    names a file of roads, so that other layers need not be looked at for some.
    """

    epsg: int | None = None
    is_settled: bool = False
    has_roads: bool = False
    failures: Failures = field(default_factory=Failures)
    notes: list[str] = field(default_factory=list)
    others: Counter[str] = field(default_factory=Counter)
    roads: list[Road] = field(default_factory=list)

    def fail(self, subject: str, reason: str) -> None:
        """Something that would be a lot gives none."""
        self.failures.add(Failure(subject=subject, kind="input", reason=reason))

    def pass_over(self, kind: str) -> None:
        """Something is no polygon."""
        is_known = kind in self.others or len(self.others) < MOST_KINDS
        self.others[kind if is_known else "of other kinds"] += 1

    def all_notes(self) -> list[str]:
        """The notes, and what was left out."""
        told = ", ".join(f"{count} {kind}" for kind, count in sorted(self.others.items()))
        return [*self.notes, f"left out, for they are no polygons: {told}"] if told else self.notes


Outlines = Iterator[Outline]
"""The outlines of a file, one after the other."""


def plain_attributes(properties: Any) -> dict[str, Attribute]:
    """The properties that a rule file can take: truth values, numbers, texts; lists of edges."""
    if not isinstance(properties, dict):
        return {}
    found: dict[str, Attribute] = {}
    for name, value in properties.items():
        if isinstance(value, bool | str):
            found[name] = value
        elif isinstance(value, int | float) and abs(value) < 1e300:
            found[name] = float(value)
    return without_edges(found) | edge_texts(properties)


def name_of(attributes: dict[str, Attribute], keys: Sequence[str], number: int) -> str:
    """What a row is called: the first of these properties that says it, else its number."""
    for key in keys:
        value = attributes.get(key)
        if isinstance(value, float) and value.is_integer():
            value = str(int(value))
        if isinstance(value, str) and value.strip():
            return "".join(c for c in value.strip() if c.isprintable())[:MOST_OF_NAME]
    return f"lot-{number}"


def outlines_of(
    polygons: Iterable[list[NDArray[np.float64]]],
    count: int,
    name: str,
    subject: str,
    attributes: dict[str, Attribute],
) -> Outlines:
    """An outline of each polygon of a row, numbered where there are several.

    count: how many there are; a fault of one leaves those before it.
    """
    for index, rings in enumerate(polygons, 1):
        own = name if count == 1 else f"{name}-{index}"
        yield Outline(f"{subject} ({own})", own, rings, attributes)
