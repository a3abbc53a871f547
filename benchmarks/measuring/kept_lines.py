"""What was read of each picture, kept in a file: a long run that was broken off goes on."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

Read = TypeVar("Read")


def kept_of(
    names: Sequence[str], path: Path | None, most: int | None, read: Callable[[str], Read]
) -> dict[str, Read]:
    """What is read of each name, from the file where it has it; of others of no more than `most`.

    The file gets a line for each as it comes; without one nothing is kept.
    """
    known: dict[str, Read] = {}
    if path is not None and path.exists():
        known = dict(json.loads(line) for line in path.read_text("utf-8").splitlines())
    for name in [one for one in names if one not in known][:most]:
        known[name] = read(name)
        if path is not None:
            with path.open("a", encoding="utf-8") as file:
                file.write(json.dumps([name, known[name]]) + "\n")
    return {name: known[name] for name in names if name in known}
