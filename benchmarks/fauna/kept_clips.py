"""Rows of clips that are done, kept in a file: a long run that was broken off goes on."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from functools import partial
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


def rows_of_clips(
    description: str | None, clips: int, odd: str, measured: Callable[[int], list[Row]]
) -> tuple[list[Row], bool]:
    """The rows of as many clips as the command line says, and whether the table is to be kept.

    clips: without a word of it. odd: which of them are.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--clips", type=int, default=clips, help=f"{odd} is odd")
    parser.add_argument("--kept", type=Path, help="where clips that are done are kept")
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    kept = KeptClips(given.kept)
    each = (kept.rows(str(clip), partial(measured, clip)) for clip in range(given.clips))
    return [row for rows in each for row in rows], not given.no_keep
