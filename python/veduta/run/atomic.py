"""Files and folders that appear whole or not at all.

A result is written under a temporary name on the same file system, forced to disk, and
renamed. Whoever reads the final name sees the old state or the new one, never a part of it.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Give a temporary file beside `path`; rename it to `path` when the block succeeds."""
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".tmp", dir=path.parent)
    os.close(descriptor)
    temporary = Path(name)
    try:
        yield temporary
        _open_to_others(temporary, 0o666)
        sync_file(temporary)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
    sync_folder(path.parent)


@contextmanager
def atomic_folder(path: Path) -> Iterator[Path]:
    """Give a temporary folder beside `path`; rename it to `path` when the block succeeds.

    `path` must not exist (an empty folder is replaced): what a person may have changed in an
    existing one is decided file by file in `run.outputs`.
    """
    temporary = Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".tmp", dir=path.parent))
    try:
        yield temporary
        _open_to_others(temporary, 0o777)
        sync_tree(temporary)
        os.replace(temporary, path)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    sync_folder(path.parent)


def remove_folder(path: Path) -> None:
    """Take a folder away whole: who is killed meanwhile leaves it, or a half for `drop_halves`."""
    if not path.exists():
        return
    temporary = Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".tmp", dir=path.parent))
    try:
        os.replace(path, temporary)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def drop_halves(folder: Path) -> None:
    """Take away what writers that were killed have left under temporary names below `folder`.

    Nobody may be writing there meanwhile.
    """
    for left in list(folder.rglob(".*.tmp")):
        if left.is_dir():
            shutil.rmtree(left, ignore_errors=True)
        else:
            left.unlink(missing_ok=True)


def write_bytes(path: Path, content: bytes) -> None:
    """Write a small file whole or not at all."""
    with atomic_write(path) as temporary:
        temporary.write_bytes(content)


def same_file(known: Path, path: Path) -> None:
    """Have a file at `path`, too: the same one where the file system can, or else a copy."""
    try:
        os.link(known, path)
    except OSError:
        shutil.copyfile(known, path)


def sync_tree(folder: Path) -> None:
    """Force all files below `folder`, and the folders' entries, to disk."""
    for parent, _, files in os.walk(folder):
        for name in files:
            sync_file(Path(parent) / name)
        sync_folder(Path(parent))


def sync_file(path: Path) -> None:
    """Force one file's content to disk."""
    with path.open("rb") as handle:
        os.fsync(handle.fileno())


def sync_folder(path: Path) -> None:
    """Force a folder's entries (new names, renames) to disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _open_to_others(path: Path, mode: int) -> None:
    """Give the rights that an ordinary new file or folder has; `tempfile` makes private ones."""
    mask = os.umask(0)
    os.umask(mask)
    path.chmod(mode & ~mask)
