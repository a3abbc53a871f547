"""Logs with a `drive.toml`: scans of 2D scanners and images in Parquet tables."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from veduta.drive.document.log import CameraMount, DriveLog, Scanner
from veduta.drive.read.bag import unpack_bag
from veduta.drive.read.clocks import clock_apart, shared_beams
from veduta.drive.read.scanned_path import find_path
from veduta.drive.read.spacing import equally_spaced
from veduta.drive.read.spool import SpooledScans
from veduta.drive.read.surface_model import read_heights
from veduta.drive.read.tables import list_column, read_table, time_column
from veduta.drive.record import DriveRecord, Shot, Sweep
from veduta.run.errors import InputError

LOG = "drive.toml"
_MOST_BYTES = 1 << 20
_LONGEST_NAME, _LONGEST_PATH = 255, 1024
_CLOCK_SCANS = 20_000
"""Scans at the start of a drive from which clocks are compared."""
_SAME_CLOCK_S = 0.005
_SILENT_S = 1.0
"""A scanner that says nothing for longer leaves a gap, and that is said."""


def is_own(folder: Path) -> bool:
    """Whether it has a `drive.toml`."""
    return (folder / LOG).is_file()


def files_elsewhere(folder: Path) -> list[Path]:
    """The files that its `drive.toml` names and that do not lie in it: a bag, a surface model."""
    log = read_toml(folder / LOG)
    named = [folder / one.file for one in (log.bag, log.surface) if one is not None]
    outside = [one for one in named if not one.resolve().is_relative_to(folder.resolve())]
    return sorted(
        path
        for one in outside
        for path in (one.iterdir() if one.is_dir() else [one])
        if path.is_file()
    )


def read_own(
    folder: Path,
    seed: int = 1,
    spacing_m: float = 0.0,
    told: Callable[[float], None] = lambda share: None,
    scratch: Path | None = None,
) -> DriveRecord:
    """The drive of a folder. scratch: where a bag is unpacked; it must stay. Vertical scans are
    thinned to a spacing; of a stop one stays.

    InputError names the file and what is wrong with it; NotFoundError says why there is no path.
    """
    log = read_toml(folder / LOG)
    notes: list[str] = []
    if log.bag is not None:
        if scratch is None:
            fault = "names a bag, and there is no place to unpack it"
            raise InputError(folder / LOG, fault, "Read it through `veduta drive`.")
        source = scratch
        notes += unpack_bag(folder, log, log.bag, source, told)
    else:
        source = folder
    vertical = SpooledScans(source / log.vertical.table)
    scanner = log.vertical
    corrections: tuple[tuple[float, NDArray[np.float64], str], ...] = ()
    doubts: tuple[str, ...] = ()
    origin, crs = log.origin, log.crs
    if log.path is not None:
        times, poses = _poses(source / log.path.table)
        path_from = "poses of the log"
    elif log.horizontal is not None:
        level = SpooledScans(source / log.horizontal.table)
        scanner = _on_one_clock(vertical, level, log.vertical, log.horizontal, notes)
        found = find_path(folder, source, log, level, log.horizontal, seed, told)
        times, poses, path_from = found.times_s, found.poses, found.told
        origin, crs, doubts = found.origin_m, found.crs, found.doubts
        corrections = tuple((float(times[row]), move, why) for row, move, why in found.corrected)
        notes += [f"the path comes from {path_from}", *found.notes]
    else:
        fault = "names neither a [path] nor a [horizontal] scanner"
        raise InputError(folder / LOG, fault, "Give poses, or scans to find them from.")
    sweeps = _sweeps(vertical, source / scanner.table, scanner, times, poses, spacing_m, notes)
    shots: tuple[Shot, ...] = ()
    if log.camera is not None:
        shots = _shots(source, log.camera, times, poses, notes)
    height_m = float(scanner.vehicle_from_scanner[11])
    return DriveRecord(
        log.name, sweeps, shots, log.path is not None, height_m, False, crs, origin, tuple(notes),
        path_from, corrections, doubts,
        None if log.surface is None else partial(read_heights, folder / log.surface.file, origin),
    )  # fmt: skip


def _on_one_clock(
    vertical: SpooledScans, level: SpooledScans, scanner: Scanner, other: Scanner, notes: list[str]
) -> Scanner:
    """The vertical scanner with its clock set by the horizontal one's, where both share a beam."""
    beams = shared_beams(scanner, vertical.beams, other, level.beams)
    if beams is None:
        return scanner
    series = []
    for scans, own, beam in ((vertical, scanner, beams[0]), (level, other, beams[1])):
        rows = scans.order[:_CLOCK_SCANS].tolist()
        ranges = np.array([scans.ranges(row)[beam] for row in rows], dtype=np.float64)
        series.append((scans.times_s[rows] + own.clock_offset_s, ranges))
    apart = clock_apart(*series[0], *series[1])
    if apart is None or abs(apart) < _SAME_CLOCK_S:
        return scanner
    notes.append(
        f"the clock of the vertical scanner is {1000 * abs(apart):.0f} ms"
        f" {'behind' if apart > 0.0 else 'ahead of'} that of the horizontal one: it was set"
    )
    return scanner.model_copy(update={"clock_offset_s": scanner.clock_offset_s + apart})


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


def _poses(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(p,) times in ascending order and (p, 3, 4) world_from_vehicle."""
    table = read_table(path, ("time_s", "matrix"))
    times, rows = time_column(path, table), list_column(path, table, "matrix")
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
    scans: SpooledScans,
    path: Path,
    scanner: Scanner,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
    spacing_m: float,
    notes: list[str],
) -> tuple[Sweep, ...]:
    own = scans.times_s + scanner.clock_offset_s
    order = scans.order
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
    kept = equally_spaced(places[:, :3, 3], spacing_m)
    if len(kept) < len(order):
        notes.append(f"{len(kept)} of {len(order)} vertical scans are used: {spacing_m} m apart")
    angles = scanner.first_beam_rad + np.arange(scans.beams) * scanner.beam_step_rad
    beams = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    return tuple(
        Sweep(f"{row:06d}", float(own[row]), place, _reader(scans, row, beams, scanner))
        for row, place in zip(order[kept].tolist(), places[kept], strict=True)
    )


def _reader(
    scans: SpooledScans, row: int, beams: NDArray[np.float64], scanner: Scanner
) -> Callable[[], NDArray[np.float64]]:
    def read() -> NDArray[np.float64]:
        ranges = scans.ranges(row)
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
    table = read_table(path, ("time_s", "file"))
    own = time_column(path, table) + camera.clock_offset_s
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
