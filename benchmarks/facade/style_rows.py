"""Rows of a benchmark that goes on where it was stopped: one a line in a file."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from pathlib import Path

from veduta.facade.style.infer import Candidate, StyleFound, log_mass
from veduta.facade.style.likelihood import parts_of

Row = dict[str, str | int | float | bool | None]


UNTOLD = ("logs",)
"""Columns that are kept in the file of rows alone."""


def rows_of(
    path: Path | None, keys: Iterable[str], make: Callable[[str], Row], most: int | None = None
) -> list[Row]:
    """A row for each key: from the file where it has one, else made and appended to it.

    most: no more than so many are made; the others are left out.
    """
    known: dict[str, Row] = {}
    if path is not None and path.exists():
        known = dict(json.loads(line) for line in path.read_text("utf-8").splitlines())
    found, made = [], 0
    for key in keys:
        if key not in known:
            if most is not None and made >= most:
                continue
            made += 1
            known[key] = make(key)
            print(known[key], flush=True)
            if path is not None:
                with path.open("a", encoding="utf-8") as file:
                    file.write(json.dumps([key, known[key]]) + "\n")
        found.append(known[key])
    return found


def logs_of(found: StyleFound) -> str:
    """Of each candidate: ln likelihood and ln prior mass of its best structure, what of the
    likelihood is of cells and of elements, and ln likelihood and cost of it deformed; under `any`
    the most that labels of cells can have, and how many elements were seen.
    """
    observed = found.chosen.posterior.observed
    rows: dict[str, tuple[float, ...]] = {
        one.name: (
            round(one.best.log_likelihood, 3),
            round(log_mass(one.posterior.grammar, one.best), 3),
            *(round(part, 3) for part in parts_of(one.best.front, observed)),
            *_real(one),
        )
        for one in found.candidates
    }
    most = float(observed.ratios.max(axis=0).sum())
    rows["any"] = (round(most, 3), float(sum(len(boxes) for boxes in observed.boxes.values())))
    return json.dumps(rows)


def _real(one: Candidate) -> tuple[float, ...]:
    if one.real is None:
        return ()
    return round(one.real.log_likelihood, 3), round(one.real.log_cost, 3)


def told(rows: Iterable[Row]) -> list[Row]:
    """The rows as they are recorded."""
    return [{key: value for key, value in row.items() if key not in UNTOLD} for row in rows]
