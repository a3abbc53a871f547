"""A structure of a style (theta of the thesis): its attributes, and the choices of its rules."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from veduta.facade.style.prior import Distribution, Value

Path = tuple[int, ...]
SCALE = "scale"
"""The attribute that no rule has: metres of the style in a metre of the document."""


@dataclass(frozen=True)
class Taken:
    """The alternatives that a shape's rule took in its random choices, as far as one sees them.

    log_chance: of them all.
    """

    rule: str
    alternatives: tuple[int | None, ...]
    log_chance: float


@dataclass(frozen=True)
class State:
    """attributes: by name, with `SCALE`. choices: by the path of the shape in the tree."""

    attributes: Mapping[str, Value]
    choices: Mapping[Path, Taken]

    @property
    def scale(self) -> float:
        """Metres of the style in a metre of the document."""
        return float(self.attributes[SCALE])

    def log_prior(self, distributions: Mapping[str, Distribution]) -> float:
        """Of the attributes and of the choices (6.13), as a natural logarithm."""
        attributes = sum(d.log_density(self.attributes[name]) for name, d in distributions.items())
        return attributes + math.fsum(taken.log_chance for taken in self.choices.values())

    def cuts(self) -> list[Path]:
        """The shapes below which something is drawn by chance: where a tree may be cut."""
        return sorted({path[:end] for path in self.choices for end in range(len(path) + 1)})

    def without(self, cut: Path) -> State:
        """Without the choices of a shape and of those below it."""
        kept = {p: taken for p, taken in self.choices.items() if p[: len(cut)] != cut}
        return replace(self, choices=kept)

    def with_choice(self, path: Path, taken: Taken) -> State:
        """With another choice at a shape, and those below it to be drawn anew."""
        rest = self.without(path)
        return replace(rest, choices={**rest.choices, path: taken})

    def with_attributes(self, **values: Value) -> State:
        """With other attributes."""
        return replace(self, attributes={**self.attributes, **values})

    @property
    def key(self) -> tuple[object, ...]:
        """Equal where the structures are."""
        return (
            *sorted(self.attributes.items()),
            *sorted((path, taken.rule, taken.alternatives) for path, taken in self.choices.items()),
        )
