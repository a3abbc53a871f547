"""How a place reaches the formats: tables that `veduta.formats` fills.

Formats are built on places and import them, so a place cannot import formats. It asks for the
table by name when something is read or written, and the table registers itself here.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from veduta.run.errors import InputError

if TYPE_CHECKING:
    from veduta.place.manifest import PlacePart
    from veduta.place.mesh import Mesh
    from veduta.place.part import Part
    from veduta.place.place import Place, PlacedPart

_TABLE = "veduta.formats.table"


@dataclass(frozen=True)
class PlaceFormat:
    """A format for whole places.

    suffix: with its dot, in lower case. name: what `veduta export --to` calls it. title: what it
    is. left_out: what of a place it has no word for, in the words of `place.holding`. points_alone:
    whether the points of a place without parts are written all the same. read: None where files are
    only written.
    """

    suffix: str
    name: str
    write: Callable[[Place, Path], None]
    title: str = ""
    left_out: tuple[str, ...] = ()
    read: Callable[[Path], Place] | None = None
    points_alone: bool = False


@dataclass(frozen=True)
class PlaceFolders:
    """Places as folders with a `place.json`, and the models in them."""

    save: Callable[[Place, Path], None]
    save_part: Callable[[PlacedPart, Path], PlacePart]
    load: Callable[[Path], Place]
    read_model: Callable[[Path], Part | Mesh]
    untiled: Callable[[Place], Place]


_formats: dict[str, PlaceFormat] = {}
_readers: dict[str, Callable[[Path], Place]] = {}
_folders: list[PlaceFolders] = []


def register_format(added: PlaceFormat) -> None:
    """Offer a format for places under its suffix."""
    _formats[added.suffix] = added


def register_reader(suffix: str, read: Callable[[Path], Place]) -> None:
    """Offer a format that places are read from and not written in."""
    _readers[suffix] = read


def register_folders(added: PlaceFolders) -> None:
    """Say how places lie in folders."""
    _folders[:] = [added]


def formats() -> dict[str, PlaceFormat]:
    """All formats that places can be written in, by suffix."""
    importlib.import_module(_TABLE)
    return dict(sorted(_formats.items()))


def format_of(path: Path) -> PlaceFormat:
    """The format that a file's name asks for; the longest suffix counts (`.city.json`).

    InputError where there is none.
    """
    known = formats()
    suffix = _longest(path, known)
    if suffix is None:
        raise InputError(
            path,
            "has no ending of a format that places can be written in",
            f"Name it with one of: {', '.join(known)}",
        )
    return known[suffix]


def _longest(path: Path, suffixes: Iterable[str]) -> str | None:
    """Of those that a file's name ends in the longest; None without."""
    return max((one for one in suffixes if path.name.lower().endswith(one)), key=len, default=None)


def reader_of(path: Path) -> Callable[[Path], Place]:
    """What reads a file of this name; InputError where nothing does."""
    formats()
    suffix = _longest(path, _readers)
    if suffix is not None:
        return _readers[suffix]
    found = format_of(path)
    if found.read is None:
        fault = f"is a file that Veduta writes and does not read ({found.title})"
        raise InputError(path, fault, "Name the folder with the place.json.")
    return found.read


def is_readable(path: Path) -> bool:
    """Whether a file of this name would be read."""
    known = [suffix for suffix, one in formats().items() if one.read is not None]
    return _longest(path, [*known, *_readers]) is not None


def format_named(name: str) -> PlaceFormat:
    """The format of a name such as `obj`; InputError where there is none."""
    known = {one.name: one for one in formats().values()}
    if name not in known:
        raise InputError(
            name, "is no format that places are written in", f"Use {', '.join(known)}."
        )
    return known[name]


def folders() -> PlaceFolders:
    """How places lie in folders."""
    importlib.import_module(_TABLE)
    return _folders[0]
