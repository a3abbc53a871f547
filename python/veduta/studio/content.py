"""The files that a browser needs: the built studio and a place."""

from __future__ import annotations

from pathlib import Path

from veduta.run.errors import InputError

STATIC = Path(__file__).parent / "static"
MANIFEST = "place.json"


def studio_folder(static: Path = STATIC) -> Path:
    """The built studio; raises InputError where it has not been built."""
    if not (static / "index.html").is_file():
        raise InputError(
            static,
            "the studio has not been built",
            "In a checkout run `make studio`, or install a released package, which contains it.",
        )
    return static


def place_folder(out: Path) -> Path:
    """The resolved folder of a place; raises InputError where there is no `place.json`."""
    if not out.is_dir():
        raise InputError(
            out,
            "there is no such folder",
            "Give the folder that `veduta facade -o OUT` wrote.",
        )
    if not (out / MANIFEST).is_file():
        raise InputError(
            out / MANIFEST,
            "the folder holds no place",
            "Give the folder that `veduta facade -o OUT` wrote; a single result has none.",
        )
    return out.resolve()
