"""Joints that somebody has marked or tracked: a CSV in the layout of DeepLabCut."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

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


@dataclass(frozen=True, eq=False)
class _Table:
    """A CSV's rows of places. label: what each is called by. columns: (t, c) numbers, NaN where
    there is none. parts, coords: (c,) what the columns are of.
    """

    label: list[str]
    columns: Floats
    parts: list[str]
    coords: list[str]


def read_joints(
    path: Path, frames: int, names: Sequence[str], files: Sequence[str],
    individual: str | None = None,
) -> MarkedJoints:  # fmt: skip
    """The joints in a CSV for footage of so many frames.

    names: the joints of the body plan. files: names of the frames' pictures, or none of a video;
    a row is told by its number, counted from 0, or by its picture's name. Names match by their
    words, in any order: `left front paw` is `front_toe_left`. individual: which animal of a file
    with several. InputError where no name matches, or the file is of another layout.
    """
    table = _table(path, individual)
    known = {_words(name): name for name in names}
    places: dict[str, Floats] = {}
    sure: dict[str, Floats] = {}
    unknown: list[str] = []
    numbers = [_frame(path, label, files, frames) for label in table.label]
    for column, (part, coord) in enumerate(zip(table.parts, table.coords, strict=True)):
        name = known.get(_words(part))
        if name is None:
            if part not in unknown:
                unknown.append(part)
            continue
        values = table.columns[:, column]
        if coord in ("x", "y"):
            spot = places.setdefault(name, np.full((frames, 2), np.nan))
            spot[numbers, 0 if coord == "x" else 1] = values
        elif coord == "likelihood":
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


def _table(path: Path, individual: str | None) -> _Table:
    """The rows and columns of one animal. Its index is one column, or folder, video and picture."""
    rows = [row for row in _rows(path) if row]
    heads = {row[0].strip().lower(): row for row in rows[:5]}
    if "bodyparts" not in heads or "coords" not in heads:
        raise InputError(path, "has no rows `bodyparts` and `coords`", _REMEDY)
    coords = [cell.strip().lower() for cell in heads["coords"]]
    index = next((k for k, cell in enumerate(coords) if k and cell), len(coords))
    chosen = list(range(index, min(len(coords), len(heads["bodyparts"]))))
    whose = [cell.strip() for cell in heads.get("individuals", [])]
    several = sorted(set(whose[index:]) - {""})
    if individual is not None and individual not in several:
        fault = (
            f"has no animal {individual!r} (it has {', '.join(several) or 'one without a name'})"
        )
        raise InputError(path, fault, "Name one that it has (--individual).")
    if individual is None and len(several) > 1:
        fault = f"has joints of several animals: {', '.join(several[:6])}"
        raise InputError(path, fault, "Name one of them (--individual).")
    if individual is not None:
        chosen = [k for k in chosen if k < len(whose) and whose[k] == individual]
    first = next(k for k, row in enumerate(rows) if row[0].strip().lower() == "coords") + 1
    label = [next((cell for cell in row[:index][::-1] if cell.strip()), "") for row in rows[first:]]
    columns = [_values(path, rows[first:], k) for k in chosen]
    return _Table(
        label,
        np.stack(columns, axis=1) if columns else np.zeros((len(label), 0)),
        [heads["bodyparts"][k] for k in chosen],
        [coords[k] for k in chosen],
    )


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


def _frame(path: Path, label: str, files: Sequence[str], frames: int) -> int:
    told = Path(label.strip()).name
    if told in files:
        return files.index(told)
    digits = re.findall(r"\d+", told)
    number = int(digits[-1]) if digits else -1
    if not 0 <= number < frames:
        raise InputError(path, f"has a row of frame {label!r}, of {frames} frames", _REMEDY)
    return number


def _values(path: Path, rows: list[list[str]], column: int) -> Floats:
    try:
        return np.array(
            [
                float(row[column]) if len(row) > column and row[column].strip() else np.nan
                for row in rows
            ]
        )
    except ValueError as error:
        raise InputError(
            path, f"has no number in column {column + 1} ({error})", _REMEDY
        ) from error


def written_joints(
    px: Mapping[str, Floats], trust: Mapping[str, Floats], number: NDArray[np.int64]
) -> str:
    """The joints as a CSV in the same layout, a row for each frame, by its number; gaps stay.

    px: (t, 2), trust: (t,) by joint; what is trusted by less than 1 was not marked, and its
    likelihood is one that is left out where the file is read again.
    """
    names = sorted(px)
    heads = [
        ["scorer", *["veduta"] * (3 * len(names))],
        ["bodyparts", *[name for name in names for _ in range(3)]],
        ["coords", *["x", "y", "likelihood"] * len(names)],
    ]
    likely = {name: np.where(trust[name] < 1.0, 0.9 * _SURE * trust[name], 1.0) for name in names}
    columns = [column for name in names for column in (*px[name].T, likely[name])]
    gap = np.repeat([~np.isfinite(px[name][:, 0]) for name in names], 3, axis=0)
    rows = [
        [str(int(frame)), *(
            "" if none[row] else f"{column[row]:.2f}"
            for column, none in zip(columns, gap, strict=True)
        )]
        for row, frame in enumerate(number)
    ]  # fmt: skip
    return "\n".join(",".join(row) for row in [*heads, *rows]) + "\n"
