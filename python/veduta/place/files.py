"""The files that a place names, besides its models and clouds, and where they are."""

from __future__ import annotations

import filecmp
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import NamedTuple, Protocol, TypeVar

from veduta.place.manifest import PlaceCamera, Walk, WalkKey, WalkTransition
from veduta.run.errors import InputError
from veduta.run.names import real_path

Item = TypeVar("Item", PlaceCamera, WalkKey, WalkTransition, Walk)
_NAMES = ("picture", "document", "forth", "back")


class Source(NamedTuple):
    """A file of a place: the place's folder, and its name below that."""

    folder: Path
    name: str


class _Documented(Protocol):
    """A part, as the manifest or as a place in memory has it."""

    @property
    def document(self) -> str | None: ...
    @property
    def photo(self) -> str | None: ...
    @property
    def city_model(self) -> str | None: ...
    @property
    def raw(self) -> str | None: ...


def drawn_files(walks: Iterable[Walk]) -> list[str]:
    """What walks cannot be shown without: their pictures and their models."""
    names = []
    for walk in walks:
        names += [key.picture for key in walk.keys]
        names += [name for way in walk.transitions for name in (way.forth, way.back) if name]
    return names


def files_beside(
    parts: Iterable[_Documented], cameras: Iterable[PlaceCamera], walks: Iterable[Walk]
) -> list[str]:
    """Pictures of cameras, and what parts and walks were made from."""
    names = [camera.picture for camera in cameras]
    for part in parts:
        files = (part.photo, part.city_model, part.document, part.raw)
        names += [name for name in files if name]
    return names + [walk.document for walk in walks if walk.document]


def renamed(item: Item, name: Callable[[str], str]) -> Item:
    """The item with other names for its files."""
    update: dict[str, object] = {}
    for field in _NAMES:
        path = getattr(item, field, None)
        if path is not None:
            update[field] = name(path)
    if isinstance(item, Walk):
        update["keys"] = [renamed(key, name) for key in item.keys]
        update["transitions"] = [renamed(way, name) for way in item.transitions]
    return item.model_copy(update=update)


def names_apart(
    first: Mapping[str, Source | None], second: Mapping[str, Source | None]
) -> dict[str, str]:
    """New names for the second place's files whose names the first has for others.

    None for a source: the file lies where the place will be saved.
    """
    taken = {name.casefold(): source for name, source in first.items()}
    others = {name.casefold() for name in second}
    found: dict[str, str] = {}
    for name, source in second.items():
        if name.casefold() not in taken or _one_file(taken[name.casefold()], source):
            continue
        number = 2
        while f"{number}/{name}".casefold() in taken.keys() | others:
            number += 1
        found[name] = f"{number}/{name}"
    return found


def _one_file(one: Source | None, two: Source | None) -> bool:
    if one is None or two is None or one == two:
        return one == two
    first, second = one.folder / one.name, two.folder / two.name
    if not first.is_file() or not second.is_file():
        return False
    return first.samefile(second) or filecmp.cmp(first, second, shallow=False)


def copies(sources: Mapping[str, Source], target: Path) -> list[tuple[Path, Path]]:
    """Which file is to be copied where, in this order, so that all lie in the target folder.

    InputError naming files that are not there, and one that a link brings from elsewhere.
    """
    missing = []
    planned: list[tuple[Path, Path]] = []
    home = real_path(target)
    for name, (folder, own) in sorted(sources.items()):
        path = real_path(folder / own)
        if not path.is_relative_to(real_path(folder)):
            fault = "is a link to a file outside of the place's folder"
            raise InputError(folder / own, fault, "Put the file itself there.")
        if path.is_file():
            if path != real_path(target / name):
                planned.append((path, target / name))
        elif not (target / name).is_file():
            missing.append(own)
    if missing:
        told = ", ".join(missing[:5]) + (f" and {len(missing) - 5} more" if missing[5:] else "")
        fault = f"names files that are not there ({told})"
        raise InputError(next(iter(sources.values())).folder, fault, "Write that place again.")
    # What lies in the target may be overwritten by what comes from elsewhere: it moves first.
    return sorted(planned, key=lambda pair: not pair[0].is_relative_to(home))
