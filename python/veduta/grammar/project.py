"""Where rule files look for what they name: a project's folders, in the order of Esri's search.

A file that a rule file names is looked for beside the rule file, beside the files that it imports,
in `assets` of the project, in its `rules`, in the project itself, and in libraries that the call
names; nowhere else, and never through a link that leads out of them. A project is the folder that
has the rule file below its `rules`, beside `assets`, `models` or a project file. Without one the
folder `rules` above the file is all that there is of it.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from veduta.run.errors import InputError
from veduta.run.names import real_path

RULES = "rules"
SIGNS = ("assets", "models", "maps", "scenes", "data", "images", ".project", ".cityengine")
"""Any of these beside `rules` makes a folder a project."""
HIGHEST = 6
"""Folders above a rule file that are looked at."""


@dataclass(frozen=True)
class SearchPath:
    """Folders in which names are looked for, the first first, and those that nothing may leave."""

    folders: tuple[Path, ...]
    within: tuple[str, ...] = field(default=())
    """Real paths; those of `folders` where none are given."""

    @staticmethod
    def of(folder: Path) -> SearchPath:
        """A folder alone."""
        return SearchPath((folder,), (str(real_path(folder)),))

    def find(self, name: str) -> Path | None:
        """The file of this name; None where there is none in the folders."""
        for path in self.candidates(name):
            if self.holds(path):
                return path
        return None

    def candidates(self, name: str) -> list[Path]:
        """Where it may be. A name that begins with a slash is one of the workspace: its first part
        is the project's or a library's own name.
        """
        plain = name.replace("\\", "/")
        if plain.startswith("/"):
            first, _, rest = plain.lstrip("/").partition("/")
            named = [folder for folder in self.folders if folder.name == first]
            if not rest:
                return []
            found = [folder / rest for folder in (*named, *self.folders)]
            return found + self._below_rules(rest)
        return [folder / plain for folder in self.folders] + self._below_rules(plain)

    def _below_rules(self, name: str) -> list[Path]:
        """Where `rules/NAME` may be if the project is not one of the folders, but its rules are."""
        first, _, rest = name.partition("/")
        return [folder / rest for folder in self.folders if first == RULES == folder.name]

    def holds(self, path: Path) -> bool:
        """Whether a file is there, and lies in the folders that nothing may leave."""
        real = str(real_path(path))
        return os.path.isfile(real) and any(
            os.path.commonpath([root, real]) == root for root in self.within
        )


def find_project(rules: Path) -> Path | None:
    """The project that a rule file belongs to; None where it belongs to none."""
    for folder in _rules_above(rules):
        if any((folder.parent / sign).exists() for sign in SIGNS):
            return folder.parent
    return None


def _rules_above(rules: Path) -> list[Path]:
    """The folders `rules` that a rule file lies in or below, the nearest first."""
    above = Path(os.path.abspath(rules)).parents
    return [folder for folder in above[:HIGHEST] if folder.name == RULES]


def search_path(
    rules: Path, project: Path | None = None, libraries: Iterable[Path] = ()
) -> SearchPath:
    """Where a rule file looks; InputError where the project or a library is no folder.

    project: None finds it by itself.
    """
    own = rules.parent
    found = find_project(rules) if project is None else project
    folders, roots = [own], [own]
    if found is None:
        folders += _rules_above(rules)[:1]
        roots += folders[1:]
    else:
        _require_folder("--project", found)
        folders += [found / "assets", found / RULES, found]
        roots.append(found)
    for library in libraries:
        _require_folder("--library", library)
        folders.append(library)
        roots.append(library)
    within = tuple(dict.fromkeys(str(real_path(root)) for root in roots))
    return SearchPath(tuple(dict.fromkeys(folders)), within)


def with_folders(search: SearchPath, files: Iterable[str]) -> SearchPath:
    """The same with the folders of files, which come after the first: those of what is imported."""
    beside = [Path(name).parent for name in files]
    first, *others = search.folders
    return SearchPath(tuple(dict.fromkeys([first, *beside, *others])), search.within)


def _require_folder(option: str, folder: Path) -> None:
    if not folder.is_dir():
        raise InputError(f"{option} {folder}", "is no folder", "Name the folder of the project.")
