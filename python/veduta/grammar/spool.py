"""Records in a file that nobody else sees: as many as the disk has room for, read in any order."""

from __future__ import annotations

import marshal
import tempfile
from array import array
from collections.abc import Iterator
from pathlib import Path
from typing import Any

IN_MEMORY = 32 * 2**20
"""Bytes that are kept in memory; with more, all goes to the disk."""
Record = tuple[Any, ...]
"""Texts, numbers, bytes, and tuples and dictionaries of them."""


class Spool:
    """Records in their order, by their row; the file has no name and goes with the process.

    folder: where it lies when it is large; where temporary files do if it is None.
    """

    def __init__(self, folder: Path | None = None) -> None:
        place = None if folder is None else str(folder)
        self._file = tempfile.SpooledTemporaryFile(IN_MEMORY, dir=place)  # noqa: SIM115  see close
        self._ends = array("q", [0])

    def __len__(self) -> int:
        return len(self._ends) - 1

    def append(self, record: Record) -> None:
        """Add a record behind the others, before any is read; OSError where there is no room."""
        content = marshal.dumps(record)
        self._file.write(content)
        self._ends.append(self._ends[-1] + len(content))

    def flush(self) -> None:
        """Have all records where they are read from; OSError where there is no room."""
        self._file.flush()

    def __getitem__(self, row: int) -> Record:
        start, end = self._ends[row], self._ends[row + 1]
        self._file.seek(start)
        record: Record = marshal.loads(self._file.read(end - start))
        return record

    def __iter__(self) -> Iterator[Record]:
        for row in range(len(self)):
            yield self[row]

    def close(self) -> None:
        """Give the room back; nothing can be read any more."""
        self._file.close()
