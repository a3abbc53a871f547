"""Values that are made when they are wanted and kept while they fit, the last used longest."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Bounded(Generic[Key, Value]):
    """Values by key, of at most `most_bytes` together; the last one asked for is always kept."""

    def __init__(
        self, make: Callable[[Key], Value], size: Callable[[Value], int], most_bytes: int
    ) -> None:
        self._make, self._size, self._most = make, size, most_bytes
        self._held: OrderedDict[Key, Value] = OrderedDict()
        self._bytes = 0

    def __call__(self, key: Key) -> Value:
        """The value of a key: the one that is held, or made now."""
        if key in self._held:
            self._held.move_to_end(key)
            return self._held[key]
        value = self._make(key)
        self._held[key] = value
        self._bytes += self._size(value)
        while self._bytes > self._most and len(self._held) > 1:
            self._bytes -= self._size(self._held.popitem(last=False)[1])
        return value
