"""PCD files (Point Cloud Library, version 0.7): fields x, y, z; binary, compressed or text."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError

_MOST_POINTS = 20_000_000
_HEADER = 4096
_KINDS = {"F": "f", "I": "i", "U": "u"}


def read_pcd(path: Path) -> NDArray[np.float64]:
    """(n, 3) the points (m), NaN and all; InputError where the file is cut or of another kind."""
    data = path.read_bytes()
    fields, body = _header(path, data)
    names, count = fields["FIELDS"], _count(path, fields)
    kind = np.dtype(_columns(path, fields))
    for axis in "xyz":
        if axis not in names:
            raise InputError(path, f"has no field {axis!r}", "Give points with x, y and z.")
    coding = fields["DATA"][0]
    if coding == "ascii":
        return _text(path, data[body:], names, count)
    if coding != "binary":
        fault = f"has DATA {coding}, which is not read"
        raise InputError(path, fault, "Write it as `DATA binary`.")
    needed = count * kind.itemsize
    if len(data) - body < needed:
        fault = f"ends after {(len(data) - body) // kind.itemsize} of {count} points"
        raise InputError(path, fault, "Copy it again.")
    rows = np.frombuffer(data, dtype=kind, count=count, offset=body)
    return np.stack([rows[axis].astype(np.float64) for axis in "xyz"], axis=1)


def _header(path: Path, data: bytes) -> tuple[dict[str, list[str]], int]:
    """The lines of the header by their first word, and where the points begin."""
    fields: dict[str, list[str]] = {}
    place = 0
    while place < min(len(data), _HEADER):
        end = data.find(b"\n", place)
        if end < 0:
            break
        words = data[place:end].decode("ascii", "replace").split()
        place = end + 1
        if words and not words[0].startswith("#"):
            fields[words[0]] = words[1:]
            if words[0] == "DATA" and len(words) > 1:
                missing = {"FIELDS", "SIZE", "TYPE", "POINTS"} - set(fields)
                if missing:
                    fault = f"its header has no {', '.join(sorted(missing))}"
                    raise InputError(path, fault, "Write it again.")
                return fields, place
    raise InputError(path, "is no PCD file: it has no header with DATA", "Copy it again.")


def _columns(path: Path, fields: dict[str, list[str]]) -> list[tuple[str, str, tuple[int, ...]]]:
    names, sizes, kinds = fields["FIELDS"], fields["SIZE"], fields["TYPE"]
    repeats = fields.get("COUNT", ["1"] * len(names))
    if not len(names) == len(sizes) == len(kinds) == len(repeats):
        raise InputError(path, "its header has columns of different lengths", "Write it again.")
    found: list[tuple[str, str, tuple[int, ...]]] = []
    for number, (name, size, kind, repeat) in enumerate(
        zip(names, sizes, kinds, repeats, strict=True)
    ):
        if kind not in _KINDS or size not in {"1", "2", "4", "8"} or not repeat.isdigit():
            fault = f"its field {name!r} is of an unknown type"
            raise InputError(path, fault, "Write it again.")
        own = name if name != "_" else f"_{number}"
        shape: tuple[int, ...] = () if repeat == "1" else (int(repeat),)
        found.append((own, f"<{_KINDS[kind]}{size}", shape))
    return found


def _count(path: Path, fields: dict[str, list[str]]) -> int:
    text = (fields["POINTS"] or [""])[0]
    if not text.isdigit() or int(text) > _MOST_POINTS:
        fault = f"says that it has {text or 'no'} points"
        raise InputError(path, fault, f"It must be a number up to {_MOST_POINTS}.")
    return int(text)


def _text(path: Path, body: bytes, names: list[str], count: int) -> NDArray[np.float64]:
    try:
        rows = np.array([line.split() for line in body.decode("ascii").splitlines()], dtype=float)
    except (UnicodeDecodeError, ValueError) as error:
        raise InputError(path, "has a line that is not numbers", "Write it again.") from error
    if rows.shape != (count, len(names)):
        raise InputError(path, f"has not the {count} points that it says", "Copy it again.")
    return np.asarray(rows[:, [names.index(axis) for axis in "xyz"]])
