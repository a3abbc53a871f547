"""Logs with a `drive.toml`: vertical 2D scans and images in Parquet tables, with poses."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.compute
import pyarrow.parquet
from numpy.typing import NDArray
from pydantic import ValidationError

from veduta.drive.document.log import CameraMount, DriveLog, Scanner
from veduta.drive.record import DriveRecord, Shot, Sweep
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

LOG = "drive.toml"
_MOST_BYTES = 1 << 20
_LARGEST_TABLE_BYTES = 4 << 30
"""Of a table on disk: hours of scans."""
_LONGEST_NAME, _LONGEST_PATH = 255, 1024
_SILENT_S = 1.0
"""A scanner that says nothing for longer leaves a gap, and that is said."""


def is_own(folder: Path) -> bool:
    """Whether it has a `drive.toml`."""
    return (folder / LOG).is_file()


def read_own(folder: Path) -> DriveRecord:
    """The drive of a folder. InputError names the file and what is wrong with it."""
    log = read_toml(folder / LOG)
    if log.path is None:
        fault = "names no [path]"
        raise InputError(folder / LOG, fault, "Give poses: 2D scans are not localised yet.")
    times, poses = _poses(folder / log.path.table)
    notes: list[str] = []
    sweeps = _sweeps(folder / log.vertical.table, log.vertical, times, poses, notes)
    shots: tuple[Shot, ...] = ()
    if log.camera is not None:
        shots = _shots(folder, log.camera, times, poses, notes)
    height_m = float(log.vertical.vehicle_from_scanner[11])
    return DriveRecord(
        log.name, sweeps, shots, True, height_m, False, log.crs, log.origin, tuple(notes)
    )


def read_toml(path: Path) -> DriveLog:
    """The description of a log, checked."""
    if path.stat().st_size > _MOST_BYTES:
        raise InputError(path, "is far too large", "It describes a log; scans are in tables.")
    try:
        return DriveLog.model_validate(tomllib.loads(path.read_text(encoding="utf-8")))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(path, f"is no TOML: {error}", "Mend it.") from error
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(word) for word in first["loc"]) or "the file"
        raise InputError(path, f"{place}: {first['msg']}", "docs/drive.md describes it.") from error


def _table(path: Path, names: tuple[str, ...]) -> pyarrow.Table:
    if not path.is_file():
        raise InputError(path, "there is no such file", f"{LOG} names it: put it there.")
    require_file(path, _LARGEST_TABLE_BYTES)
    try:
        table = pyarrow.parquet.read_table(path)
    except (pyarrow.ArrowException, OSError) as error:
        raise InputError(path, "is no Parquet table that can be read", "Copy it again.") from error
    for name in names:
        count = table.column_names.count(name)
        if count != 1:
            fault = f"has {count or 'no'} column{'s' if count else ''} {name!r}"
            raise InputError(path, fault, "docs/drive.md lists them.")
    return table


def _lists(path: Path, table: pyarrow.Table, name: str) -> NDArray[np.float64]:
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


def _times(path: Path, table: pyarrow.Table) -> NDArray[np.float64]:
    kind = table.schema.field("time_s").type
    if not _is_number(kind):
        fault = f"has {kind} and not numbers in 'time_s'"
        raise InputError(path, fault, "Write seconds as floats.")
    times = np.asarray(table["time_s"].to_numpy(), dtype=np.float64)
    if not np.isfinite(times).all():
        raise InputError(path, "has a time that is no number", "Leave that row out.")
    return times


def _poses(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(p,) times in ascending order and (p, 3, 4) world_from_vehicle."""
    table = _table(path, ("time_s", "matrix"))
    times, rows = _times(path, table), _lists(path, table, "matrix")
    if rows.shape[1:] != (12,) or len(rows) < 2 or not np.isfinite(rows).all():
        fault = "has not two poses of twelve numbers"
        raise InputError(path, fault, "Each is a 3x4 matrix by rows.")
    order = np.argsort(times, kind="stable")
    return times[order], rows[order].reshape(-1, 3, 4)


def _at(
    wanted: NDArray[np.float64], times: NDArray[np.float64], poses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n, 4, 4) the poses at some times: positions linearly, turns along the chord."""
    after = np.clip(np.searchsorted(times, wanted), 1, len(times) - 1)
    span = np.maximum(times[after] - times[after - 1], 1e-9)
    share = np.clip((wanted - times[after - 1]) / span, 0.0, 1.0)[:, None, None]
    mixed = (1.0 - share) * poses[after - 1] + share * poses[after]
    left, _, right = np.linalg.svd(mixed[:, :, :3])
    found = np.tile(np.eye(4), (len(wanted), 1, 1))
    found[:, :3, :3] = left @ right
    found[:, :3, 3] = mixed[:, :, 3]
    return found


def _is_name(name: str) -> bool:
    """Whether a file may be called so: the system refuses to look for other names."""
    own = name.encode("utf-8", "replace")
    longest = max(len(part) for part in own.split(b"/"))
    return longest <= _LONGEST_NAME and len(own) <= _LONGEST_PATH and b"\0" not in own


def _sweeps(
    path: Path,
    scanner: Scanner,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
    notes: list[str],
) -> tuple[Sweep, ...]:
    table = _table(path, ("time_s", "ranges_m"))
    if not len(table):
        raise InputError(path, "has no scans", "Give a scan in each row.")
    own = _times(path, table) + scanner.clock_offset_s
    ranges = _lists(path, table, "ranges_m").astype(np.float32)
    order = np.argsort(own, kind="stable")
    inside = (own[order] >= times[0]) & (own[order] <= times[-1])
    if not inside.any():
        fault = "has no scan within the times of the path"
        raise InputError(path, fault, "Check clock_offset_s.")
    if not inside.all():
        notes.append(f"{int((~inside).sum())} scans before or after the path are left out")
    order = order[inside]
    silent = np.diff(own[order])
    for gap in np.flatnonzero(silent > _SILENT_S).tolist():
        notes.append(f"the vertical scanner is silent for {silent[gap]:.1f} s")
    mount = np.vstack([np.reshape(scanner.vehicle_from_scanner, (3, 4)), [0.0, 0.0, 0.0, 1.0]])
    places = _at(own[order], times, poses) @ mount
    angles = scanner.first_beam_rad + np.arange(ranges.shape[1]) * scanner.beam_step_rad
    beams = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    return tuple(
        Sweep(f"{row:06d}", float(own[row]), place, _reader(ranges[row], beams, scanner))
        for row, place in zip(order.tolist(), places, strict=True)
    )


def _reader(
    ranges: NDArray[np.float32], beams: NDArray[np.float64], scanner: Scanner
) -> Callable[[], NDArray[np.float64]]:
    def read() -> NDArray[np.float64]:
        with np.errstate(invalid="ignore"):
            kept = (ranges >= scanner.nearest_m) & (ranges < scanner.farthest_m)
        return np.asarray(beams[kept] * ranges[kept, None], dtype=np.float64)

    return read


def _shots(
    folder: Path,
    camera: CameraMount,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
    notes: list[str],
) -> tuple[Shot, ...]:
    path = folder / camera.table
    table = _table(path, ("time_s", "file"))
    own = _times(path, table) + camera.clock_offset_s
    mount = np.vstack([np.reshape(camera.vehicle_from_camera, (3, 4)), [0.0, 0.0, 0.0, 1.0]])
    places = _at(own, times, poses) @ mount
    shots, missing = [], 0
    for name, time_s, place in zip(table["file"].to_pylist(), own, places, strict=True):
        if not _is_name(str(name)):
            raise InputError(path, "has a name that no file has", "Give the images' names.")
        file = (folder / str(name)).resolve()
        if not file.is_relative_to(folder.resolve()):
            fault = f"names an image outside of the folder ({name})"
            raise InputError(path, fault, "Put the images beside the table.")
        if not file.is_file():
            missing += 1
            continue
        shots.append(
            Shot(
                file.stem, file, float(time_s), camera.width_px, camera.height_px,
                camera.focal_px, camera.centre_px, place,
            )
        )  # fmt: skip
    if missing:
        notes.append(f"{missing} of {len(own)} images are missing")
    return tuple(shots)
