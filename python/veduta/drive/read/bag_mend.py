"""A bag whose recording was cut off: what is whole in it, as a bag that readers take.

ROS 1 bags and MCAP are rows of records; an index comes last, so that it is missing where a
recording was cut. Records that are whole are copied (formats: wiki.ros.org/Bags/Format/2.0,
mcap.dev/spec).
"""

from __future__ import annotations

import bz2
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from rosbags.interfaces import Connection
from rosbags.rosbag1 import Writer, WriterError

from veduta.run.errors import InputError

_MCAP, _ROS1 = b"\x89MCAP0\r\n", b"#ROSBAG V2.0\n"
_FOOTER = b"\x02" + struct.pack("<Q", 20) + bytes(20)
_DATA_END = b"\x0f" + struct.pack("<Q", 4) + bytes(4)
_MOST_RECORD = 1 << 30
_MOST_CHUNK = 1 << 30
_CHUNK, _CONNECTION, _MESSAGE = 5, 7, 2


def mend_bag(path: Path, folder: Path) -> tuple[Path, float]:
    """A copy in a folder of what is whole, and the share of the file's bytes that are in it.

    InputError where nothing of it can be read.
    """
    with path.open("rb") as file:
        magic = file.read(len(_ROS1))
    if magic.startswith(_MCAP):
        return _mended_mcap(path, folder / "mended.mcap")
    if magic == _ROS1:
        return _mended_ros1(path, folder / "mended.bag")
    raise InputError(path, "is no ROS bag and no MCAP", "Copy it again.")


def _mended_mcap(path: Path, target: Path) -> tuple[Path, float]:
    size = path.stat().st_size
    whole = len(_MCAP)
    with path.open("rb") as file, target.open("wb") as copy:
        copy.write(file.read(whole))
        while len(head := file.read(9)) == 9:
            kind, (length,) = head[0], struct.unpack("<Q", head[1:])
            if kind in (0x02, 0x0F) or length > _MOST_RECORD:
                break
            body = file.read(length)
            if len(body) < length:
                break
            copy.write(head + body)
            whole += 9 + length
        copy.write(_DATA_END + _FOOTER + _MCAP)
    return target, whole / size


def _mended_ros1(path: Path, target: Path) -> tuple[Path, float]:
    size, whole = path.stat().st_size, 0
    target.unlink(missing_ok=True)
    try:
        with path.open("rb") as file, Writer(target) as writer:
            file.seek(len(_ROS1))
            connections: dict[int, Connection] = {}
            for header, body in _records(file):
                kind = header.get("op", b"\0")[0]
                if kind == _CHUNK:
                    for inner, data in _records_of(_unpacked(header, body, path)):
                        _copy(inner, data, writer, connections)
                    whole = file.tell()
    except (WriterError, struct.error, IndexError) as error:
        raise InputError(
            path, f"has messages that contradict each other ({error})", "Copy it again."
        ) from error
    if not whole:
        raise InputError(path, "breaks off before its first chunk is whole", "Record it again.")
    return target, whole / size


def _copy(
    header: dict[str, bytes], data: bytes, writer: Writer, connections: dict[int, Connection]
) -> None:
    kind = header.get("op", b"\0")[0]
    number = struct.unpack("<L", header.get("conn", bytes(4)))[0]
    if kind == _CONNECTION and number not in connections:
        told = _header(data)
        words = {name: value.decode("utf-8", "replace") for name, value in told.items()}
        kind_name = words.get("type", "")
        if "/msg/" not in kind_name:
            kind_name = kind_name.replace("/", "/msg/", 1)
        connections[number] = writer.add_connection(
            header.get("topic", told.get("topic", b"")).decode("utf-8", "replace"),
            kind_name,
            msgdef=words.get("message_definition", ""),
            md5sum=words.get("md5sum", ""),
        )
    elif kind == _MESSAGE and number in connections:
        seconds, parts = struct.unpack("<LL", header.get("time", bytes(8)))
        writer.write(connections[number], seconds * 10**9 + parts, data)


def _unpacked(header: dict[str, bytes], body: bytes, path: Path) -> bytes:
    how = header.get("compression", b"none")
    if how == b"none":
        return body
    if how == b"bz2":
        return _unpacked_bz2(body, path)
    fault = f"was cut off, and its chunks are packed by {how.decode('ascii', 'replace')}"
    raise InputError(path, fault, "Mend it with `rosbag reindex`.")


def _unpacked_bz2(body: bytes, path: Path) -> bytes:
    packed = bz2.BZ2Decompressor()
    try:
        data = packed.decompress(body, _MOST_CHUNK)
    except (OSError, ValueError) as error:
        fault = f"has a chunk that cannot be unpacked ({error})"
        raise InputError(path, fault, "Copy it again.") from error
    if not packed.eof:
        fault = f"has a chunk that is not whole, or larger than {_MOST_CHUNK:,} bytes"
        raise InputError(path, fault, "Record it again with smaller chunks.")
    return data


def _records(file: BinaryIO) -> Iterator[tuple[dict[str, bytes], bytes]]:
    """Whole records from where a file stands; the first that is not whole ends them."""
    while True:
        head = _sized(file)
        body = None if head is None else _sized(file)
        if head is None or body is None:
            return
        yield _header(head), body


def _sized(file: BinaryIO) -> bytes | None:
    size = file.read(4)
    if len(size) < 4:
        return None
    (length,) = struct.unpack("<L", size)
    if length > _MOST_RECORD:
        return None
    data = file.read(length)
    return data if len(data) == length else None


def _records_of(chunk: bytes) -> Iterator[tuple[dict[str, bytes], bytes]]:
    at = 0
    while at + 4 <= len(chunk):
        (length,) = struct.unpack_from("<L", chunk, at)
        head = chunk[at + 4 : at + 4 + length]
        at += 4 + length
        if at + 4 > len(chunk):
            return
        (size,) = struct.unpack_from("<L", chunk, at)
        yield _header(head), chunk[at + 4 : at + 4 + size]
        at += 4 + size


def _header(data: bytes) -> dict[str, bytes]:
    """Fields `name=value`, each after its length."""
    found, at = {}, 0
    while at + 4 <= len(data):
        (length,) = struct.unpack_from("<L", data, at)
        name, _, value = data[at + 4 : at + 4 + length].partition(b"=")
        found[name.decode("ascii", "replace")] = value
        at += 4 + length
    return found
