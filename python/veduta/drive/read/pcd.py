"""PCD files (Point Cloud Library, version 0.7): fields x, y, z; binary, compressed or text."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_LARGEST_BYTES = 1 << 30
_MOST_POINTS = 20_000_000
_HEADER = 4096
_MOST_REPEATS = 4096
"""Of one field: the longest histograms have some hundred values."""
_TYPES = {
    *(("F", size) for size in ("2", "4", "8")),
    *((kind, size) for kind in "IU" for size in ("1", "2", "4", "8")),
}
_Column = tuple[str, str, tuple[int, ...]]


def read_pcd(path: Path) -> NDArray[np.float64]:
    """(n, 3) the points (m), NaN and all; InputError where the file is cut or of another kind."""
    require_file(path, _LARGEST_BYTES)
    data = path.read_bytes()
    fields, body = _header(path, data)
    count, columns = _count(path, fields), _columns(path, fields)
    kind = np.dtype(columns)
    _require_axes(path, columns)
    coding = fields["DATA"][0]
    if coding == "ascii":
        return _text(path, data[body:], columns, count)
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


def _columns(path: Path, fields: dict[str, list[str]]) -> list[_Column]:
    """Name, type and shape of each field; `_` is padding and gets a name of its own."""
    names, sizes, kinds = fields["FIELDS"], fields["SIZE"], fields["TYPE"]
    repeats = fields.get("COUNT", ["1"] * len(names))
    if not len(names) == len(sizes) == len(kinds) == len(repeats):
        raise InputError(path, "its header has columns of different lengths", "Write it again.")
    found: list[_Column] = []
    for number, (name, size, kind, repeat) in enumerate(
        zip(names, sizes, kinds, repeats, strict=True)
    ):
        if (kind, size) not in _TYPES:
            fault = f"its field {name!r} is of an unknown type"
            raise InputError(path, fault, "Write it again.")
        if not repeat.isdigit() or len(repeat) > 4 or not 1 <= int(repeat) <= _MOST_REPEATS:
            fault = f"its field {name!r} says that it has {repeat[:20]} values"
            raise InputError(path, fault, f"COUNT must be 1 to {_MOST_REPEATS}.")
        own = name if name != "_" else f"_ {number}"
        if any(own == known for known, _, _ in found):
            raise InputError(path, f"has two fields {name!r}", "Give each field its own name.")
        shape: tuple[int, ...] = () if int(repeat) == 1 else (int(repeat),)
        found.append((own, f"<{kind.lower()}{size}", shape))
    return found


def _require_axes(path: Path, columns: list[_Column]) -> None:
    shapes = {name: shape for name, _, shape in columns}
    for axis in "xyz":
        if axis not in shapes:
            raise InputError(path, f"has no field {axis!r}", "Give points with x, y and z.")
        if shapes[axis]:
            fault = f"its field {axis!r} has several values for a point"
            raise InputError(path, fault, "Write x, y and z with COUNT 1.")


def _count(path: Path, fields: dict[str, list[str]]) -> int:
    text = (fields["POINTS"] or [""])[0]
    if not text.isdigit() or len(text) > 20 or int(text) > _MOST_POINTS:
        fault = f"says that it has {text[:20] or 'no'} points"
        raise InputError(path, fault, f"It must be a number up to {_MOST_POINTS}.")
    return int(text)


def _text(path: Path, body: bytes, columns: list[_Column], count: int) -> NDArray[np.float64]:
    try:
        body.decode("ascii")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # that there is no line at all
            rows = np.loadtxt(io.BytesIO(body), comments=None, ndmin=2)
    except (UnicodeDecodeError, ValueError) as error:
        raise InputError(path, "has a line that is not numbers", "Write it again.") from error
    first, width = {}, 0
    for name, _, shape in columns:
        first[name] = width
        width += shape[0] if shape else 1
    if rows.shape != (count, width):
        raise InputError(path, f"has not the {count} points that it says", "Copy it again.")
    return np.asarray(rows[:, [first[axis] for axis in "xyz"]])
