"""The features of a GeoJSON file that is too large to be read at once, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from veduta.grammar.json_stream import JsonStream


class FeatureStream:
    """A FeatureCollection on its way; `members` are those that have come so far, but features."""

    def __init__(self, path: Path) -> None:
        self.members: dict[str, Any] = {}
        self._stream = JsonStream(path, "GeoJSON")

    def features(self) -> Iterator[Any]:
        """The features in their order, `Broken` for those that are no JSON.

        InputError where the file is no FeatureCollection.
        """
        has_features = False
        for name in self._stream.names():
            if name == "features":
                has_features = True
                yield from self._stream.values()
            else:
                self.members[name] = self._stream.value()
        if not has_features or self.members.get("type") != "FeatureCollection":
            raise self._stream.fault("only a FeatureCollection may be so large")
