"""The object as a row of a catalogue, for `veduta plan --catalogue`."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROW = "object.sql"


def write_row(
    path: Path, name: str, model: str, size_m: NDArray[np.float64], in_metres: bool
) -> None:
    """An INSERT for the table `object`: an ornament that may stand on things.

    Without metres the row is a comment, for sizes of a catalogue are metres.
    """
    plain = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-") or "object"
    width, depth, height = (max(round(float(one), 4), 0.001) for one in size_m)
    values = f"'{plain}', 'ornament', 'decoration', '{model}', {width}, {depth}, {height}, 'things'"
    lines = [
        "-- For `veduta plan --catalogue`: change type and class to what it is.",
        "INSERT INTO object (name, type, class, file, width_m, depth_m, height_m, stands)",
        f"VALUES ({values});",
    ]
    if not in_metres:
        why = "-- The cameras had no scale: give --metres-per-unit, or the sizes in metres here."
        lines = [why, *(f"-- {line.removeprefix('-- ')}" for line in lines)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
