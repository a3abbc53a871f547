"""Rows of clips that are done, kept in a file: a long run that was broken off goes on."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from record import Value

Row = dict[str, Value]


class KeptClips:
    """Rows by the names of their clips; without a file nothing is kept."""

    def __init__(self, file: Path | None) -> None:
        self._file = file
        self._rows: dict[str, list[Row]] = {}
        if file is not None and file.exists():
            self._rows = json.loads(file.read_text())

    def rows(self, name: str, make: Callable[[], list[Row]]) -> list[Row]:
        """The rows of a clip, made where they are not there yet."""
        if name not in self._rows:
            self._rows[name] = make()
            if self._file is not None:
                self._file.write_text(json.dumps(self._rows, indent=1) + "\n")
        return self._rows[name]
