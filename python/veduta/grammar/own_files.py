"""Files that several imported rule files have by the same name: each file means the one beside it.

Rule files of facades name their pictures alike (`pictures/facade.jpg`). What lies beside the file
that names it comes first; names are searched from the main file, so that an imported file's name is
written as the way from there wherever the search would find another file. What lies beside files
that it does not import is never its own.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Mapping
from pathlib import Path

from veduta.grammar.project import SearchPath, with_folders
from veduta.run.names import real_path

_STRINGS = re.compile(
    r'//[^\n]*|#[^\n]*|/\*.*?\*/|"(?P<name>[^"\n\0]{1,400}\.[A-Za-z0-9]{2,5})"|"[^"\n]*"',
    re.DOTALL,
)
"""Comments, strings that may be names of files, and other strings."""


def with_own_files(
    main: Path, files: dict[str, str], search: SearchPath, imports: Mapping[str, Collection[str]]
) -> tuple[tuple[str, str], ...]:
    """The files by name and text, in which each name of a file leads to the one beside it.

    main: the rule file that the others are imported to. search: where names are looked for, without
    the folders of the files. imports: which files each of the files imports.
    """
    first = main.parent
    every = with_folders(search, files)

    def text_of(name: str, text: str) -> str:
        if Path(name).parent == first:
            return text
        return _own(Path(name).parent, first, text, every, _seen_by(name, search, imports))

    return tuple((name, text_of(name, text)) for name, text in files.items())


def _seen_by(name: str, search: SearchPath, imports: Mapping[str, Collection[str]]) -> SearchPath:
    """Where what an imported file names may lie: not beside files that it does not import."""
    reached: list[str] = []
    waiting = [name]
    while waiting:
        at = waiting.pop()
        if at not in reached:
            reached.append(at)
            waiting += imports.get(at, ())
    return with_folders(search, reached)


def _own(folder: Path, first: Path, text: str, every: SearchPath, seen: SearchPath) -> str:
    """The text with the names of what lies beside it, and of what only other files may show.

    every: where names are looked for from the main file on. seen: where the text may look.
    """

    def led(match: re.Match[str]) -> str:
        written = match["name"]
        if not written or written.startswith(("/", "\\")):
            return match[0]
        own = folder / written.replace("\\", "/")
        found = every.find(written)
        if every.holds(own):
            if found is not None and real_path(found) == real_path(own):
                return match[0]
        elif found is None or seen.find(written) is not None:
            return match[0]
        # Where there is none, the name of its own place is one that is missing.
        return f'"{Path(os.path.relpath(own, first)).as_posix()}"'

    return _STRINGS.sub(led, text)
