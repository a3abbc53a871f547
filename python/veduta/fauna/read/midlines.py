"""Midlines that somebody has measured already: a CSV with a row for each point of each frame.

The columns are found by name: `frame`, `point`, a time (`t`, `time`) and two coordinates, `x` and
`y` or words that hold them and end in their unit (`mxmm`, `x_px`). Without a unit they are pixels.
"""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats
from veduta.fauna.read.tracked import Tracked
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_MOST_BYTES = 200_000_000
_UNITS = {"mm": 1e-3, "cm": 1e-2, "um": 1e-6, "m": 1.0}
_COORDINATE = re.compile(r"^(?:m|mid|midline)?_?([xy])_?(mm|cm|um|m|px)?$")
_FEWEST_POINTS = 5
_REMEDY = "Give a CSV with frame, point, t (s), x and y (or x_mm, y_mm), a row for each point."


def read_midlines(path: Path) -> Tracked:
    """The axes in a file of midlines; y is taken as upwards. InputError where they are none."""
    header, values = _table(path)
    names = [name.strip().lower() for name in header]
    columns, scale = _columns(path, names)
    frames = values[:, columns["frame"]]
    points = values[:, columns["point"]]
    if not (np.isfinite(frames).all() and np.isfinite(points).all()):
        raise InputError(path, "has a row without the number of its frame or point", _REMEDY)
    order = np.lexsort((points, frames))
    values, frames = values[order], frames[order]
    numbers, counts = np.unique(frames.astype(np.int64), return_counts=True)
    count = int(counts.max())
    odd = numbers[counts != count]
    if len(odd):
        fault = f"frame {odd[0]} has not {count} points, as others do"
        raise InputError(path, fault, "Leave the values of a missing point empty, but not its row.")
    if count < _FEWEST_POINTS:
        raise InputError(path, f"has only {count} points in a frame", _REMEDY)
    axes = values[:, [columns["x"], columns["y"]]].reshape(len(numbers), count, 2)
    times = values[:, columns["t"]].reshape(len(numbers), count)[:, 0]
    whole = np.isfinite(axes).all(axis=(1, 2))
    left_out = tuple(f"frame {number}: points are missing" for number in numbers[~whole])
    return Tracked(
        points=axes[whole] * (scale or 1.0),
        frame=numbers[whole],
        frame_s=_frame_s(path, times, numbers),
        unit="m" if scale else "px",
        half_widths=None,
        left_out=left_out,
    )


def _table(path: Path) -> tuple[list[str], Floats]:
    """The names of the columns, and all rows as numbers; NaN where there is none."""
    try:
        require_file(path, _MOST_BYTES)
        text = path.read_text("utf-8-sig")
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is not text", _REMEDY) from error
    header, _, rest = text.partition("\n")
    names = next(csv.reader([header]), [])
    if not names or not rest.strip():
        raise InputError(path, "has no rows", _REMEDY)
    try:
        values = np.genfromtxt(io.StringIO(rest), delimiter=",", ndmin=2)
    except ValueError as error:
        raise InputError(path, "has rows of different lengths", _REMEDY) from error
    if values.shape[1] != len(names):
        raise InputError(path, "has rows of another length than the first", _REMEDY)
    return names, np.asarray(values, dtype=np.float64)


def _columns(path: Path, names: list[str]) -> tuple[dict[str, int], float | None]:
    """Where each column stands, and how many metres the coordinates' unit has."""
    found: dict[str, int] = {}
    units: set[str | None] = set()
    for place, name in enumerate(names):
        match = _COORDINATE.match(name)
        if match:
            found.setdefault(match[1], place)
            units.add(match[2])
        elif name in {"frame", "point"}:
            found[name] = place
        elif name in {"t", "time", "time_s", "t_s"}:
            found["t"] = place
    missing = [name for name in ("frame", "point", "t", "x", "y") if name not in found]
    if missing:
        raise InputError(path, f"has no column {', '.join(missing)}", _REMEDY)
    if len(units) > 1:
        raise InputError(path, "has coordinates in different units", _REMEDY)
    return found, _UNITS.get(units.pop() or "px")


def _frame_s(path: Path, times: Floats, numbers: NDArray[np.int64]) -> float:
    """Seconds from one frame to the next, by all frames whose time is given."""
    known = np.isfinite(times)
    if int(known.sum()) < 2:
        raise InputError(path, "gives no times", _REMEDY)
    steps = np.diff(times[known]) / np.diff(numbers[known])
    step = float(np.median(steps))
    if step <= 0.0:
        raise InputError(path, "has times that do not ascend", _REMEDY)
    return step
