"""Points with colours as PLY (binary, little-endian), which every point viewer reads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_ROW = np.dtype(
    [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("red", "u1"), ("green", "u1"), ("blue", "u1")]
)

LARGEST_BYTES = 4 * 2**30
_END = b"end_header\n"


def _header(count: int) -> bytes:
    text = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {count}\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "end_header\n"
    )
    return text.encode("ascii")


def write_points(points: NDArray[np.float64], colours: NDArray[np.uint8], path: Path) -> None:
    """Write (n, 3) points and their (n, 3) sRGB colours."""
    rows = np.empty(len(points), dtype=_ROW)
    for axis, name in enumerate(("x", "y", "z")):
        rows[name] = points[:, axis]
    for channel, name in enumerate(("red", "green", "blue")):
        rows[name] = colours[:, channel]
    path.write_bytes(_header(len(rows)) + rows.tobytes())


def read_points(path: Path) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """The (n, 3) points and (n, 3) sRGB colours of a file that `write_points` has written.

    InputError on any other: meshes and clouds of other programs have other columns.
    """
    remedy = "Let Veduta write it again."
    try:
        require_file(path, LARGEST_BYTES)
        data = path.read_bytes()
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", remedy) from error
    count, odd = divmod(
        len(data) - data.find(b"end_header\n") - len(b"end_header\n"), _ROW.itemsize
    )
    if odd or count < 0 or not data.startswith(_header(count)):
        raise InputError(path, "is no cloud that Veduta wrote, or is cut short", remedy)
    rows = np.frombuffer(data, dtype=_ROW, offset=len(_header(count)))
    points = np.stack([rows[name] for name in ("x", "y", "z")], axis=1).astype(np.float64)
    colours = np.stack([rows[name] for name in ("red", "green", "blue")], axis=1)
    return points, colours
