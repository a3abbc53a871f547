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
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet
from numpy.typing import NDArray
from rosbags import rosbag1, rosbag2
from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.interfaces import Connection
from rosbags.typesys import Stores, get_typestore

from veduta.drive.document.log import Bag, DriveLog, Scanner
from veduta.drive.read.bag_mend import mend_bag
from veduta.run.errors import InputError

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

_ROWS = 2048
"""Of a table that are in memory at once."""
_ANGLE_RAD = 2e-3
"""How far the beams of messages may be from those of drive.toml."""
_FAULTS = (
    AnyReaderError, rosbag1.ReaderError, rosbag2.ReaderError, AssertionError, LookupError, OSError,
    ArithmeticError, EOFError, RuntimeError, TypeError, ValueError, sqlite3.Error, struct.error,
    zstd.ZstdError,
)  # fmt: skip
"""What readers of bags raise at bytes that are none of a bag."""
_BROKEN = (AnyReaderError, ArithmeticError, AssertionError, LookupError, TypeError)
"""And at a message that is none of its type."""
Row = dict[str, Any]


def unpack_bag(
    folder: Path, log: DriveLog, bag: Bag, scratch: Path, told: Callable[[float], None]
) -> list[str]:
    """Write the tables that topics are mapped to into `scratch`; what was left out, in words.

    InputError where the bag cannot be read, or a topic is not in it or of another kind.
    """
    path = folder / bag.file
    if not path.exists():
        raise InputError(path, "there is no such bag", "drive.toml names it: put it there.")
    scratch.mkdir(parents=True, exist_ok=True)
    notes: list[str] = []
    with _opened(path, scratch, notes) as reader:
        wanted = {topic: table for table, topic in bag.topics.items()}
        if len(wanted) < len(bag.topics):
            fault = "bag.topics: gives one topic to two tables"
            raise InputError(folder / "drive.toml", fault, "Give each table a topic of its own.")
        found = [one for one in reader.connections if one.topic in wanted]
        missing = sorted(set(wanted) - {one.topic for one in found})
        if missing:
            there = ", ".join(sorted({one.topic for one in reader.connections})[:20])
            raise InputError(path, f"has no topic {missing[0]}", f"It has: {there}.")
        writers = {table: _Table(scratch / table) for table in bag.topics}
        rows = _rows_of(log, bag, path, scratch)
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
            row = rows(table, connection.msgtype, message, stamp * 1e-9)
            if row is not None:
                writers[table].add(row)
        for table, one in writers.items():
            one.close()
            if not one.written:
                fault = f"has no message in {bag.topics[table]} that can be read"
                remedy = f"Record it again, or take {table} out of drive.toml."
                raise InputError(path, fault, remedy)
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
def _opened(path: Path, scratch: Path, notes: list[str]) -> Iterator[AnyReader]:
    """The bag, or, where it was cut off, what is whole in it."""
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
        yield reader
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


def _rows_of(
    log: DriveLog, bag: Bag, path: Path, scratch: Path
) -> Callable[[str, str, Any, float], Row | None]:
    """What makes a row of a table of a message: by the kind of the message."""
    scanners = {one.table: one for one in (log.vertical, log.horizontal) if one is not None}

    def row(table: str, kind: str, message: Any, stamp_s: float) -> Row | None:
        name = kind.rsplit("/", 1)[-1]
        time_s = _time(message, stamp_s)
        if name == "LaserScan" and table in scanners:
            return {"time_s": time_s, "ranges_m": _ranges(message, scanners[table], path)}
        if name == "Odometry":
            return {"time_s": time_s, "matrix": _matrix(message.pose.pose)}
        if name == "PoseStamped":
            return {"time_s": time_s, "matrix": _matrix(message.pose)}
        if name == "NavSatFix":
            return {
                "time_s": time_s, "longitude_deg": float(message.longitude),
                "latitude_deg": float(message.latitude),
            }  # fmt: skip
        if name == "CompressedImage":
            return {"time_s": time_s, "file": _image(message, table, time_s, scratch)}
        fault = f"has {kind} in {bag.topics[table]}, which cannot become {table}"
        raise InputError(path, fault, "LaserScan, Odometry, PoseStamped, NavSatFix and"
                         " CompressedImage are read.")  # fmt: skip

    return row


def _time(message: Any, stamp_s: float) -> float:
    stamp = message.header.stamp
    own = float(stamp.sec) + 1e-9 * float(stamp.nanosec)
    return own if own > 0.0 else stamp_s


def _ranges(message: Any, scanner: Scanner, path: Path) -> NDArray[np.float32]:
    ranges = np.array(message.ranges, dtype=np.float32)
    first, step = float(message.angle_min), float(message.angle_increment)
    last = abs(
        first + step * len(ranges) - scanner.first_beam_rad - scanner.beam_step_rad * len(ranges)
    )
    if abs(first - scanner.first_beam_rad) > _ANGLE_RAD or last > 10 * _ANGLE_RAD:
        fault = f"has beams from {first:.4f} rad, {step:.5f} rad apart, and drive.toml others"
        remedy = f"Write first_beam_rad = {first:.6f}, beam_step_rad = {step:.8f}."
        raise InputError(path, fault, remedy)
    with np.errstate(invalid="ignore"):
        ranges[~((ranges >= message.range_min) & (ranges <= message.range_max))] = 0.0
    return ranges


def _matrix(pose: Any) -> list[float]:
    """3x4 by rows of a pose with a quaternion."""
    turn = pose.orientation
    x, y, z, w = np.array([turn.x, turn.y, turn.z, turn.w]) / max(
        float(np.linalg.norm([turn.x, turn.y, turn.z, turn.w])), 1e-12
    )
    place = pose.position
    return [
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), float(place.x),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), float(place.y),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), float(place.z),
    ]  # fmt: skip


def _image(message: Any, table: str, time_s: float, scratch: Path) -> str:
    data = bytes(message.data)
    suffix = "png" if data.startswith(b"\x89PNG") else "jpg"
    folder = scratch / f"{Path(table).stem}-files"
    folder.mkdir(exist_ok=True)
    file = folder / f"{round(time_s * 1e6)}.{suffix}"
    file.write_bytes(data)
    return f"{folder.name}/{file.name}"
