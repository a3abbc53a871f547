"""What a call is asked to do: the files of a folder that may be photos, and nothing read yet."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from veduta.imaging.read import MAX_FILE_BYTES, SUFFIXES
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

MOST_PHOTOS = 20_000
_ADD = "Put at least two photos of the same place into it (JPEG, PNG, TIFF, WebP)."


@dataclass(frozen=True)
class Source:
    """A file that may be a photo; its name is what the results call it."""

    name: str
    path: Path
    sha256: str


@dataclass(frozen=True)
class Call:
    """The photos of a folder in the order of their names.

    copies: files with the content of an earlier one, as (name, name of the earlier one).
    unreadable: files that the system does not let us read, as (name, reason).
    """

    folder: Path
    sources: tuple[Source, ...]
    copies: tuple[tuple[str, str], ...]
    unreadable: tuple[tuple[str, str], ...]


def plan_call(folder: Path) -> Call:
    """The photos in a folder, not in folders below it; InputError where there are not two."""
    sources: list[Source] = []
    known: dict[str, str] = {}
    copies: list[tuple[str, str]] = []
    unreadable: list[tuple[str, str]] = []
    paths = _paths(folder)
    for path in paths:
        try:
            require_file(path, MAX_FILE_BYTES)
            digest = file_digest(path)
        except InputError as error:
            unreadable.append((path.name, error.fault))
            continue
        except OSError as error:
            unreadable.append((path.name, f"cannot be read ({error.strerror})"))
            continue
        first = known.setdefault(digest, path.name)
        if first != path.name:
            copies.append((path.name, first))
        else:
            sources.append(Source(path.name, path, digest))
    if len(sources) < 2:
        raise InputError(folder, _too_few(len(paths), len(sources)), _ADD)
    return Call(folder, tuple(sources), tuple(copies), tuple(unreadable))


def _paths(folder: Path) -> list[Path]:
    if not folder.exists():
        raise InputError(folder, "does not exist", "Name a folder of photos.")
    if not folder.is_dir():
        raise InputError(folder, "is a file, not a folder", "Name the folder that it lies in.")
    try:
        found = sorted(
            path
            for path in folder.iterdir()
            if path.suffix.lower() in SUFFIXES and not path.name.startswith(".")
        )
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(folder, fault, "Check its permissions.") from error
    if len(found) > MOST_PHOTOS:
        fault = f"holds {len(found)} photos, more than {MOST_PHOTOS}"
        raise InputError(folder, fault, "Divide them into several folders.")
    return found


def _too_few(files: int, usable: int) -> str:
    if not files:
        return "holds no photos"
    if usable == 0:
        return "holds no photo that can be read"
    return "holds one photo" if files == 1 else "holds one photo, if copies are counted once"
