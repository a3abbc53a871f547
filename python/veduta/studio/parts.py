"""Which files a place consists of."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from veduta.formats.place_json import read_place
from veduta.formats.tiles import contents
from veduta.place.files import drawn_files, files_beside
from veduta.run.errors import InputError
from veduta.run.names import real_path
from veduta.studio.content import MANIFEST


def part_files(folder: Path) -> dict[str, Path]:
    """The files that `place.json` names: path in the place and where each is.

    Without its model a part cannot be seen, so that must be there, and so must a cloud's points;
    the others may be missing from a place that was made by hand. `folder` is resolved.
    """
    files: dict[str, Path] = {}
    place = read_place(folder / MANIFEST)
    if place.tileset is not None:
        files = {name: _inside(folder, name) for name in _tiles(folder, place.tileset)}
    needed = [part.model for part in place.parts] + [cloud.file for cloud in place.points]
    needed += drawn_files(place.walks)
    beside = files_beside(place.parts, place.cameras, place.walks)
    must = set(needed)
    for name in needed + beside:
        path = _inside(folder, name)
        if path.is_file():
            files[PurePosixPath(name).as_posix()] = path
        elif name in must:
            raise InputError(
                path, "the file is not there", "Write the place again, then export it."
            )
    return files


def _tiles(folder: Path, tileset: str) -> list[str]:
    """The files of the tileset; InputError where it is not whole."""
    try:
        return contents(folder, tileset)
    except (OSError, ValueError, KeyError, TypeError, IndexError, RecursionError) as error:
        raise InputError(
            folder / tileset,
            f"is no tileset that can be read ({error})",
            "Write the place again, then export it.",
        ) from error


def _inside(folder: Path, name: str) -> Path:
    """The manifest's own check keeps `..` out; a link could still lead elsewhere.

    What begins with a dot is Veduta's own (`.veduta`) or hidden by its owner: it is not published.
    """
    if any(word.startswith(".") for word in PurePosixPath(name).parts):
        raise InputError(
            folder / name,
            "is hidden (its name begins with a dot), and what is hidden is not published",
            "Give it another name, and write that into place.json.",
        )
    path = real_path(folder / name)
    if not path.is_relative_to(folder):
        raise InputError(
            folder / name,
            "it is a link to a file outside of the place's folder",
            "Put the file itself there if it is meant to be published.",
        )
    if any(word.startswith(".") for word in path.relative_to(folder).parts):
        raise InputError(
            folder / name,
            "is a link to what is hidden",
            "Put the file itself there if it is meant to be published.",
        )
    return path
