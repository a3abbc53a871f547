"""The path of a log without poses, from its horizontal scans (section 2).

Scans are matched into a chain, loops are closed, and, where a surface model is given, the drive is
found in it and gets its height and pitch from the ground there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pyproj import Transformer
from pyproj.exceptions import CRSError
from scipy import ndimage

from veduta.drive.document.log import DriveLog, Scanner, Surface
from veduta.drive.read.localise import LocaliseParameters, localise
from veduta.drive.read.loops import close_loops
from veduta.drive.read.scan_chain import ScanChain, chain_scans
from veduta.drive.read.spool import SpooledScans
from veduta.drive.read.surface_model import SurfaceModel, read_surface_model
from veduta.drive.read.tables import read_table, time_column
from veduta.geometry.crs import horizontal
from veduta.run.errors import InputError, NotFoundError
from veduta.run.names import real_path

Floats = NDArray[np.float64]
_SLOPE_M = 10.0
"""Heights of the ground along the path are those of a stretch so long."""
_FEWEST_MATCHED = 0.5
_SURE_FIT = 0.8
"""Share of points on edges: five of the six wrong places that were followed in the Delft tile had
less (`benchmarks/results/drive-localise-delft.md`)."""
_LEAST_MARGIN = 0.1
"""Share of a path's fit that no place around has. Ten synthetic streets had 0.05 to 0.36 in
their own models; what has less than `LocaliseParameters.least_margin` is refused."""
_GPS_M = 15.0
"""How far off a GPS may be between buildings."""


@dataclass(frozen=True, eq=False)
class ScannedPath:
    """times_s: (p,). poses: (p, 3, 4) world_from_vehicle. origin_m: of the world in `crs`.

    corrected: (row of `times_s`, metres moved (3,), why). told: how it was found; notes: of faults;
    doubts: why it may be wrong.
    """

    times_s: Floats
    poses: Floats
    origin_m: tuple[float, float, float]
    crs: str | None
    corrected: tuple[tuple[int, Floats, str], ...]
    told: str
    notes: tuple[str, ...]
    doubts: tuple[str, ...] = ()


def find_path(
    folder: Path,
    source: Path,
    log: DriveLog,
    scans: SpooledScans,
    scanner: Scanner,
    seed: int,
    told: Callable[[float], None] = lambda share: None,
) -> ScannedPath:
    """source: where the tables lie. NotFoundError where scans do not match, or the drive is not in
    the surface model.
    """
    times = scans.times_s[scans.order] + scanner.clock_offset_s
    chain = chain_scans(_points(scans, scanner, told))
    if len(chain.lost) > _FEWEST_MATCHED * len(times):
        evidence = f"{len(chain.lost)} of {len(times)} horizontal scans match none before them"
        raise NotFoundError("the path", evidence, "Check the scanner's beams and its mount.")
    notes = []
    if chain.lost:
        notes.append(f"{len(chain.lost)} of {len(times)} horizontal scans match none before them")
    closed, loops = close_loops(chain)
    how = f"matching {len(times)} horizontal scans"
    how += f", {len(loops)} closed loops" if loops else ""
    if log.surface is None:
        poses = chain.all_poses(closed)
        moved = closed[:, :2] - chain.poses[:, :2]
        corrected = _corrections(chain, moved, "a loop was closed")
        flat = np.zeros(len(poses))
        return ScannedPath(
            times, _matrices(poses, flat, flat), log.origin, log.crs,
            corrected, how, tuple(notes),
        )  # fmt: skip
    model_path = real_path(folder / log.surface.file)
    model = read_surface_model(model_path, float(scanner.vehicle_from_scanner[11]))
    crs = _crs(log, model, folder / log.surface.file)
    start, reach = _start(folder, source, log, log.surface, model, crs, float(times[0]))
    rule = LocaliseParameters()
    if log.surface.sure:
        rule = replace(rule, least_margin=-np.inf, least_sharp=0.0, sharp_alike=0.0)
    placed = localise(chain, model, start, reach, seed, loops, parameters=rule)
    poses = chain.all_poses(placed.poses)
    ground, slope = _ground_along(model, poses)
    if not np.isfinite(ground).any():
        notes.append("the surface model tells no heights: the road is taken for level")
        ground, slope = np.full(len(poses), log.origin[2]), np.zeros(len(poses))
    origin = log.origin
    if origin == (0.0, 0.0, 0.0):
        x, y, z = np.floor([poses[0, 0], poses[0, 1], ground[0]]).tolist()
        origin = (x, y, z)
    local = poses - [origin[0], origin[1], 0.0]
    why = "localised in the surface model"
    corrected = _corrections(chain, placed.moved_m, why)
    fit = float(placed.share[placed.sure].mean())
    how += f"; localised in {log.surface.file}, where {100 * fit:.0f} % of the points lie on edges"
    doubts: tuple[str, ...] = () if fit >= _SURE_FIT else (
        f"{100 * fit:.0f} % of the scans' points lie on edges of {log.surface.file}: the drive may"
        " have been in a street that looks alike; the report shows the path from above",
    )  # fmt: skip
    if placed.margin.share < _LEAST_MARGIN:
        metres = float(np.hypot(*placed.margin.away))
        how_well = (
            f"the path fits {log.surface.file} nearly as well {metres:.0f} m away"
            if placed.margin.own > 0.0
            else f"the path fits {log.surface.file} nowhere, beams go through what stands there"
        )
        doubts += (f"{how_well}: it may be the model of another place",)
    return ScannedPath(
        times,
        _matrices(local, ground - origin[2], slope),
        origin,
        crs,
        corrected,
        how,
        tuple(notes),
        doubts,
    )


def _points(
    scans: SpooledScans, scanner: Scanner, told: Callable[[float], None]
) -> Iterator[Floats]:
    """(n, 2) points of each scan in the vehicle's frame, seen from above."""
    mount = np.reshape(scanner.vehicle_from_scanner, (3, 4))
    angles = scanner.first_beam_rad + np.arange(scans.beams) * scanner.beam_step_rad
    beams = (
        np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1) @ mount[:, :3].T
    )
    for row, ranges in enumerate(scans.in_order()):
        told(row / len(scans.times_s))
        with np.errstate(invalid="ignore"):
            kept = (ranges >= scanner.nearest_m) & (ranges < scanner.farthest_m)
        points = beams[kept] * ranges[kept, None].astype(np.float64) + mount[:, 3]
        yield np.ascontiguousarray(points[:, :2])


def _corrections(
    chain: ScanChain, moved_m: Floats, why: str
) -> tuple[tuple[int, Floats, str], ...]:
    """Key scans that were moved, (k, 2) in the world, by more than a beam's noise."""
    return tuple(
        (int(chain.keys[row]), np.array([*moved_m[row], 0.0]), why)
        for row in np.flatnonzero(np.linalg.norm(moved_m, axis=1) > 0.05).tolist()
    )


def _matrices(poses: Floats, height: Floats, slope: Floats) -> Floats:
    """(p, 3, 4) of x, y, heading, height over the origin and slope (rise over run)."""
    cosine, sine = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    level = 1.0 / np.hypot(1.0, slope)
    rise = slope * level
    found = np.zeros((len(poses), 3, 4))
    found[:, 0, 0], found[:, 1, 0], found[:, 2, 0] = cosine * level, sine * level, rise
    found[:, 0, 1], found[:, 1, 1] = -sine, cosine
    found[:, 0, 2], found[:, 1, 2], found[:, 2, 2] = -cosine * rise, -sine * rise, level
    found[:, :2, 3], found[:, 2, 3] = poses[:, :2], height
    return found


def _ground_along(model: SurfaceModel, poses: Floats) -> tuple[Floats, Floats]:
    """Height of the ground and its slope to ahead, smooth along the path; NaN where unknown."""
    raw = model.ground_under(poses[:, :2])
    known = np.isfinite(raw)
    if not known.any():
        return raw, np.zeros(len(raw))
    rows = np.arange(len(raw))
    filled = np.interp(rows, rows[known], raw[known])
    step = np.linalg.norm(np.diff(poses[:, :2], axis=0), axis=1)
    station = np.concatenate([[0.0], np.cumsum(step)])
    if station[-1] < 1.0:
        return np.full(len(raw), np.median(filled)), np.zeros(len(raw))
    at = np.arange(0.0, station[-1] + 0.5, 0.5)
    # Cars and people in the model stand on the road: a median passes them by.
    line = ndimage.median_filter(np.interp(at, station, filled), size=9, mode="nearest")
    smooth = ndimage.gaussian_filter1d(line, _SLOPE_M / 2 / 0.5, mode="nearest")
    slope = np.gradient(smooth, 0.5)
    return np.interp(station, at, smooth), np.interp(station, at, slope)


def _crs(log: DriveLog, model: SurfaceModel, path: Path) -> str | None:
    if log.crs is None or model.crs is None:
        return log.crs or model.crs
    try:
        same = horizontal(log.crs).equals(horizontal(model.crs))
    except CRSError as error:
        raise InputError(path, f"{log.crs}: no such CRS", "Write it as EPSG:number.") from error
    if not same:
        fault = f"is in {model.crs}, the log in {log.crs}"
        raise InputError(path, fault, "Project the model to the log's CRS, or leave out `crs`.")
    return log.crs


def _start(
    folder: Path,
    source: Path,
    log: DriveLog,
    surface: Surface,
    model: SurfaceModel,
    crs: str | None,
    time_s: float,
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Where the drive begins (x, y, heading), and how far off that may be."""
    turn = np.pi if surface.heading_deg is None else np.deg2rad(surface.within_deg)
    heading = np.deg2rad(surface.heading_deg or 0.0)
    if surface.search is not None:
        x0, y0, x1, y1 = surface.search
        if x1 <= x0 or y1 <= y0:
            fault = "surface.search: its highest corner is not above its lowest"
            raise InputError(folder / "drive.toml", fault, "Give lowest x, y and highest x, y.")
        return ((x0 + x1) / 2, (y0 + y1) / 2, heading), ((x1 - x0) / 2, (y1 - y0) / 2, turn)
    place, within = surface.start, surface.within_m
    if place is None and log.gps is not None:
        place, within = _first_fix(folder, source, log, crs, time_s), max(within, _GPS_M)
    if place is None:
        fault = "[surface] says not where the drive begins"
        remedy = (
            "Click it: `veduta drive start LOG -o start.html`; or give `start` = [x, y],"
            " `search` = [x, y, x, y], or a [gps] table."
        )
        raise InputError(folder / "drive.toml", fault, remedy)
    at = (np.array(place) - model.low) / model.cell_m
    if not (
        (at >= 0).all() and at[1] < model.distance_m.shape[0] and at[0] < model.distance_m.shape[1]
    ):
        fault = f"begins at {place[0]:.0f}, {place[1]:.0f}, outside of the surface model"
        raise InputError(folder / "drive.toml", fault, "Give x and y in the model's CRS.")
    return (place[0], place[1], float(heading)), (within, within, float(turn))


def _first_fix(
    folder: Path, source: Path, log: DriveLog, crs: str | None, time_s: float
) -> tuple[float, float]:
    if log.gps is None or crs is None:
        fault = "has a [gps] and no CRS to project it to"
        raise InputError(folder / "drive.toml", fault, "Give `crs`.")
    path = source / log.gps.table
    table = read_table(path, ("time_s", "longitude_deg", "latitude_deg"))
    if not len(table):
        raise InputError(path, "has no positions", "Give at least one.")
    own = time_column(path, table) + log.gps.clock_offset_s
    row = int(np.argmin(np.abs(own - time_s)))
    degrees = [float(table[name][row].as_py()) for name in ("longitude_deg", "latitude_deg")]
    x, y = Transformer.from_crs("EPSG:4326", crs, always_xy=True).transform(degrees[0], degrees[1])
    if not np.isfinite([x, y]).all():
        raise InputError(path, "has a position that is none", "Write degrees.")
    return float(x), float(y)
