"""Which object stands for a type: the same one throughout a house, unless it is asked otherwise.

AV3D, "Objects selection": one model per object type keeps the house small, and looks like a home.
Pictures are not chosen so: nobody hangs one picture in every room.
"""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from veduta.plan.furnish.catalogue.entry import Entry
from veduta.plan.furnish.catalogue.read import Catalogue

_FAMILY = "kitchen-"
"""Types that begin so have fronts of one kind: the end of the object's name."""

_IN_TURN = frozenset({"picture"})
"""Types whose objects take turns: each is tried on a wall before one comes again."""


@dataclass
class Choice:
    """The objects of a house. varied: another one each time."""

    catalogue: Catalogue
    seed: int
    varied: bool = False
    _chosen: dict[str, Entry] = field(default_factory=dict)
    _asked: int = 0
    _turn: dict[str, int] = field(default_factory=dict)

    def entry(self, kind: str) -> Entry:
        """The object of a type; KeyError where the catalogue has none of it."""
        if kind in self._chosen:
            return self._chosen[kind]
        entries = self.catalogue.of_type(kind)
        if not entries:
            raise KeyError(kind)
        if kind in _IN_TURN:
            return self._next(kind, entries)
        self._asked += 1
        word = _FAMILY if kind.startswith(_FAMILY) else kind
        again = self._asked if self.varied and word != _FAMILY else 0
        rng = np.random.default_rng([self.seed, zlib.crc32(word.encode()), again])
        chosen = entries[int(rng.integers(len(entries)))]
        if not self.varied or word == _FAMILY:
            self._chosen[kind] = chosen
        return chosen

    def _next(self, kind: str, entries: Sequence[Entry]) -> Entry:
        """The next of a type, in an order that hangs on the seed."""
        turn = self._turn.get(kind, 0)
        self._turn[kind] = turn + 1
        order = np.random.default_rng([self.seed, zlib.crc32(kind.encode())]).permutation(
            len(entries)
        )
        return entries[int(order[turn % len(entries)])]

    def knows(self, kind: str) -> bool:
        """Whether the catalogue has an object of a type."""
        return kind in self._chosen or bool(self.catalogue.of_type(kind))

    def smaller(self, kind: str) -> str | None:
        """What takes the place of a type for which there is no room."""
        return self.catalogue.smaller.get(kind)
