"""Walls behind objects, filled in three ways, against the true ones.

As the paper does, by depths; from the main depth on; and without objects, all holes alike.

    python benchmarks drive/synthetic_fill [SEEDS] [FIRST]
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import record
from synthetic_street import VARIANTS

from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.fill import Background, FillParameters, Source, fill_background
from veduta.drive.build.segment import Geometry, frame_of, reconstruct
from veduta.drive.options import DriveOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.synthetic.drives import DriveScans, Kind, Scenery, scan_street, write_drive

STREETS = (
    "houses by the facade generator", "houses by the grammar", "a street in bends",
    "houses step by 2 m",
)  # fmt: skip


def geometries(scans: DriveScans) -> list[Geometry]:
    """Of the left side of a drive."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        write_drive(scans, Path(folder))
        drive, options = read_own(Path(folder)), DriveOptions()
        spacing = column_spacing(drive, options)
        for segment in cut_segments(driven_line(drive.path(), spacing, 0.0), spacing):
            if segment.side == "left" and segment.fate == "build":
                points = points_beside(drive, segment, options)
                frame = frame_of(segment, options, drive.height_m)
                found.append(reconstruct(segment, frame, points, options))
    return found


def ways(one: Geometry) -> dict[str, Background]:
    """The background, filled in each way."""
    none = np.zeros_like(one.objects)
    plain = FillParameters(from_main=False)
    return {
        "all holes alike": fill_background(one.layers, none, one.frame),
        "by object, depths": fill_background(one.layers, one.objects, one.frame, plain),
        "by object, from the main depth": one.background,
    }


def off_hidden(
    one: Geometry, made: dict[str, Background], street: Scenery
) -> dict[str, NDArray[np.float64]]:
    """(n,) by how much walls are off where something hides them (m); NaN where a way fills none."""
    frame = one.frame
    filled = {way: (each.source == Source.FILLED) & each.wall for way, each in made.items()}
    rows, columns = np.nonzero(np.any(list(filled.values()), axis=0))
    angle = frame.angles_rad[rows]
    flat = frame.outward[columns] * np.cos(angle)[:, None]
    directions = np.concatenate([flat, np.sin(angle)[:, None]], axis=1)
    origins = frame.origins[columns]
    facade, is_wall = street.facade(origins, directions)
    _, kind = street.meet(origins, directions, np.ones(len(rows), dtype=bool))
    hidden = is_wall & (kind == Kind.OBJECT)
    rows, columns, true = rows[hidden], columns[hidden], (facade * np.cos(angle))[hidden]
    return {
        way: np.where(filled[way][rows, columns], each.depth[rows, columns] - true, np.nan)
        for way, each in made.items()
    }


def main() -> None:
    """Measure, print and keep."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    rows: list[dict[str, str | int | float | bool | None]] = []
    for name in STREETS:
        build, truck = VARIANTS[name]
        off: dict[str, list[NDArray[np.float64]]] = {}
        for seed in range(first, first + seeds):
            street = build(seed)
            for one in geometries(scan_street(street, truck, seed)):
                for way, values in off_hidden(one, ways(one), street).items():
                    off.setdefault(way, []).append(values)
        all_ways = {way: np.concatenate(values) for way, values in off.items()}
        common = np.isfinite(list(all_ways.values())).all(axis=0)
        for way, apart in all_ways.items():
            own, shared = apart[np.isfinite(apart)], apart[common]
            rows.append({
                "street": name, "way": way, "pixels": len(own),
                "RMS (m)": float(np.sqrt((own**2).mean())),
                "of those that all fill (m)": float(np.sqrt((shared**2).mean())),
                "median (m)": float(np.median(np.abs(shared))),
                "within 15 cm": float((np.abs(shared) < 0.15).mean()),
            })  # fmt: skip
            print(rows[-1], flush=True)
    note = f"{seeds} streets of 100 m each, seeds from {first} on; pixels of walls that are hidden."
    note += " Median and share are of those that all ways fill."
    record("drive-synthetic-fill", rows, [note])


if __name__ == "__main__":
    main()
