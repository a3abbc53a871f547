"""Scans as LAS or LAZ: only the points, in the scanner's frame (m)."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

_MOST_BYTES, _MOST_POINTS = 1 << 30, 20_000_000
_MOST_PACKED = 1000
"""How much smaller LAZ may be than LAS: of scans it is a tenth."""
_HEAD = struct.Struct("<25x B 68x H I I x")
"""Minor version, size of the header, where points begin, number of records; up to the format."""
_LATE = struct.Struct("<138x I")
"""From there on to the number of records behind the points (1.4)."""
_RECORD_BYTES, _LATE_RECORD_BYTES = 54, 60
_BROKEN = (OSError, ValueError, OverflowError, struct.error)
"""Of heads that end too early, and of days that no calendar has (laspy 2)."""
_LIMITS = Limits(memory_mb=3000, seconds=120)
"""The largest one takes half of this."""


def read_las(path: Path) -> NDArray[np.float64]:
    """(n, 3) the points of a scan (m). InputError names what is wrong with the file."""
    return limited(_points, path, path, "Give a file for each turn of the scanner.", _LIMITS)


def _points(path: Path) -> NDArray[np.float64]:
    import laspy  # here, as only the process that reads needs them
    import lazrs

    require_file(path, _MOST_BYTES)
    _require_counts(path)
    try:
        with laspy.open(path) as file:
            _require_points(path, file.header.point_count, file.header.point_format.size)
            points = file.read()
    except (laspy.errors.LaspyException, lazrs.LazrsError, *_BROKEN) as error:
        raise InputError(path, "is no LAS that can be read", "Copy it again.") from error
    if not len(points.points):
        raise InputError(path, "has no points", "Remove it.")
    return np.stack([points.x, points.y, points.z], axis=1).astype(np.float64)


def _require_counts(path: Path) -> None:
    """Refuse records and chunks that the file has no room for: laspy and lazrs make room for all.

    Places of the LAS 1.4 R15 specification, tables 3 to 5; a chunk table begins with its version
    and its count (LASzip 3.4), and an i64 before the first point says where it lies.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        head = file.read(_HEAD.size)
        if len(head) < _HEAD.size:
            return  # laspy says what is missing
        minor, header_size, points_at, records = _HEAD.unpack(head)
        packed = head[104] & 0x80
        room = min(points_at, size) - header_size
        counts = [(records, _RECORD_BYTES, room)]
        if minor >= 4:
            late = file.read(_LATE.size)
            if len(late) == _LATE.size:
                counts.append((_LATE.unpack(late)[0], _LATE_RECORD_BYTES, size))
        if packed and points_at + 8 <= size:
            file.seek(points_at)
            (table_at,) = struct.unpack("<q", file.read(8))
            if table_at == -1:  # it was written as it came: the file's last bytes say where
                file.seek(size - 8)
                (table_at,) = struct.unpack("<q", file.read(8))
            if 0 <= table_at <= size - 8:
                file.seek(table_at)
                _, chunks = struct.unpack("<II", file.read(8))
                counts.append((chunks, 1, size))
    for count, least, room in counts:
        if count * least > max(room, 0):
            fault = f"says that it has {count:,} records or chunks, more than it can hold"
            raise InputError(path, fault, "Copy it again.")


def _require_points(path: Path, count: int, size: int) -> None:
    """Refuse more points than a scan has, or than there can be in a file of its length."""
    if count > _MOST_POINTS:
        fault = f"has {count:,} points, too many for one scan"
        raise InputError(path, fault, "Give a file for each turn of the scanner.")
    if count * size > _MOST_PACKED * path.stat().st_size:
        fault = f"says that it has {count:,} points, which is more than it can hold"
        raise InputError(path, fault, "Copy it again.")
