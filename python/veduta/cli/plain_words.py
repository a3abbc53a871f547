"""Words of a command line that name files, where the names are not UTF-8."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TextIO, cast

from veduta.run.names import PlainNames, is_plain

_FOLDERS = {"-o", "--out", "--folder", "--web"}
"""Options that name a folder for results."""
_FILES = {"--print-board"}
_MADE_FILES = {("grammar", "sample"), ("grammar", "tree")}
"""Actions whose `-o` names a file."""
_NO_PATHS = {
    "--address", "--at", "--author", "--colours", "--crs", "--description",
    "--detail", "--device", "--doors", "--epipolar", "--eyes", "--georef", "--ground",
    "--height-attribute", "--host", "--houses", "--individual", "--kind", "--layer", "--lens",
    "--licence", "--lights", "--lot", "--mapping", "--method", "--model-up", "--pages",
    "--pairs", "--perspective", "--roof", "--solver", "--start", "--style", "--surroundings",
    "--time", "--title", "--to", "--up", "--view", "--weather",
}  # fmt: skip
"""Options whose values are words, whatever lies in the working folder under such a name."""
_WITH_ACTIONS = {"grammar"}
"""Verbs whose first word says what they do."""
_OWN_PLACES = {"view", "export"}
"""What these read was written by Veduta: nothing in it has such a name."""


class _Telling:
    """A stream on which links are told by the names that were given."""

    def __init__(self, stream: TextIO, names: PlainNames) -> None:
        self._stream, self._names = stream, names

    def write(self, text: str) -> int:
        """Write a text."""
        self._stream.write(self._names.tell(text))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def plain_words(verb: str, words: Sequence[str]) -> Iterator[list[str]]:
    """The words with names that are UTF-8; what is told meanwhile names what was given."""
    names = PlainNames()
    streams = sys.stdout, sys.stderr
    try:
        if not is_plain(here := _here()):
            names.reading(here, below=False)
        given = [_word(verb, words, at, names) for at in range(len(words))]
        names.keep()
        if names.shown:
            sys.stdout, sys.stderr = (_telling(stream, names) for stream in streams)
        yield given
        names.finish()
    finally:
        sys.stdout, sys.stderr = streams
        names.end()


def _here() -> str:
    """The working folder; nothing where it was removed: absolute paths need none."""
    try:
        return os.getcwd()
    except FileNotFoundError:
        return ""


def _telling(stream: TextIO, names: PlainNames) -> TextIO:
    return stream if stream is None else cast("TextIO", _Telling(stream, names))


def _word(verb: str, words: Sequence[str], at: int, names: PlainNames) -> str:
    """One word; of `--option=PATH` and `ROOM=FILE` what is behind the sign."""
    word = words[at]
    if at == 0 and verb in _WITH_ACTIONS:
        return word
    before = words[at - 1] if at else ""
    head, sign, tail = word.partition("=")
    if word.startswith("-"):
        return f"{head}={_name(verb, words, head, tail, names)}" if sign else word
    if sign and not os.path.lexists(word) and os.path.lexists(tail):
        return f"{head}={_name(verb, words, '', tail, names)}"
    return _name(verb, words, before if before.startswith("-") else "", word, names)


def _name(verb: str, words: Sequence[str], option: str, name: str, names: PlainNames) -> str:
    if not name or "\0" in name or option in _NO_PATHS:
        return name
    made_file = (verb, words[0]) in _MADE_FILES
    if option in _FILES or (option in _FOLDERS and made_file):
        return names.writing_file(name)
    if option in _FOLDERS:
        return names.writing(name)
    if verb == "export" and option in ("", "--force") and not os.path.isdir(name):
        return names.writing_file(name)
    return names.reading(name, below=verb not in _OWN_PLACES)
