"""Joints that somebody has marked or tracked: a CSV in the layout of DeepLabCut."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from veduta.fauna.motion.figure import Floats
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_MOST_BYTES = 200_000_000
_SURE = 0.6
"""Joints of a smaller likelihood are taken as not seen."""
_REMEDY = (
    "Give a CSV as DeepLabCut writes it: rows `bodyparts` and `coords`, then one for each frame."
)
_SAME = {"paw": "toe", "foot": "toe", "snout": "nose", "hindleg": "hind", "frontleg": "front",
         "rear": "hind", "fore": "front", "l": "left", "r": "right"}  # fmt: skip


@dataclass(frozen=True, eq=False)
class MarkedJoints:
    """px: by the figure's joint the places (t, 2) in each frame, y down, NaN where it is not seen.

    unknown: names in the file that the body plan does not have.
    """

    px: dict[str, Floats]
    unknown: tuple[str, ...]


def read_joints(
    path: Path, frames: int, names: Sequence[str], files: Sequence[str]
) -> MarkedJoints:
    """The joints in a CSV for footage of so many frames.

    names: the joints of the body plan. files: names of the frames' pictures, or none of a video;
    a row is told by its number, counted from 0, or by its picture's name. Names match by their
    words, in any order: `left front paw` is `front_toe_left`. InputError where none does, or the
    file is of another layout.
    """
    rows = _rows(path)
    heads = {row[0].strip().lower(): row[1:] for row in rows[:5] if row}
    if "bodyparts" not in heads or "coords" not in heads:
        raise InputError(path, "has no rows `bodyparts` and `coords`", _REMEDY)
    if len({name.strip() for name in heads.get("individuals", [])} - {""}) > 1:
        raise InputError(path, "has joints of several animals", "Give those of one alone.")
    first = next(k for k, row in enumerate(rows) if row and row[0].strip().lower() == "coords") + 1
    known = {_words(name): name for name in names}
    places: dict[str, Floats] = {}
    sure: dict[str, Floats] = {}
    unknown: list[str] = []
    numbers = [_frame(path, row, files, frames) for row in rows[first:] if row]
    for column, (part, coord) in enumerate(zip(heads["bodyparts"], heads["coords"], strict=False)):
        name = known.get(_words(part))
        if name is None:
            if part not in unknown:
                unknown.append(part)
            continue
        values = _values(path, rows[first:], column + 1)
        if coord.strip().lower() in ("x", "y"):
            spot = places.setdefault(name, np.full((frames, 2), np.nan))
            spot[numbers, 0 if coord.strip().lower() == "x" else 1] = values
        elif coord.strip().lower() == "likelihood":
            sure.setdefault(name, np.ones(frames))[numbers] = values
    if not places:
        raise InputError(
            path,
            f"names no joint of the body plan (it has {', '.join(unknown[:6])})",
            f"Name them as the plan does: {', '.join(sorted(known.values())[:12])}, ...",
        )
    for name, spot in places.items():
        spot[~np.isfinite(spot).all(axis=1)] = np.nan
        if name in sure:
            spot[sure[name] < _SURE] = np.nan
    return MarkedJoints(places, tuple(unknown))


def _rows(path: Path) -> list[list[str]]:
    try:
        require_file(path, _MOST_BYTES)
        with path.open(encoding="utf-8-sig", newline="") as file:
            return list(csv.reader(file))
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(path, f"is no CSV ({error})", _REMEDY) from error


def _words(name: str) -> frozenset[str]:
    words = re.findall(r"[a-z]+|\d+", name.lower())
    return frozenset(_SAME.get(word, word) for word in words)


def _frame(path: Path, row: list[str], files: Sequence[str], frames: int) -> int:
    told = Path(row[0].strip()).name
    if told in files:
        return files.index(told)
    digits = re.findall(r"\d+", told)
    number = int(digits[-1]) if digits else -1
    if not 0 <= number < frames:
        raise InputError(path, f"has a row of frame {row[0]!r}, of {frames} frames", _REMEDY)
    return number


def _values(path: Path, rows: list[list[str]], column: int) -> Floats:
    try:
        return np.array(
            [
                float(row[column]) if len(row) > column and row[column].strip() else np.nan
                for row in rows
                if row
            ]
        )
    except ValueError as error:
        raise InputError(
            path, f"has no number in column {column + 1} ({error})", _REMEDY
        ) from error
