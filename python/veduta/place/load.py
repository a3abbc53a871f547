"""`veduta.load`: a place from a folder that a verb wrote, or from a file of another program."""

from __future__ import annotations

from pathlib import Path

from veduta.place.place import Place


def load(path: str | Path) -> Place:
    """The place in a folder with a `place.json`, or in a file of a format that is read.

    InputError where there is none, or it is broken.
    """
    return Place.load(path)
