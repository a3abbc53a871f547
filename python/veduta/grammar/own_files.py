"""Files that several imported rule files have by the same name: each file means the one beside it.

Rule files of facades name their pictures alike (`pictures/facade.jpg`). What lies beside the file
that names it comes first; names are searched from the main file, so that an imported file's name is
written as the way from there wherever the search would find another file.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

from veduta.grammar.project import SearchPath
from veduta.run.names import real_path

_STRINGS = re.compile(
    r'//[^\n]*|#[^\n]*|/\*.*?\*/|"(?P<name>[^"\n\0]{1,400}\.[A-Za-z0-9]{2,5})"|"[^"\n]*"',
    re.DOTALL,
)
"""Comments, strings that may be names of files, and other strings."""


def with_own_files(
    main: Path, files: dict[str, str], search: SearchPath
) -> tuple[tuple[str, str], ...]:
    """The files by name and text, in which each name of a file leads to the one beside it.

    main: the rule file that the others are imported to. search: where names are looked for.
    """
    first = main.parent
    return tuple(
        (name, text if Path(name).parent == first else _own(Path(name).parent, first, text, search))
        for name, text in files.items()
    )


def _own(folder: Path, first: Path, text: str, search: SearchPath) -> str:
    """The text with the names of what lies beside it but is not what the search finds."""

    def led(match: re.Match[str]) -> str:
        written = match["name"]
        if not written or written.startswith(("/", "\\")):
            return match[0]
        own = folder / written.replace("\\", "/")
        if not search.holds(own):
            return match[0]
        found = search.find(written)
        if found is not None and real_path(found) == real_path(own):
            return match[0]
        return f'"{Path(os.path.relpath(own, first)).as_posix()}"'

    return _STRINGS.sub(led, text)
