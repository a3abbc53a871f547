"""Files of cameras, read with bounds: numbers in text, JSON, YAML and MATLAB's."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.mat_file import DamagedError, parse_mat
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

LARGEST_TEXT_BYTES = 400_000_000
"""Of a JSON file with the tracks of 20,000 photos."""
LARGEST_LIST_BYTES = 50_000_000
"""Of a file that only lists cameras: 200,000 lines of 22 numbers."""
LARGEST_SIDE_PX = 100_000
_MAT_LIMITS = Limits(memory_mb=2500, seconds=60)
"""A variable may be of 1 GB."""
COPY_AGAIN = "Copy it again, or export it again from the software that made it."


def read_bytes(path: Path, largest: int = LARGEST_LIST_BYTES) -> bytes:
    """What a file holds; InputError where it is none, too large, or may not be read."""
    try:
        require_file(path, largest)
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(path, "does not exist", "Check its name.") from None
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its permissions.") from error


def read_text(path: Path, largest: int = LARGEST_LIST_BYTES) -> str:
    """The text of a file; InputError where it is none."""
    data = read_bytes(path, largest)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(path, "is not a text file", COPY_AGAIN) from None
    if "\0" in text:
        raise InputError(path, "is not a text file", COPY_AGAIN)
    return text


def read_head(path: Path, most_bytes: int) -> str:
    """The start of a file's text, to see what it is; nothing of a folder or a link to nothing."""
    if not path.is_file():
        return ""
    try:
        with path.open("rb") as file:
            return file.read(most_bytes).decode("utf-8", "replace")
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its permissions.") from error


def lines_of(text: str) -> list[tuple[int, list[str]]]:
    """The number and the words of each line that says something; `#` starts a remark."""
    lines = (
        (number, line.split("#")[0].split()) for number, line in enumerate(text.split("\n"), 1)
    )
    return [(number, words) for number, words in lines if words]


def numbers(path: Path, place: str, words: list[str], count: int) -> NDArray[np.float64]:
    """(count,) finite numbers; InputError says where they are not."""
    try:
        values = np.array([float(word) for word in words])
    except ValueError:
        raise InputError(path, f"{place} has words that are no numbers", COPY_AGAIN) from None
    if len(values) != count:
        raise InputError(path, f"{place} has {len(values)} numbers, not {count}", COPY_AGAIN)
    if not np.isfinite(values).all():
        raise InputError(path, f"{place} has numbers that are not finite", COPY_AGAIN)
    return values


def picture_size(path: Path, width: object, height: object) -> tuple[int, int]:
    """Width and height (px) that a file says; InputError where they cannot be a picture's."""
    try:
        sides = int(float(str(width))), int(float(str(height)))
    except (ValueError, OverflowError):
        sides = 0, 0
    if not all(0 < side <= LARGEST_SIDE_PX for side in sides):
        fault = f"has a camera of {width} x {height} px"
        raise InputError(path, fault, COPY_AGAIN)
    return sides


def read_json(path: Path) -> Any:
    """What a JSON file says; InputError where it is damaged, or nested without end."""
    text = read_text(path, LARGEST_TEXT_BYTES)
    try:
        return json.loads(text)
    except RecursionError:
        raise InputError(path, "is nested too deep", COPY_AGAIN) from None
    except ValueError as error:
        raise InputError(path, f"is no JSON ({error})", COPY_AGAIN) from None


def read_mat(path: Path) -> dict[str, Any]:
    """The variables of a MATLAB file (up to version 7.2); InputError where it is damaged.

    It is unpacked in a process with limits: a megabyte may hold a thousand of them.
    """
    return limited(_read_mat, path, path, COPY_AGAIN, _MAT_LIMITS)


def _read_mat(path: Path) -> dict[str, Any]:
    data = read_bytes(path, LARGEST_TEXT_BYTES)
    if data[:4] == b"\x89HDF" or b"MATLAB 7.3" in data[:32]:
        raise InputError(path, "is a MATLAB 7.3 file", "Save it with `save(name, '-v7')`.")
    try:
        return parse_mat(data)
    except DamagedError as error:
        raise InputError(path, f"is truncated or damaged ({error})", COPY_AGAIN) from None


def read_opencv(path: Path) -> dict[str, Any]:
    """The top of a file of OpenCV's FileStorage (YAML, XML): matrices, numbers and words."""
    text = read_text(path, LARGEST_LIST_BYTES)
    if path.suffix.lower() in (".yml", ".yaml") and not text.startswith("%YAML"):
        text = "%YAML:1.0\n---\n" + text
    try:
        flags = cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY
        storage = cv2.FileStorage(text, flags)
        root = storage.root()
        return {key: _value(root.getNode(key)) for key in root.keys()}  # noqa: SIM118 - a FileNode
    except (cv2.error, SystemError) as error:
        fault = f"is not as OpenCV writes it ({str(error).strip().splitlines()[-1]})"
        raise InputError(path, fault, COPY_AGAIN) from None


def _value(node: cv2.FileNode) -> Any:
    if node.isInt() or node.isReal():
        return node.real()
    if node.isString():
        return node.string()
    if node.isSeq():
        return [_value(node.at(index)) for index in range(min(node.size(), 100_000))]
    if node.isMap():
        keys = list(node.keys())
        if {"rows", "cols", "data"} <= set(keys):
            return node.mat()
        if {"sizes", "data"} <= set(keys):
            return _value(node.getNode("data"))
        return {key: _value(node.getNode(key)) for key in keys}
    return None
