"""Twenty listed starts, 20 m and 20 degrees off, in the Delft tile: does the drive find its place?

python benchmarks drive/localise_delft [DATA] [CELL_M]
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from delft_tile import LOW, SCANNER_M, driven, read_points, walls_and_trunks, write_surface
from record import Row, record

from veduta.drive.read.localise import localise
from veduta.drive.read.scan_chain import ScanChain, chain_scans
from veduta.drive.read.surface_model import read_surface_model
from veduta.run.errors import NotFoundError
from veduta.synthetic.drives.level_scan import LevelScanner, scan_level

OFF_M, OFF_DEG, REACH_M, REACH_DEG = 20.0, 20.0, 25.0, 25.0
_OTHER = {"left": "right", "right": "left"}
ALL_AROUND = LevelScanner(beams=360, first_deg=-180.0)
STARTS = [
    (route, backwards, side, seed)
    for seed, (route, backwards, side) in enumerate(
        [
            (route, backwards, side)
            for route, houses in (("quay", "right"), ("south", "right"), ("square", "left"))
            for backwards in (False, True)
            for side in ("around", "ahead", _OTHER[houses] if backwards else houses)
        ]
        + [("quay", False, "around"), ("south", True, "around")]
    )
]
"""Route, direction, to where 180 degrees look (around: 360), and the seed of noise and offset.
Sideways it looks at the houses, as the paper's truck does: across the canal stand none."""


def errors(poses: np.ndarray, truth: np.ndarray) -> dict[str, float]:
    """How far the path is from the truth."""
    off = np.linalg.norm(poses[:, :2] - truth[:, :2], axis=1)
    turned = np.abs(np.rad2deg((poses[:, 2] - truth[:, 2] + np.pi) % (2 * np.pi) - np.pi))
    return {
        "end off (m)": float(off[-1]), "end off (deg)": float(turned[-1]),
        "mean off (m)": float(off.mean()), "most off (m)": float(off.max()),
        "mean off (deg)": float(turned.mean()),
    }  # fmt: skip


def scanner_of(side: str) -> LevelScanner:
    """A scanner that looks there."""
    first = {"left": 0.0, "right": -180.0, "ahead": -90.0}
    return ALL_AROUND if side == "around" else LevelScanner(first_deg=first[side])


def chain_of(ranges: np.ndarray, scanner: LevelScanner) -> ScanChain:
    """The path of scans matched one onto the other."""
    angles = scanner.angles_rad()
    beams = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return chain_scans((beams * row[:, None])[row > 0.5] for row in ranges.astype(float))


def main() -> None:
    """Measure, print and keep."""
    root = Path(__file__).resolve().parents[3] / "shared/data"
    folder = (Path(sys.argv[1]) if len(sys.argv) > 1 else root) / "laser/delft"
    cell_m = float(sys.argv[2]) if len(sys.argv) > 2 else 0.5
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as scratch:
        points, classes = read_points(folder)
        walls, trunks = walls_and_trunks(folder, points, classes, Path(scratch))
        models = {}
        for name, mirrored in (("right", False), ("mirrored", True)):
            path = Path(scratch) / f"{name}.tif"
            write_surface(points, path, cell_m, mirrored)
            models[name] = read_surface_model(path, SCANNER_M)
        for route, backwards, side, seed in STARTS:
            random = np.random.default_rng(seed)
            truth = driven(route, backwards, 0.5)
            scanner = scanner_of(side)
            ranges = scan_level(walls, trunks, truth, scanner, random)
            begin = time.perf_counter()
            chain = chain_of(ranges, scanner)
            matched_s = time.perf_counter() - begin
            away = random.uniform(0.0, 2 * np.pi)
            turn = np.deg2rad(OFF_DEG) * random.choice([-1.0, 1.0])
            start = (
                LOW[0] + truth[0, 0] + OFF_M * np.cos(away),
                LOW[1] + truth[0, 1] + OFF_M * np.sin(away),
                truth[0, 2] + turn,
            )
            reach = (REACH_M, REACH_M, np.deg2rad(REACH_DEG))
            row: dict[str, str | int | float | bool | None] = {
                "route": route, "backwards": backwards, "looks": side, "seed": seed,
                "start off (m)": OFF_M, "start off (deg)": float(np.rad2deg(turn)),
                "length (m)": 0.5 * len(truth),
            }  # fmt: skip
            for name, model in models.items():
                begin = time.perf_counter()
                try:
                    found = localise(chain, model, start, reach, seed)
                except NotFoundError as error:
                    row[name] = f"refused: {error}"
                    continue
                fit = float(found.share[found.sure].mean())
                through = float(found.through[found.sure].mean())
                if name == "mirrored":
                    row[name] = f"FOLLOWED ({fit:.2f} on edges, margin {found.margin.share:.2f})"
                    continue
                row |= {"on edges": fit, "through": through, "margin": found.margin.share}
                off = errors(chain.all_poses(found.poses) - [*LOW, 0.0], truth)
                near = off["end off (m)"] < 1.0 and off["end off (deg)"] < 2.0
                row |= {**off, "right": "found" if near else "WRONG"}
                row["seconds"] = matched_s + time.perf_counter() - begin
            rows.append(row)
            print(row, flush=True)
    record("drive-localise-delft", rows, notes(rows, cell_m))


def notes(rows: list[Row], cell_m: float) -> list[str]:
    """What the table comes to, and how it was made."""
    found = sum(row["right"] == "found" for row in rows)
    ends = [float(row.get("end off (m)") or 1e9) for row in rows]
    refused = sum(str(row["mirrored"]).startswith("refused") for row in rows)
    return [
        f"{found} of {len(rows)} end within 1 m and 2 degrees, {sum(end < 2.0 for end in ends)}"
        f" within 2 m (bound: 18 of 20); {refused} of {len(rows)} refused in the mirrored tile,"
        f" which has as many houses. Cells of {cell_m} m.",
        "Simulated scans (180 degrees at one, or 360; sigma 3.5 cm, 3 % strays, 2 % lost, trunks)"
        " every 0.5 m; the path comes from matching them. The surface model has trees and cars in"
        " it, the walls are the outlines. Thresholds were chosen over eight of these starts.",
    ]


if __name__ == "__main__":
    main()
