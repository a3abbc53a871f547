"""Files whose names are not UTF-8, under names that are.

Linux takes any bytes as a name; documents, web pages and most libraries take only UTF-8. So what is
given is seen through a private folder of links, whose names write such a byte as `=E9`. These names
stand in reports, documents and results. A folder in which nothing is named so is one link, one with
such names in it is a folder of links to its files.
"""

from __future__ import annotations

import functools
import json
import os
import re
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

from veduta.run.errors import InputError

PRIVATE_NAMES = "VEDUTA_PLAIN_NAMES"
"""The variable by which processes of the same run find the folder of links."""
MOST_ENTRIES = 50_000
"""Of what is given as a folder so many entries are looked at: a home or a disk would take minutes.
A folder is looked at whole once it is begun, and folders by the order of their names.
"""
_TABLE = "table.json"
_NO_UTF8 = re.compile("[\udc80-\udcff]")
"""What stands for bytes that are no UTF-8, by `surrogateescape`."""


def is_plain(name: str) -> bool:
    """Whether a name or path is UTF-8."""
    return name.isascii() or _NO_UTF8.search(name) is None


def plain(name: str) -> str:
    """A name with `=E9` for each byte that is not UTF-8."""
    return _NO_UTF8.sub(lambda byte: f"={ord(byte[0]) - 0xDC00:02X}", name)


def printable(text: str) -> str:
    """A text with `\\xe9` for each byte that is not UTF-8."""
    return _NO_UTF8.sub(lambda byte: f"\\x{ord(byte[0]) - 0xDC00:02x}", text)


def shown(path: str) -> str:
    """A path as it can be printed, and typed into a shell."""
    if is_plain(path):
        return path
    return "$'" + printable(path.replace("\\", "\\\\").replace("'", "\\'")) + "'"


def real_path(path: Path) -> Path:
    """The path without links and `..`, by names that are UTF-8: that of a link of this module."""
    found = os.path.realpath(path)
    folder = os.environ.get(PRIVATE_NAMES)
    if folder is None:
        return Path(found)
    table = _table(folder)
    found = _instead(found, table.real)
    seen = _instead(found, table.links)
    return Path(seen if not is_plain(found) or os.path.lexists(seen) else found)


def given_name(path: str | Path) -> str:
    """A path for keys and reports: that of a link is told by what it stands for.

    Links lie elsewhere in each run; where the path is no link's, it is the path itself.
    """
    folder = os.environ.get(PRIVATE_NAMES)
    told = str(path)
    if folder is not None and told.startswith(folder + os.sep):
        return plain(_instead(told, _table(folder).real))
    return told


def given_names(text: str) -> str:
    """A text in which each path of a link is told by what the link stands for."""
    folder = os.environ.get(PRIVATE_NAMES)
    if folder is not None and folder in text:
        for link, real in sorted(_table(folder).real.items(), key=lambda row: -len(row[0])):
            text = text.replace(link, plain(real))
    return text


@dataclass
class Table:
    """real: what each link stands for. links: the first link of each real path."""

    real: dict[str, str] = field(default_factory=dict)
    links: dict[str, str] = field(default_factory=dict)


@functools.cache
def _table(folder: str) -> Table:
    try:
        return Table(**json.loads(Path(folder, _TABLE).read_text("ascii")))
    except OSError:  # of a run that has ended
        return Table()


def _instead(path: str, table: Mapping[str, str]) -> str:
    """The path with the nearest folder of it that is in a table replaced."""
    at, rest = path, ""
    while at not in table:
        if at == os.path.dirname(at):
            return path
        rest = os.path.join(os.path.basename(at), rest)
        at = os.path.dirname(at)
    return os.path.join(table[at], rest).rstrip(os.sep)


class PlainNames:
    """The links of one run; shown: how each is told, by its path."""

    def __init__(self) -> None:
        self.shown: dict[str, str] = {}
        self.table = Table()
        self._folder: str | None = None
        self._known: dict[str, str] = {}
        self._homes: dict[str, str] = {}
        """Folders of links in which a file may be written: where it belongs."""

    @property
    def folder(self) -> str:
        """The private folder; it is made when it is first asked for."""
        if self._folder is None:
            self._folder = os.path.realpath(tempfile.mkdtemp(prefix="veduta-names-"))
            os.environ[PRIVATE_NAMES] = self._folder
        return self._folder

    def reading(self, path: str, *, below: bool = True) -> str:
        """The name by which a file or folder that is there is read: its own where that is UTF-8.

        below: whether the files in a folder are read, too. Names that differ in such bytes alone
        stay apart.
        """
        if os.path.isdir(path):
            if below and _any_below(path):
                return self._mirrored(path)
            return path if is_plain(path) else self._link(path)
        if is_plain(path) or not os.path.isfile(path):
            return path
        folder, name = os.path.split(path)
        if is_plain(name):
            return os.path.join(self._link(folder), name)
        return self._beside(folder or os.curdir, name)

    def writing(self, path: str) -> str:
        """The name by which a folder is written that is there or not yet."""
        if is_plain(path):
            return path
        os.makedirs(os.path.dirname(path) or os.curdir, exist_ok=True)
        return self._link(path)

    def writing_file(self, path: str) -> str:
        """The name by which a file is written; `finish` brings it to where it belongs."""
        if is_plain(path) or os.path.lexists(path):
            return self.reading(path)
        folder, name = os.path.split(path)
        if is_plain(name):
            return os.path.join(self._link(folder), name)
        link = self._room(path)
        self._homes[os.path.dirname(link)] = folder or os.curdir
        return link

    def keep(self) -> None:
        """Write the table for `real_path`, of this process and of those that it starts."""
        if self._folder is not None:
            Path(self._folder, _TABLE).write_text(json.dumps(asdict(self.table)), "ascii")
            _table.cache_clear()

    def finish(self) -> None:
        """Bring the files that were written beside links to where they belong."""
        for folder, home in self._homes.items():
            for entry in os.scandir(folder):
                if not entry.is_symlink():
                    target = os.path.join(os.path.realpath(home), entry.name)
                    shutil.move(entry.path, self.table.real.get(entry.path, target))

    def end(self) -> None:
        """Take the links away."""
        if self._folder is not None:
            os.environ.pop(PRIVATE_NAMES, None)
            shutil.rmtree(self._folder, ignore_errors=True)

    def tell(self, text: str) -> str:
        """A text with the names that were given, instead of those of links."""
        if self._folder is not None and self._folder in text:
            for link in sorted(self.shown, key=len, reverse=True):
                text = text.replace(link, self.shown[link])
        return text

    def _mirrored(self, path: str) -> str:
        key = os.path.join(path, "**")
        if key not in self._known:
            link = self._room(path)
            self._known[key] = link
            _mirror(path, link, self)
        return self._known[key]

    def _link(self, path: str) -> str:
        if path not in self._known:
            link = self._room(path)
            os.symlink(os.path.abspath(path), link)
            self._known[path] = link
        return self._known[path]

    def _beside(self, folder: str, name: str) -> str:
        """A file of such a name, beside all that lies in its folder."""
        key = os.path.join(folder, "*")
        if key not in self._known:
            room = self._room(folder)
            self._known[key] = room
            self._homes[room] = folder
            os.mkdir(room)
            self.link_all(folder, room, os.listdir(folder))
        wanted = os.path.join(os.path.realpath(folder), name)
        return next(
            link
            for link, path in self.table.real.items()
            if path == wanted and link.startswith(self._known[key])
        )

    def _room(self, path: str) -> str:
        """Where a link to a path belongs, by its own name; noted in the tables."""
        number = os.path.join(self.folder, str(len(self.shown)))
        os.mkdir(number)
        link = os.path.join(number, plain(os.path.basename(os.path.abspath(path))) or "root")
        self.note(path, link)
        return link

    def note(self, path: str, link: str) -> None:
        """Have a link stand for a path."""
        folder, name = os.path.split(os.path.abspath(path))
        real = os.path.join(os.path.realpath(folder), name)  # a link in a folder stays one
        self.table.real[link] = real
        self.table.links.setdefault(os.path.realpath(path), link)
        self.shown[link] = shown(path)

    def link_all(self, folder: str, into: str, names: list[str]) -> None:
        """Links to the entries of a folder; plain names first, which stay as they are."""
        taken: set[str] = set()
        for name in sorted(names, key=lambda one: (not is_plain(one), os.fsencode(one))):
            path, free = os.path.join(folder, name), plain(name)
            while free in taken:
                free = f"={free}"
            taken.add(free)
            link = os.path.join(into, free)
            os.symlink(os.path.abspath(path), link)
            if not is_plain(name):
                self.note(path, link)


def _any_below(folder: str) -> bool:
    """Whether anything in a folder has a name that is no UTF-8; of the first `MOST_ENTRIES`.

    It goes down by the order of names, so that what is found is not left to the order on disk;
    what lies beyond so many entries is not seen, and keeps its name.
    """
    seen = 0
    for _, folders, files in os.walk(folder):
        seen += len(folders) + len(files)
        if not is_plain("".join((*folders, *files))):
            return True
        if seen > MOST_ENTRIES:
            return False
        folders.sort(key=os.fsencode)
    return False


def _mirror(folder: str, link: str, names: PlainNames) -> None:
    """Folders like those below a folder, of links to its files."""
    os.mkdir(link)
    into = {folder: link}
    seen = 0
    for where, folders, files in os.walk(folder):
        seen += len(folders) + len(files)
        if seen > MOST_ENTRIES:
            fault = f"has more than {MOST_ENTRIES} files, and names that are not UTF-8 among them"
            raise InputError(shown(folder), fault, "Rename those.")
        linked = [name for name in folders if os.path.islink(os.path.join(where, name))]
        names.link_all(where, into[where], [*files, *linked])
        for name in sorted(set(folders) - set(linked)):
            inner, path = os.path.join(into[where], plain(name)), os.path.join(where, name)
            while os.path.lexists(inner):
                inner = os.path.join(into[where], f"={os.path.basename(inner)}")
            os.mkdir(inner)
            into[path] = inner
            if not is_plain(name):
                names.note(path, inner)
