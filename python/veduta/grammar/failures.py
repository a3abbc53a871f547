"""What gave no result, counted: the first ones are named, however many there are."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from typing import Any

from veduta.run.report import Failure

MOST_NAMED = 1000
"""Failures of one kind that are kept."""


class Failures:
    """The first failures, which are those it iterates over, and how many there are in all."""

    def __init__(self, found: Iterable[Failure] = ()) -> None:
        self.named: list[Failure] = []
        self.count = 0
        self._of_kind: dict[str, int] = {}
        self._rest = b""
        for failure in found:
            self.add(failure)

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[Failure]:
        return iter(self.named)

    @property
    def kinds(self) -> set[str]:
        """The kinds of all of them."""
        return set(self._of_kind)

    @property
    def untold(self) -> int:
        """How many are counted, but not named."""
        return self.count - len(self.named)

    def add(self, failure: Failure) -> None:
        """Count one; it is named where it is one of the first of its kind."""
        self.count += 1
        number = self._of_kind[failure.kind] = self._of_kind.get(failure.kind, 0) + 1
        if number <= MOST_NAMED:
            self.named.append(failure)
        else:
            told = repr((failure.subject, failure.reason)).encode()
            self._rest = hashlib.sha256(self._rest + told).digest()

    def add_all(self, named: Iterable[Failure], untold: int) -> None:
        """Count those that were named elsewhere, and inputs that were only counted there."""
        for failure in named:
            self.add(failure)
        self.count += untold
        if untold:
            self._of_kind["input"] = self._of_kind.get("input", 0) + untold

    def told(self) -> list[Any]:
        """What a key depends on: all that is named, and a digest of the rest."""
        found: list[Any] = [failure.model_dump() for failure in self.named]
        return [*found, [self.untold, self._rest.hex()]] if self.untold else found
