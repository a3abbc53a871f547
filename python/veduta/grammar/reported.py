"""What rules say of a building with `report`: sums by key, for attributes, a table and the report.

The engine sums the numbers of a key in a building, and keeps the last of all other values.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from veduta.grammar.outline import Attribute

FILE = "reports.csv"
MAX_KEYS = 200
"""Keys that the report sums, and columns of the table: rules may compute names without end."""
OWN = ("id", "name")

Values = dict[str, Attribute]


@dataclass(frozen=True)
class Sum:
    """The numbers of one key over buildings."""

    buildings: int
    total: float
    least: float
    most: float

    def __add__(self, other: Sum) -> Sum:
        return Sum(
            self.buildings + other.buildings,
            self.total + other.total,
            min(self.least, other.least),
            max(self.most, other.most),
        )


def values_of(reports: Iterable[tuple[str, Attribute]]) -> Values:
    """The values of a building; a number that is none (infinite, or no number) as its text."""
    found: Values = {}
    for key, value in reports:
        is_number = isinstance(value, float) and math.isfinite(value)
        found[key] = value if is_number or not isinstance(value, float) else str(value)
    return found


def as_attributes(values: Mapping[str, Attribute], taken: Iterable[str]) -> Values:
    """The values under names that are not taken: `report.KEY` where KEY is."""
    names = set(taken)
    return {f"report.{key}" if key in names else key: value for key, value in values.items()}


def sums_of(rows: Iterable[Mapping[str, Attribute]]) -> dict[str, Sum]:
    """The numbers of each key over buildings, in the order of the keys' first values."""
    values = (item for row in rows for item in row.items())
    return _added((key, Sum(1, one, one, one)) for key, one in values if isinstance(one, float))


def joined(blocks: Iterable[Mapping[str, Mapping[str, Any]]]) -> dict[str, Sum]:
    """The sums of several blocks, from `as_json`."""
    return _added((key, Sum(**one)) for block in blocks for key, one in block.items())


def _added(sums: Iterable[tuple[str, Sum]]) -> dict[str, Sum]:
    """One sum for each of the first keys."""
    found: dict[str, Sum] = {}
    for key, one in sums:
        if key in found:
            found[key] += one
        elif len(found) < MAX_KEYS:
            found[key] = one
    return found


def as_json(sums: Mapping[str, Sum]) -> dict[str, dict[str, Any]]:
    """For records and `report.json`."""
    return {key: asdict(one) for key, one in sums.items()}


def table(rows: Sequence[tuple[str, str, Values]]) -> bytes | None:
    """A row for each building (id, name, values) that reported something, as CSV; None without any.

    Keys are columns in the order of their first values.
    """
    columns = list(dict.fromkeys(key for _, _, values in rows for key in values))[:MAX_KEYS]
    if not columns:
        return None
    text = io.StringIO()
    write = csv.writer(text, lineterminator="\n")
    write.writerow([*OWN, *columns])
    for building, name, values in rows:
        if values:
            write.writerow([building, name, *(_cell(values.get(key)) for key in columns)])
    return text.getvalue().encode()


def write_joined(path: Path, tables: Sequence[Path]) -> None:
    """One table of several, a row at a time in memory; nothing where they have no columns."""
    columns: dict[str, None] = {}
    for one in tables:
        columns.update(dict.fromkeys(next(_rows(one), [])[len(OWN) :]))
    if not columns:
        return
    kept = list(columns)[:MAX_KEYS]
    with path.open("w", encoding="utf-8", newline="") as out:
        write = csv.writer(out, lineterminator="\n")
        write.writerow([*OWN, *kept])
        for one in tables:
            rows = _rows(one)
            own = next(rows, [])
            for row in rows:
                cells = dict(zip(own, row, strict=False))
                write.writerow([cells.get(key, "") for key in (*OWN, *kept)])


def _rows(path: Path) -> Iterator[list[str]]:
    """The rows of a table that somebody may have edited."""
    with path.open(encoding="utf-8", errors="replace", newline="") as lines:
        yield from csv.reader(lines)


def _cell(value: Attribute | None) -> str:
    """A number without more digits than it has; truth as rule files write it."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.12g}" if isinstance(value, float) else value
