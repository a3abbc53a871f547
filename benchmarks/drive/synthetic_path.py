"""The path of synthetic drives from horizontal scans and a surface model, against the truth.

python benchmarks drive/synthetic_path [SEEDS] [LENGTH_M] [made]

made: past whole houses of the facade generator and the grammar, along a street in bends, with beams
of 15 mrad. The row of another street stays away then.
"""

from __future__ import annotations

import sys
import tempfile
import time
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from derived_houses import derived_house
from numpy.typing import NDArray
from record import record

from veduta.drive.read.own import read_own
from veduta.run.errors import NotFoundError
from veduta.synthetic.drives import (
    PAPER,
    MadeHouse,
    MadeStreet,
    MadeStreetOptions,
    Street,
    StreetOptions,
    TruckOptions,
    Way,
    build_street,
    generated_house,
    make_street,
    scan_street,
    write_drive,
)
from veduta.synthetic.drives.surface import surface_of, write_surface

OFF_M, OFF_DEG = 10.0, 10.0
STEP_M, LOCAL_M = 10.0, 0.0667
"""Over so long a step the paper expects points to be off by so much (section 8.4)."""
SCANNER_M = 0.035
TRUCK = TruckOptions(level=True, spacing_m=0.25, sway_m=0.6, sway_rad=0.06)
SURFACE = '\n[surface]\nfile = "surface.tif"\nstart = [{:.2f}, {:.2f}]\nheading_deg = {:.2f}\n'
MADE = replace(TRUCK, divergence_rad=PAPER.divergence_rad)
BENDS = Way(radius_m=90.0, period_m=200.0)
Floats = NDArray[np.float64]
Row = dict[str, str | int | float | bool | None]


def made_house(seed: int) -> MadeHouse:
    """Every other one of the facade generator, of a few; the rest of the grammar."""
    return derived_house(seed % 11) if seed % 2 else generated_house(seed % 11)


def drive(seed: int, length_m: float, wrong: bool, made: bool = False) -> Row:
    """One drive in the surface model of its own street, or of another."""
    street: Street | MadeStreet = build_street(StreetOptions(length_m=length_m), seed)
    if made:
        options = MadeStreetOptions(length_m=length_m, way=BENDS)
        street = make_street(options, seed, lru_cache(made_house))
    scans = scan_street(street, MADE if made else TRUCK, seed)
    other = build_street(StreetOptions(length_m=length_m, front_m=17.0), seed + 5000)
    random = np.random.default_rng(seed)
    away = random.uniform(0, 2 * np.pi)
    place = scans.world_from_vehicle[0, :2, 3] + OFF_M * np.array([np.cos(away), np.sin(away)])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_drive(scans, folder, poses=False)
        heights, low = surface_of(other if wrong else street, 1.0, seed)
        write_surface(heights, low, folder / "surface.tif")
        heading = 90.0 + OFF_DEG * random.choice([-1, 1])
        toml = folder / "drive.toml"
        toml.write_text(toml.read_text() + SURFACE.format(*place, heading))
        begin = time.perf_counter()
        try:
            found = read_own(folder, seed)
        except NotFoundError as error:
            return {"seed": seed, "model": "wrong" if wrong else "right", "told": str(error)[:90]}
        seconds = time.perf_counter() - begin
        sweeps = found.sweeps
        rows = np.searchsorted(scans.times_s, [sweep.time_s - 1e-6 for sweep in sweeps])
        own = np.array([sweep.world_from_sensor[:3, 3] for sweep in sweeps]) + found.origin_m
        truth = scans.world_from_vehicle[rows, :, 3] + [0.0, 0.0, TRUCK.height_m]
        off = np.linalg.norm(own[:, :2] - truth[:, :2], axis=1)
        level = np.abs(own[:, 2] - truth[:, 2])
        local = local_errors(own, truth)
    return {
        "seed": seed, "model": "wrong" if wrong else "right",
        "told": "followed" if wrong else "found",
        "to the side (m)": float((own[:, 0] - truth[:, 0]).mean()),
        "along (m)": float((own[:, 1] - truth[:, 1]).mean()),
        "mean off (m)": float(off.mean()), "most off (m)": float(off.max()),
        "local over 10 m (m)": float(np.sqrt((local**2).mean())),
        "height off (m)": float(level.mean()), "seconds per km": 1000 * seconds / length_m,
    }  # fmt: skip


def local_errors(own: Floats, truth: Floats) -> Floats:
    """(n,) by how much steps of STEP_M along a path are off. Both (s, 3) places (m, world)."""
    moves = np.linalg.norm(np.diff(truth[:, :2], axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(moves)])
    first = np.flatnonzero(along + STEP_M <= along[-1])
    last = np.searchsorted(along, along[first] + STEP_M)
    apart = (own[last] - own[first]) - (truth[last] - truth[first])
    return np.asarray(np.linalg.norm(apart[:, :2], axis=1))


def main() -> None:
    """Measure, print and keep."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    length_m = float(sys.argv[2]) if len(sys.argv) > 2 else 200.0
    rows = []
    made = "made" in sys.argv
    for seed in range(300, 300 + seeds):
        for wrong in (False,) if made else (False, True):
            rows.append(drive(seed, length_m, wrong, made))
            print(rows[-1], flush=True)
    good = sum(
        row["told"] == "found" and float(row["most off (m)"] or 0) < 1.0
        and float(row["mean off (m)"] or 0) < 0.5
        for row in rows
    )  # fmt: skip
    refused = sum(row["model"] == "wrong" and row["told"] != "followed" for row in rows)
    steps = [float(row["local over 10 m (m)"] or 0) for row in rows if row["told"] == "found"]
    local = float(np.sqrt(np.mean(np.square(steps)))) if steps else float("nan")
    two = float(np.sqrt(LOCAL_M**2 - 2 * SCANNER_M**2))
    other = f" {refused} of {seeds} models of another street refused."
    name = "drive-synthetic-path-made" if made else "drive-synthetic-path"
    record(name, rows, [
        f"{good} of {seeds} within 1 m everywhere and 0.5 m on average (the bound)."
        + ("" if made else other),
        f"Local error: of steps of {STEP_M:.0f} m in the world, RMS:"
        f" {local:.3f} m over all drives. The paper expects two points that are scanned"
        f" {STEP_M:.0f} m apart to be {LOCAL_M:.3f} m off, {two:.3f} m of which is the path.",
        f"{length_m:.0f} m each; scans (180 degrees to the left, sigma 3.5 cm"
        f"{', beams of 15 mrad, a street in bends of 90 m' if made else ''}) every 0.25 m;"
        " surface model of 1 m cells with crowns, cars and errors; start"
        f" {OFF_M} m and {OFF_DEG} degrees off.",
        "Seconds are by the clock and count the machine's other work.",
    ])  # fmt: skip


if __name__ == "__main__":
    main()
