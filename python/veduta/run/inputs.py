"""What may be read at all: ordinary files of a bounded size."""

from __future__ import annotations

import stat
from pathlib import Path

from veduta.run.errors import InputError

_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


def require_file(path: Path, max_bytes: int | None = None) -> None:
    """Refuse what is not a file, or a larger one than `max_bytes`, before it is opened.

    Links are followed. A pipe would be waited for, and a device read without end. InputError says
    so; OSError (it does not exist, may not be seen) is left to the caller, who knows what it is.
    """
    status = path.stat()
    if not stat.S_ISREG(status.st_mode):
        kind = _KINDS.get(stat.S_IFMT(status.st_mode), "something else")
        folder = stat.S_ISDIR(status.st_mode)
        remedy = "Name the file in it." if folder else "Save it as a file, and name that."
        raise InputError(path, f"is {kind}, not a file", remedy)
    if max_bytes is not None and status.st_size > max_bytes:
        sizes = f"{_size(status.st_size)} large, more than {_size(max_bytes)}"
        raise InputError(path, f"is {sizes}", "Check that it is the right file.")


def _size(count: int) -> str:
    return f"{count / 1e9:.4g} GB" if count >= 1e9 else f"{count / 1e6:.4g} MB"
