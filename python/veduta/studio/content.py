"""The files that a browser needs: the built studio and a place."""

from __future__ import annotations

import shlex
from pathlib import Path

from veduta.run.errors import InputError
from veduta.run.names import real_path

STATIC = Path(__file__).parent / "static"
MANIFEST = "place.json"
SHOWN = 5
_ANY = "Give a folder that veduta wrote: what was given with -o to facade, plan, drive or another verb."
"""How many other folders a message names."""


def studio_folder(static: Path = STATIC) -> Path:
    """The built studio; raises InputError where it has not been built."""
    if not (static / "index.html").is_file():
        raise InputError(
            static,
            "the studio has not been built",
            "In a checkout run `make studio`, or install a released package, which contains it.",
        )
    return static


def place_folder(out: Path, verb: str = "view") -> Path:
    """The resolved folder of a place; raises InputError where there is no `place.json`.

    verb: the command that asks, for the hint at a folder that was perhaps meant.
    """
    if not out.is_dir():
        raise InputError(
            out,
            "there is no such folder",
            _ANY,
        )
    if not (out / MANIFEST).is_file():
        raise InputError(out / MANIFEST, "the folder holds no place", _remedy(out, verb))
    return real_path(out)


def _remedy(out: Path, verb: str) -> str:
    near = _places_near(out)
    if not near:
        return _ANY
    shown = ", ".join(shlex.quote(str(path)) for path in near[:SHOWN])
    more = f" and {len(near) - SHOWN} more" if len(near) > SHOWN else ""
    return f"Did you mean: veduta {verb} {shown}{more}"


def _places_near(out: Path) -> list[Path]:
    """Places one or two folders below, else the one that `out` is a part of."""
    found = [
        path.parent
        for depth in ("*", "*/*")
        for path in sorted(out.glob(f"{depth}/{MANIFEST}"))
        if not any(part.startswith(".") for part in path.relative_to(out).parts)
    ]
    above = out.parent if out.name else real_path(out).parent
    return found or ([above] if (above / MANIFEST).is_file() else [])
