"""Rows of scans on disk: a drive of hours is not held in memory."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.compute
import pyarrow.parquet
from numpy.typing import NDArray

from veduta.drive.read.tables import list_column, open_table, time_column
from veduta.run.errors import NO_ROOM, InputError, UnwritableError

_ROWS = 4096
"""Of a table that are in memory at once."""


class SpooledScans:
    """Ranges of all scans, in a file without a name that goes with this object.

    times_s: (n,) as the table has them. beams: values in a row.
    """

    def __init__(self, path: Path) -> None:
        """Reads and checks a table with `time_s` and `ranges_m`. InputError says what is wrong."""
        self._file = tempfile.TemporaryFile()  # noqa: SIM115 - it lives as long as the readers
        self.times_s = np.zeros(0)
        self.beams = 0
        self._spool(path)
        self.order: NDArray[np.int64] = np.argsort(self.times_s, kind="stable")

    def _spool(self, path: Path) -> None:
        times = []
        with open_table(path, ("time_s", "ranges_m")) as table:
            try:
                batches = table.iter_batches(batch_size=_ROWS, columns=["time_s", "ranges_m"])
                for batch in batches:
                    rows = pyarrow.Table.from_batches([batch])
                    ranges = list_column(path, rows, "ranges_m").astype(np.float32)
                    if len(rows) and self.beams not in (0, ranges.shape[1]):
                        fault = "has lists of different lengths in 'ranges_m'"
                        raise InputError(path, fault, "Each row needs one value for each beam.")
                    self.beams = ranges.shape[1] if len(rows) else self.beams
                    self._file.write(ranges.tobytes())
                    times.append(time_column(path, rows))
            except (pyarrow.ArrowException, OSError) as error:
                if isinstance(error, OSError) and error.errno in NO_ROOM:
                    then = ": scans are kept in it while they are read (TMPDIR names another)"
                    raise UnwritableError.of(error, tempfile.gettempdir(), then) from error
                fault = "is a Parquet table that breaks off"
                raise InputError(path, fault, "Copy it again.") from error
        if not times or not self.beams or not len(np.concatenate(times)):
            raise InputError(path, "has no scans", "Give a scan in each row.")
        self._file.flush()
        self.times_s = np.concatenate(times)

    def ranges(self, row: int) -> NDArray[np.float32]:
        """(b,) of a row of the table (m)."""
        size = 4 * self.beams
        return np.frombuffer(os.pread(self._file.fileno(), size, row * size), dtype=np.float32)

    def in_order(self) -> Iterator[NDArray[np.float32]]:
        """The ranges of each scan, by their times."""
        for row in self.order.tolist():
            yield self.ranges(row)
