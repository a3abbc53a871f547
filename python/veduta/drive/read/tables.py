"""Parquet tables of a log: columns checked before they are used, rows read as they are needed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.compute
import pyarrow.parquet
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_LARGEST_TABLE_BYTES = 4 << 30
"""Of a table on disk: hours of scans."""


@contextmanager
def open_table(path: Path, names: tuple[str, ...]) -> Iterator[pyarrow.parquet.ParquetFile]:
    """A table that has each of these columns once. InputError where there is none."""
    if not path.is_file():
        raise InputError(path, "there is no such file", "drive.toml names it: put it there.")
    require_file(path, _LARGEST_TABLE_BYTES)
    try:
        table = pyarrow.parquet.ParquetFile(path)
    except (pyarrow.ArrowException, OSError) as error:
        raise InputError(path, "is no Parquet table that can be read", "Copy it again.") from error
    with table:
        for name in names:
            count = table.schema_arrow.names.count(name)
            if count != 1:
                fault = f"has {count or 'no'} column{'s' if count else ''} {name!r}"
                raise InputError(path, fault, "docs/drive.md lists them.")
        yield table


def read_table(path: Path, names: tuple[str, ...]) -> pyarrow.Table:
    """The columns of these names, all rows. InputError where there is no such table."""
    with open_table(path, names) as table:
        try:
            return table.read(columns=list(names))
        except (pyarrow.ArrowException, OSError) as error:
            fault = "is a Parquet table that breaks off"
            raise InputError(path, fault, "Copy it again.") from error


def list_column(path: Path, table: pyarrow.Table, name: str) -> NDArray[np.float64]:
    """(rows, n) a column of lists of numbers, all of one length."""
    kind = table.schema.field(name).type
    if not (_is_list(kind) and _is_number(kind.value_type)):
        fault = f"has {kind} and not lists of numbers in {name!r}"
        raise InputError(path, fault, "Write lists of floats.")
    column = table[name]
    if column.null_count:
        raise InputError(path, f"has rows without {name!r}", "Leave those rows out.")
    lengths = pyarrow.compute.list_value_length(column).to_numpy()
    if len(lengths) and (lengths != lengths[0]).any():
        fault = f"has lists of different lengths in {name!r}"
        raise InputError(path, fault, "Each row needs one value for each beam.")
    values = pyarrow.compute.list_flatten(column).to_numpy().astype(np.float64)
    shape = (len(table), int(lengths[0]) if len(lengths) else 0)
    return np.asarray(values.reshape(shape), dtype=np.float64)


def _is_list(kind: pyarrow.DataType) -> bool:
    types = pyarrow.types
    return bool(types.is_list(kind) or types.is_large_list(kind) or types.is_fixed_size_list(kind))


def _is_number(kind: pyarrow.DataType) -> bool:
    return bool(pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind))


def time_column(path: Path, table: pyarrow.Table) -> NDArray[np.float64]:
    """(rows,) seconds of `time_s`, all finite."""
    kind = table.schema.field("time_s").type
    if not _is_number(kind):
        fault = f"has {kind} and not numbers in 'time_s'"
        raise InputError(path, fault, "Write seconds as floats.")
    times = np.asarray(table["time_s"].to_numpy(), dtype=np.float64)
    if not np.isfinite(times).all():
        raise InputError(path, "has a time that is no number", "Leave that row out.")
    return times
