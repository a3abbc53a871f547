"""`veduta drive` on streets with known truth: what is taken out, kept and filled.

The truth is rendered by `veduta.synthetic.drives`, which shares no function with the verb. Houses
come from the facade generator and from the grammar, beams are as wide as the paper's. Each variant
breaks an assumption of section 5: a street in bends, houses that step back, a hedge before
everything, lost scans. Streets of plain boxes and thin rays are there for older figures.

    python benchmarks drive/synthetic_street [SEEDS] [FOLDER]

FOLDER keeps the row of each kind of street, so that a run may be cut in pieces: a run with other
code needs another.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from derived_houses import derived_house
from numpy.typing import NDArray
from record import record

from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.fill import Source
from veduta.drive.build.layers import PointClass
from veduta.drive.build.segment import Geometry, frame_of, reconstruct
from veduta.drive.options import DriveOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.synthetic.drives import (
    PAPER,
    DriveScans,
    HouseMaker,
    Kind,
    MadeHouse,
    MadeStreetOptions,
    Scenery,
    StreetOptions,
    TruckOptions,
    Way,
    build_street,
    generated_house,
    make_street,
    scan_street,
    write_drive,
)

LENGTH_M, HOUSES = 100.0, 41
MADE = MadeStreetOptions(length_m=LENGTH_M)
Builder = Callable[[int], Scenery]


@cache
def of_few(make: HouseMaker, number: int) -> MadeHouse:
    """Houses stand in several streets: making their textures takes longer than all else."""
    return make(number)


def made(options: MadeStreetOptions, make: HouseMaker = generated_house) -> Builder:
    """A street of whole houses."""
    return lambda seed: make_street(options, seed, lambda own: of_few(make, own % HOUSES))


VARIANTS: dict[str, tuple[Builder, TruckOptions]] = {
    "houses by the facade generator": (made(MADE), PAPER),
    "houses by the grammar": (made(MADE, derived_house), PAPER),
    "a street in bends": (made(replace(MADE, way=Way(radius_m=60.0)), derived_house), PAPER),
    "houses step by 2 m": (made(replace(MADE, steps_m=2.0)), PAPER),
    "a hedge before all": (made(replace(MADE, hedge=True)), PAPER),
    "5 % of scans lost": (made(MADE), replace(PAPER, dropped=0.05)),
    "boxes, thin rays": (
        lambda seed: build_street(StreetOptions(length_m=LENGTH_M), seed),
        TruckOptions(),
    ),
    "boxes that step by 2 m, thin rays": (
        lambda seed: build_street(StreetOptions(length_m=LENGTH_M, steps_m=2.0), seed),
        TruckOptions(),
    ),
}
MOST_OFF_M, EDGE_M = 1.0, 0.6
SIDE_M = 0.4
"""A depth so near to a side of an end of a house is of that side."""
FIRST, _AT_ONCE = 700, 5_000
NOTES = [
    "100 m of houses each; scanner: 180 degrees at 1, sigma 3.5 cm, beams of 15 mrad (boxes: thin"
    " rays); glass lets rays pass. Bounds: recall and precision 0.97, filled geometry 0.15 m RMS.",
    "Off from the true facades and ground, beam by beam, at most 1 m, as much where there is no"
    " surface: of what was scanned and of what was made; shares of segments (bounds: better 0.80,"
    " worse 0.02).",
    f"Poses are given; there are no images. Seeds from {FIRST} on choose nothing, and were not seen"
    " when arcades and filling were made."
    f" {HOUSES} houses of each maker, drawn anew for each street.",
    "Filled walls against the true ones, by what is there: hidden behind something; glass, which"
    " answers nothing, so that its depth is not known; between beams and edges. Beams at edges:"
    " both sides of an end of a house answer within 15 mrad, more than 0.6 m apart. Of the squared"
    " error of all filled walls, shares of those beams that were given the nearer side's depth, the"
    " farther one's, or one between both: beams as wide as scans are apart tell not which.",
    "Seconds are by the clock and count the machine's other work.",
]
Scores = dict[str, list[float]]


def measure(street: Scenery, scans: DriveScans, scores: Scores) -> None:
    """Add the figures of one drive."""
    with tempfile.TemporaryDirectory() as folder:
        write_drive(scans, Path(folder))
        drive = read_own(Path(folder))
        options = DriveOptions()
        spacing = column_spacing(drive, options)
        begin = time.perf_counter()
        for segment in cut_segments(driven_line(drive.path(), spacing, 0.0), spacing):
            if segment.side == "left" and segment.fate == "build":
                points = points_beside(drive, segment, options)
                frame = frame_of(segment, options, drive.height_m)
                geometry = reconstruct(segment, frame, points, options)
                _layers(geometry, points, scans, scores)
                _filled(geometry, street, scores)
                _against_raw(geometry, street, scores)
        scores.setdefault("seconds", []).append(time.perf_counter() - begin)


def _layers(
    geometry: Geometry, points: NDArray[np.float64], scans: DriveScans, scores: Scores
) -> None:
    """Recall of the foreground, and precision of the background (walls and ground)."""
    kind = _kind_of(points, scans)[geometry.layers.points.index]
    found = geometry.layers.kind
    before = kind == Kind.OBJECT
    taken = found == PointClass.FOREGROUND
    kept = (found == PointClass.BUILDING) | (found == PointClass.GROUND)
    true = (kind == Kind.WALL) | (kind == Kind.GROUND)
    scores.setdefault("foreground recall", []).append(float(taken[before].mean()))
    scores.setdefault("background precision", []).append(float(true[kept].mean()))
    scores.setdefault("background recall", []).append(float(kept[true].mean()))


def _kind_of(points: NDArray[np.float64], scans: DriveScans) -> NDArray[np.uint8]:
    """(n,) what the ray of each point met: the scan by its plane, the beam by its angle."""
    poses = scans.world_from_vehicle
    middle = poses[:, :, 3] + [0.0, 0.0, scans.options.height_m]
    own = (middle * poses[:, :, 0]).sum(axis=1)
    kind = np.zeros(len(points), dtype=np.uint8)
    step = float(scans.angles_rad[1] - scans.angles_rad[0])
    for first in range(0, len(points), _AT_ONCE):
        part = slice(first, first + _AT_ONCE)
        scan = np.abs(points[part] @ poses[:, :, 0].T - own).argmin(axis=1)
        offset = points[part] - middle[scan]
        level = (offset * poses[scan, :, 1]).sum(axis=1)
        angle = np.arctan2(offset[:, 2], level)
        beam = np.clip(np.rint((angle - scans.angles_rad[0]) / step), 0, len(scans.angles_rad) - 1)
        kind[part] = scans.kind[scan, beam.astype(int)]
    return kind


def _filled(geometry: Geometry, street: Scenery, scores: Scores) -> None:
    """Filled pixels against rays that nothing hides."""
    frame, background = geometry.frame, geometry.background
    rows, columns = np.nonzero(background.source == Source.FILLED)
    origins = frame.origins[columns]
    angle = frame.angles_rad[rows]
    flat = frame.outward[columns] * np.cos(angle)[:, None]
    directions = np.concatenate([flat, np.sin(angle)[:, None]], axis=1)
    facade, is_wall = street.facade(origins, directions)
    met, kind = street.meet(origins, directions, np.ones(len(origins), dtype=bool))
    on_wall = background.wall[rows, columns]
    depth = background.depth[rows, columns].astype(float)
    with np.errstate(invalid="ignore"):
        off = depth - facade * np.cos(angle)
        glass = (kind == Kind.BEHIND_GLASS) | ((met > facade + 0.05) & (kind != Kind.OBJECT))
    chosen = on_wall & is_wall
    below = ~on_wall & ~is_wall & np.isfinite(facade)
    height = frame.vertices(background.depth)[rows, columns, 2]
    near, far = _both_sides(street, origins, flat, np.sin(angle))
    edge = far - near > EDGE_M
    _at_ends(depth, near * np.cos(angle), far * np.cos(angle), off, chosen & edge, chosen, scores)
    parts = {
        "filled wall RMS (m)": chosen,
        "without beams at edges (m)": chosen & ~edge,
        "of it hidden (m)": chosen & (kind == Kind.OBJECT),
        "of it glass (m)": chosen & glass,
        "of it between beams (m)": chosen & ~glass & (kind != Kind.OBJECT),
    }
    for name, part in parts.items():
        if part.any():
            scores.setdefault(name, []).append(_rms(off[part]))
    scores.setdefault("filled wall within 15 cm", []).append(
        float((np.abs(off[chosen]) < 0.15).mean())
    )
    scores.setdefault("filled ground RMS (m)", []).append(_rms(height[below]))


def _both_sides(
    street: Scenery, origins: NDArray[np.float64], flat: NDArray[np.float64],
    rise: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:  # fmt: skip
    """(n,) distances to the nearer and the farther facade that a beam meets, as wide as the
    scanner's: at an end of a house both of its sides answer, so that what it measures is neither's
    place.
    """
    half = PAPER.divergence_rad / 2
    met = []
    for turn in (-half, half):
        cosine, sine = np.cos(turn), np.sin(turn)
        x, y = flat[:, 0], flat[:, 1]
        turned = np.column_stack([cosine * x - sine * y, sine * x + cosine * y, rise])
        met.append(np.minimum(street.facade(origins, turned)[0], PAPER.farthest_m))
    return np.minimum(*met), np.maximum(*met)


def _at_ends(
    depth: NDArray[np.float64], near: NDArray[np.float64], far: NDArray[np.float64],
    off: NDArray[np.float64], edge: NDArray[np.bool_], chosen: NDArray[np.bool_], scores: Scores,
) -> None:  # fmt: skip
    """By what ends of houses are off, as shares of the squared error of all filled walls."""
    whole = float((off[chosen] ** 2).sum())
    wrong = edge & (np.abs(off) > EDGE_M)
    parts = {
        "ends given the nearer side": wrong & (np.abs(depth - near) < SIDE_M),
        "ends given the farther side": wrong & (np.abs(depth - far) < SIDE_M),
        "ends given a depth between": wrong & (depth > near + SIDE_M) & (depth < far - SIDE_M),
    }
    for name, part in parts.items():
        if whole > 0.0:
            scores.setdefault(name, []).append(float((off[part] ** 2).sum()) / whole)


def _against_raw(geometry: Geometry, street: Scenery, scores: Scores) -> None:
    """The surface as scanned and as made, over the beams that reach a facade behind all else.

    Each beam is off by at most MOST_OFF_M, and by that where there is no surface. Where the scanner
    is coarser than the depth image, only its own beams count.
    """
    frame, layers = geometry.frame, geometry.layers
    met = np.isfinite(layers.first)
    rows, columns = np.nonzero(met | (np.isfinite(geometry.background.depth) & _own_rows(met)))
    angle = frame.angles_rad[rows]
    flat = frame.outward[columns] * np.cos(angle)[:, None]
    directions = np.concatenate([flat, np.sin(angle)[:, None]], axis=1)
    origins = frame.origins[columns]
    facade, _ = street.facade(origins, directions)
    true = facade * np.cos(angle)
    known = np.isfinite(true) & (true < DriveOptions().columns.farthest_m)
    off = [
        np.minimum(np.nan_to_num(np.abs(depth[rows, columns] - true), nan=MOST_OFF_M), MOST_OFF_M)
        for depth in (layers.first, geometry.background.depth)
    ]
    raw, made = (float(one[known].mean()) for one in off)
    scores.setdefault("raw off (m)", []).append(raw)
    scores.setdefault("made off (m)", []).append(made)
    scores.setdefault("segments better than raw", []).append(float(made < raw))
    scores.setdefault("segments worse", []).append(float(made > raw))


def _own_rows(met: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(r, 1) the rows of the depth image on which beams of the scanner fall."""
    return np.asarray(met.mean(axis=1, keepdims=True) > 0.1)


def _rms(values: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else float("nan")


def row_of(name: str, seeds: int) -> dict[str, str | int | float | None]:
    """The means over the seeds of one kind of street."""
    build, truck = VARIANTS[name]
    scores: Scores = {}
    for seed in range(FIRST, FIRST + seeds):
        street = build(seed)
        measure(street, scan_street(street, truck, seed), scores)
    row: dict[str, str | int | float | None] = {"street": name, "seeds": seeds}
    return row | {key: float(np.mean(values)) for key, values in scores.items()}


def main() -> None:
    """Measure, print and keep."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    folder = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    rows = []
    for number, name in enumerate(VARIANTS):
        kept = folder / f"{number}-{seeds}.json" if folder else None
        if kept is not None and kept.is_file():
            rows.append(json.loads(kept.read_text()))
            continue
        rows.append(row_of(name, seeds))
        print(rows[-1], flush=True)
        if kept is not None:
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_text(json.dumps(rows[-1]))
    record("drive-synthetic", rows, NOTES)


if __name__ == "__main__":
    main()
