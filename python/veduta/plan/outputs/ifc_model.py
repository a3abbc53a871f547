"""What of an IFC file as it grows the parts of the writer use."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Entity = Any
"""ifcopenshell makes its classes when it runs."""


class Model(Protocol):
    """The file. body: the context of shapes in three dimensions. building: the house in it."""

    body: Entity
    building: Entity

    def make(self, kind: str, *values: Any, **named: Any) -> Entity:
        """An entity without an id of its own."""

    def rooted(self, kind: str, name: str, **named: Any) -> Entity:
        """An entity with a stable id."""

    def product(
        self, kind: str, name: str, within: Entity | None, up_m: float = 0.0, **named: Any
    ) -> Entity:
        """Something that stands somewhere."""

    def aggregate(self, whole: Entity, parts: Sequence[Entity], name: str) -> None:
        """Parts of a whole."""

    def contain(self, storey: Entity, elements: Sequence[Entity], name: str) -> None:
        """Elements of a storey."""

    def mesh(self, points: NDArray[np.float64], triangles: NDArray[np.int64]) -> Entity:
        """A shape of triangles."""
