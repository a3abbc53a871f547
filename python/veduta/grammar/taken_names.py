"""Names for files, each given once: for millions of lots in a few bytes each."""

from __future__ import annotations

import re
from array import array
from hashlib import blake2b

FIRST_SLOTS = 1 << 10


class TakenNames:
    """The names that are taken, on disks that do not tell case apart neither.

    Of a name 64 bits of its digest are kept. Where two names have the same ones, which among ten
    million lots happens in one of 400,000 calls, the later lot has a number behind its name that it
    would not need.
    """

    def __init__(self) -> None:
        self._slots = array("Q", bytes(8 * FIRST_SLOTS))
        self._count = 0
        self._next: dict[int, int] = {}

    def own(self, name: str) -> str:
        """The name as one for files, with a number where another lot has it."""
        slug = re.sub(r"[^A-Za-z0-9_-]+", "-", name)[:80].strip("-") or "lot"
        mark = _mark(slug)
        if self._take(mark):
            return slug
        number = self._next.get(mark, 2)
        while not self._take(_mark(unique := f"{slug}-{number}")):
            number += 1
        self._next[mark] = number + 1
        return unique

    def _take(self, mark: int) -> bool:
        """Whether the mark was free; it is taken then."""
        if not _put(self._slots, mark):
            return False
        self._count += 1
        if 2 * self._count > len(self._slots):
            larger = array("Q", bytes(16 * len(self._slots)))
            for known in self._slots:
                if known:
                    _put(larger, known)
            self._slots = larger
        return True


def _mark(name: str) -> int:
    digest = blake2b(name.lower().encode(), digest_size=8).digest()
    return int.from_bytes(digest, "little") or 1


def _put(slots: array[int], mark: int) -> bool:
    """Put a mark into the first free slot from its own on; False where it is there."""
    last = len(slots) - 1
    at = mark & last
    while known := slots[at]:
        if known == mark:
            return False
        at = (at + 1) & last
    slots[at] = mark
    return True
