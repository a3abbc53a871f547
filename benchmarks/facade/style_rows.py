"""Rows of a benchmark that goes on where it was stopped: one a line in a file."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from pathlib import Path

Row = dict[str, str | int | float | bool | None]


def rows_of(path: Path | None, keys: Iterable[str], make: Callable[[str], Row]) -> list[Row]:
    """A row for each key: from the file where it has one, else made and appended to it."""
    known: dict[str, Row] = {}
    if path is not None and path.exists():
        known = dict(json.loads(line) for line in path.read_text("utf-8").splitlines())
    found = []
    for key in keys:
        if key not in known:
            known[key] = make(key)
            print(known[key], flush=True)
            if path is not None:
                with path.open("a", encoding="utf-8") as file:
                    file.write(json.dumps([key, known[key]]) + "\n")
        found.append(known[key])
    return found
