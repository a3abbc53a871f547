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
from veduta.drive.read.bag import unpack_in_limits
from veduta.drive.read.clocks import clock_apart, shared_beams
from veduta.drive.read.full_scans import read_full
from veduta.drive.read.poses import poses_at, poses_of
from veduta.drive.read.roll import find_roll
from veduta.drive.read.scanned_path import find_path
from veduta.drive.read.shots import shots_of
from veduta.drive.read.spacing import equally_spaced
from veduta.drive.read.spool import SpooledScans
from veduta.drive.read.surface_model import read_heights
from veduta.drive.read.surface_picture import draw_surface
from veduta.drive.record import DriveRecord, Shot, Sweep
from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.names import real_path

LOG = "drive.toml"
_MOST_BYTES = 1 << 20
_CLOCK_SCANS = 20_000
"""Scans at the start of a drive from which clocks are compared."""
_SAME_CLOCK_S = 0.005
_LEVEL_SPACING_M = 1.0
"""Of horizontal scans that fill holes; one sees nearly what the next one sees."""
_SILENT_S = 1.0
"""A scanner that says nothing for longer leaves a gap, and that is said."""


def is_own(folder: Path) -> bool:
    """Whether it has a `drive.toml`."""
    return (folder / LOG).is_file()


def files_elsewhere(folder: Path) -> list[Path]:
    """The files that its `drive.toml` names and that do not lie in it: a bag, a surface model."""
    log = read_toml(folder / LOG)
    named = [folder / one.file for one in (log.bag, log.surface) if one is not None]
    outside = [one for one in named if not real_path(one).is_relative_to(real_path(folder))]
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
        notes += unpack_in_limits(folder, log, log.bag, source)
    else:
        source = folder
    if log.full is not None:
        return read_full(source, log, log.full, seed, tuple(notes))
    if log.vertical is None:
        fault = "names neither a [vertical] scanner nor [full] scans"
        raise InputError(folder / LOG, fault, "docs/drive.md describes both.")
    vertical = SpooledScans(source / log.vertical.table)
    scanner = log.vertical
    corrections: tuple[tuple[float, NDArray[np.float64], str], ...] = ()
    doubts: tuple[str, ...] = ()
    origin, crs = log.origin, log.crs
    if log.path is not None:
        times, poses = poses_of(source / log.path.table)
        path_from = "poses of the log"
    elif log.horizontal is not None:
        level = SpooledScans(source / log.horizontal.table)
        scanner, told_of_clock = _on_one_clock(vertical, level, log.vertical, log.horizontal)
        notes += told_of_clock
        found = find_path(folder, source, log, level, log.horizontal, seed, told)
        times, poses, path_from = found.times_s, found.poses, found.told
        origin, crs, doubts = found.origin_m, found.crs, found.doubts
        corrections = tuple((float(times[row]), move, why) for row, move, why in found.corrected)
        notes += [f"the path comes from {path_from}", *found.notes]
        if log.camera is not None:
            poses, told_of_roll = _leaning(source, log.camera, times, poses)
            notes.append(told_of_roll)
    else:
        fault = "names neither a [path] nor a [horizontal] scanner"
        raise InputError(folder / LOG, fault, "Give poses, or scans to find them from.")
    sweeps, left_out = _sweeps(vertical, source / scanner.table, scanner, times, poses, spacing_m)
    notes += left_out
    level_sweeps = _level_sweeps(source, log.horizontal, times, poses)
    shots: tuple[Shot, ...] = ()
    if log.camera is not None:
        shots, missing = shots_of(source, log.camera, times, poses)
        notes += missing
    height_m = float(scanner.vehicle_from_scanner[11])
    return DriveRecord(
        log.name, sweeps, shots, log.path is not None, height_m, False, crs, origin, tuple(notes),
        path_from, corrections, doubts,
        None if log.surface is None else partial(read_heights, folder / log.surface.file, origin),
        None if log.surface is None else partial(draw_surface, folder / log.surface.file, origin),
        log.vertical_datum, level_sweeps,
    )  # fmt: skip


def _leaning(
    source: Path,
    camera: CameraMount,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
) -> tuple[NDArray[np.float64], str]:
    """Poses (p, 3, 4) with the roll that images tell, and a note of it; where they tell none, the
    same ones.
    """
    shots, _ = shots_of(source, camera, times, poses)
    ahead = poses_at(np.array([shot.time_s for shot in shots]), times, poses)[:, :3, 0]
    roll = find_roll(shots, ahead)
    if roll is None:
        return poses, "too few images show upright edges: the vehicle is taken not to lean"
    typical = np.rad2deg(np.sqrt((roll.roll_rad**2).mean()))
    count = f"{len(roll.times_s)} of {roll.looked} images"
    note = f"roll comes from upright edges in {count}: {typical:.1f} degrees typically"
    return roll.onto(times, poses), note


def _on_one_clock(
    vertical: SpooledScans, level: SpooledScans, scanner: Scanner, other: Scanner
) -> tuple[Scanner, list[str]]:
    """The vertical scanner with its clock set by the horizontal one's, where both share a beam;
    and a note where it was.
    """
    beams = shared_beams(scanner, vertical.beams, other, level.beams)
    if beams is None:
        return scanner, []
    series = []
    for scans, own, beam in ((vertical, scanner, beams[0]), (level, other, beams[1])):
        rows = scans.order[:_CLOCK_SCANS].tolist()
        ranges = np.array([scans.ranges(row)[beam] for row in rows], dtype=np.float64)
        series.append((scans.times_s[rows] + own.clock_offset_s, ranges))
    apart = clock_apart(*series[0], *series[1])
    if apart is None or abs(apart) < _SAME_CLOCK_S:
        return scanner, []
    note = (
        f"the clock of the vertical scanner is {1000 * abs(apart):.0f} ms"
        f" {'behind' if apart > 0.0 else 'ahead of'} that of the horizontal one: it was set"
    )
    offset = scanner.clock_offset_s + apart
    return scanner.model_copy(update={"clock_offset_s": offset}), [note]


def read_toml(path: Path) -> DriveLog:
    """The description of a log, checked."""
    if path.stat().st_size > _MOST_BYTES:
        raise InputError(path, "is far too large", "It describes a log; scans are in tables.")
    try:
        return DriveLog.model_validate(tomllib.loads(path.read_text(encoding="utf-8")))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(path, f"is no TOML: {error}", "Mend it.") from error
    except ValidationError as error:
        raise InputError(path, first_fault(error), "docs/drive.md describes it.") from error


def _level_sweeps(
    source: Path,
    scanner: Scanner | None,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
) -> tuple[Sweep, ...]:
    """The horizontal scans, a metre apart; none of a log without that scanner."""
    if scanner is None or not (source / scanner.table).is_file():
        return ()
    scans = SpooledScans(source / scanner.table)
    table = source / scanner.table
    sweeps, _ = _sweeps(scans, table, scanner, times, poses, _LEVEL_SPACING_M)
    return sweeps


def _sweeps(
    scans: SpooledScans,
    path: Path,
    scanner: Scanner,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
    spacing_m: float,
) -> tuple[tuple[Sweep, ...], list[str]]:
    """The scans within the times of the path, thinned; and notes of what is left out."""
    notes: list[str] = []
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
    places = poses_at(own[order], times, poses) @ mount
    kept = equally_spaced(places[:, :3, 3], spacing_m)
    if len(kept) < len(order):
        notes.append(f"{len(kept)} of {len(order)} vertical scans are used: {spacing_m} m apart")
    angles = scanner.first_beam_rad + np.arange(scans.beams) * scanner.beam_step_rad
    beams = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    sweeps = tuple(
        Sweep(f"{row:06d}", float(own[row]), place, _reader(scans, row, beams, scanner))
        for row, place in zip(order[kept].tolist(), places[kept], strict=True)
    )
    return sweeps, notes


def _reader(
    scans: SpooledScans, row: int, beams: NDArray[np.float64], scanner: Scanner
) -> Callable[[], NDArray[np.float64]]:
    def read() -> NDArray[np.float64]:
        ranges = scans.ranges(row)
        with np.errstate(invalid="ignore"):
            kept = (ranges >= scanner.nearest_m) & (ranges < scanner.farthest_m)
        return np.asarray(beams[kept] * ranges[kept, None], dtype=np.float64)

    return read
