"""Which files a place consists of."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from veduta.formats.place_json import read_place
from veduta.run.errors import InputError
from veduta.studio.content import MANIFEST


def part_files(folder: Path) -> dict[str, Path]:
    """The files that `place.json` names: path in the place and where each is.

    Without its model a part cannot be seen, so that must be there; the others may be missing
    from a place that was made by hand. `folder` is resolved.
    """
    files: dict[str, Path] = {}
    for part in read_place(folder / MANIFEST).parts:
        for name in (part.model, part.photo, part.city_model, part.document):
            if name is None:
                continue
            path = _inside(folder, name)
            if path.is_file():
                files[PurePosixPath(name).as_posix()] = path
            elif name == part.model:
                raise InputError(
                    path, "the file is not there", "Write the place again, then export it."
                )
    return files


def _inside(folder: Path, name: str) -> Path:
    """The manifest's own check keeps `..` out; a link could still lead elsewhere."""
    path = (folder / name).resolve()
    if not path.is_relative_to(folder):
        raise InputError(
            folder / name,
            "it is a link to a file outside of the place's folder",
            "Put the file itself there if it is meant to be published.",
        )
    return path
