"""Topics of a ROS 1 bag, ROS 2 bag or MCAP as the tables that a `drive.toml` names.

A bag is read once, message by message; what comes out has the layout that `read.own` reads.
"""

from __future__ import annotations

import sqlite3
import struct
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pyarrow
import pyarrow.parquet
from rosbags import rosbag1, rosbag2
from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.interfaces import Connection
from rosbags.typesys import Stores, get_typestore

from veduta.drive.document.log import Bag, DriveLog
from veduta.drive.read.bag_mend import mend_bag
from veduta.drive.read.bag_rows import STATIC, BagRows, Row
from veduta.run.errors import InputError
from veduta.run.limits import Limits, limited

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

_ROWS = 2048
"""Of a table that are in memory at once."""
_FAULTS = (
    AnyReaderError, rosbag1.ReaderError, rosbag2.ReaderError, AssertionError, LookupError, OSError,
    ArithmeticError, EOFError, RuntimeError, TypeError, ValueError, sqlite3.Error, struct.error,
    zstd.ZstdError,
)  # fmt: skip
"""What readers of bags raise at bytes that are none of a bag."""
_BROKEN = (AnyReaderError, ArithmeticError, AssertionError, LookupError, TypeError)
"""And at a message that is none of its type."""
_MEMORY_MB, _SECONDS, _BYTES_A_SECOND = 4000, 300, 1_000_000
"""What unpacking may cost; bags of scans and pictures are read at 20 to 60 MB/s."""


def unpack_in_limits(folder: Path, log: DriveLog, bag: Bag, scratch: Path) -> list[str]:
    """As `unpack_bag`, in a process of its own: a block of a bag may swell to any size."""
    path = folder / bag.file
    files = [path] if path.is_file() else [one for one in path.glob("*") if one.is_file()]
    size = sum(one.stat().st_size for one in files)
    limits = Limits(_MEMORY_MB, _SECONDS + size // _BYTES_A_SECOND)
    return limited(_unpacked, (folder, log, bag, scratch), path, "Record it anew.", limits)


def _unpacked(given: tuple[Path, DriveLog, Bag, Path]) -> list[str]:
    return unpack_bag(*given)


def unpack_bag(
    folder: Path,
    log: DriveLog,
    bag: Bag,
    scratch: Path,
    told: Callable[[float], None] = lambda share: None,
) -> list[str]:
    """Write the tables that topics are mapped to into `scratch`; what was left out, in words.

    InputError where the bag cannot be read, or a topic is not in it or of another kind.
    """
    path = folder / bag.file
    if not path.exists():
        raise InputError(path, "there is no such bag", "drive.toml names it: put it there.")
    scratch.mkdir(parents=True, exist_ok=True)
    notes: list[str] = []
    with _opened(path, scratch) as (reader, mended):
        notes += mended
        wanted = {topic: table for table, topic in bag.topics.items()}
        if len(wanted) < len(bag.topics):
            fault = "bag.topics: gives one topic to two tables"
            raise InputError(folder / "drive.toml", fault, "Give each table a topic of its own.")
        if log.path is not None and log.path.tf is not None and log.path.table in bag.topics:
            wanted.setdefault(STATIC, log.path.table)
        found = [one for one in reader.connections if one.topic in wanted]
        missing = sorted(set(bag.topics.values()) - {one.topic for one in found})
        if missing:
            there = ", ".join(sorted({one.topic for one in reader.connections})[:20])
            raise InputError(path, f"has no topic {missing[0]}", f"It has: {there}.")
        writers = {table: _Table(scratch / table) for table in bag.topics}
        rows = BagRows(log, bag, path, scratch)
        total = max(sum(one.msgcount for one in found), 1)
        broken = 0
        for number, (connection, stamp, raw) in enumerate(_messages(reader, found, path)):
            told(number / total)
            table = wanted[connection.topic]
            try:
                message = reader.deserialize(raw, connection.msgtype)
            except _BROKEN:
                broken += 1
                continue
            row = rows.row(table, connection.msgtype, message, stamp * 1e-9)
            if row is not None:
                writers[table].add(row)
        for table, one in writers.items():
            one.close()
            if not one.written:
                raise rows.empty(table)
    if broken:
        notes.append(f"{broken} messages of {bag.file} cannot be read and are left out")
    return notes


def _messages(
    reader: AnyReader, found: list[Connection], path: Path
) -> Iterator[tuple[Connection, int, bytes]]:
    try:
        yield from reader.messages(found)
    except _FAULTS as error:
        fault = f"cannot be read to its end ({type(error).__name__}: {error})"
        raise InputError(path, fault, "Copy the bag again.") from error


@contextmanager
def _opened(path: Path, scratch: Path) -> Iterator[tuple[AnyReader, list[str]]]:
    """The bag, or, where it was cut off, what is whole in it, and a note that it was."""
    notes: list[str] = []
    store = get_typestore(Stores.ROS2_HUMBLE)
    reader = AnyReader([path], default_typestore=store)
    try:
        reader.open()
    except _FAULTS as error:
        if path.is_dir():
            raise InputError(path, f"cannot be read ({error})", "Copy the bag again.") from error
        mended, share = mend_bag(path, scratch)
        notes.append(f"{path.name} was cut off: {100 * share:.0f} % of its bytes are used")
        reader = AnyReader([mended], default_typestore=store)
        try:
            reader.open()
        except _FAULTS as again:
            raise InputError(path, f"cannot be read ({again})", "Copy the bag again.") from again
    try:
        yield reader, notes
    finally:
        reader.close()


class _Table:
    """A Parquet table that grows by rows."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._rows: list[Row] = []
        self._writer: pyarrow.parquet.ParquetWriter | None = None

    @property
    def written(self) -> bool:
        """Whether it has any row on disk."""
        return self._writer is not None

    def add(self, row: Row) -> None:
        self._rows.append(row)
        if len(self._rows) >= _ROWS:
            self._flush()

    def _flush(self) -> None:
        if not self._rows:
            return
        columns = {name: [row[name] for row in self._rows] for name in self._rows[0]}
        table = pyarrow.table(columns)
        if self._writer is None:
            self._writer = pyarrow.parquet.ParquetWriter(self._path, table.schema)
        self._writer.write_table(table)
        self._rows = []

    def close(self) -> None:
        self._flush()
        if self._writer is not None:
            self._writer.close()
