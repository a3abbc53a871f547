"""Towns of synthetic lots: time, memory and size by their number.

    python benchmarks grammar/grammar_scale                   # 10 to 100,000 lots, kept in results/
    python benchmarks grammar/grammar_scale 10000 -o OUT      # any numbers, only printed

Derives the style `haussmann` with tiles and without CityJSON, one process for each core. Memory is
the proportional set size of all processes together. With -o the town of the last number stays, and
a run that was stopped goes on there.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from peak_memory import watched
from record import Value, keep_or_print

from veduta.synthetic.lots import street_of_lots

COUNTS = (10, 100, 1000, 10_000, 100_000)
IN_STREET = 40
STREET_M, BLOCK_M = 340.0, 75.0
"""From the beginning of one street to the next in its line, and between lines."""
MOST_GIB, MOST_BYTES_OF_LOT = 4.0, 50_000
"""Bounds: memory of a run, and tiles (5 GB for 100,000 lots)."""


def main() -> None:
    """Measure, print and keep the result."""
    parser = argparse.ArgumentParser()
    parser.add_argument("counts", nargs="*", type=int, default=COUNTS)
    parser.add_argument("-o", "--out", type=Path)
    chosen = parser.parse_args()
    rows = [measured(count, chosen.out) for count in chosen.counts]
    notes = [
        f"bounds: peak below {MOST_GIB:g} GiB, at most {MOST_BYTES_OF_LOT:,} bytes of tiles a lot",
        "MB are 1,000,000 bytes; cores: processor time of all processes over wall time",
    ]
    keep_or_print("grammar_scale", rows, notes, keep=tuple(chosen.counts) == COUNTS)


def measured(count: int, out: Path | None) -> dict[str, Value]:
    """One call over so many lots."""
    with tempfile.TemporaryDirectory() as folder:
        lots = Path(folder) / "lots.geojson"
        lots.write_text(json.dumps(town_of_lots(count)))
        target = out or Path(folder) / "out"
        command = [sys.executable, "-m", "veduta.cli.main", "grammar", "derive", "haussmann"]
        command += ["--lots", str(lots), "-o", str(target), "--no-city", "--quiet"]
        start, before = time.perf_counter(), os.times()
        process = subprocess.Popen(command)
        peak = watched(process)
        wall_s, after = time.perf_counter() - start, os.times()
        if process.returncode != 0:
            raise SystemExit(f"{count} lots: the call ended with exit code {process.returncode}")
        written = sum(path.stat().st_size for path in target.rglob("tiles/*") if path.is_file())
    cpu_s = (after.children_user + after.children_system) - (
        before.children_user + before.children_system
    )
    return {
        "lots": count,
        "wall s": wall_s,
        "ms per lot": 1000 * wall_s / count,
        "processor ms per lot": 1000 * cpu_s / count,
        "cores": cpu_s / wall_s,
        "peak MB": peak.pss / 1e6,
        "tiles MB": written / 1e6,
        "bytes per lot": round(written / count),
    }


def town_of_lots(count: int) -> dict[str, object]:
    """Streets of forty lots in lines, as GeoJSON in a projected CRS."""
    across = max(1, math.isqrt(count // IN_STREET // 4))
    features = []
    for street in range(math.ceil(count / IN_STREET)):
        lots = street_of_lots(min(IN_STREET, count - street * IN_STREET), street)
        corner = np.concatenate(lots.outlines_m).min(axis=0)
        at = np.array([street % across * STREET_M, street // across * BLOCK_M])
        for name, outline in zip(lots.names, lots.outlines_m, strict=True):
            ring = np.round(outline - corner + at + [450_000.0, 5_400_000.0], 3).tolist()
            features.append(
                {
                    "type": "Feature",
                    "id": f"{street}-{name}",
                    "properties": {},
                    "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
                }
            )
    crs = {"type": "name", "properties": {"name": "EPSG:32631"}}
    return {"type": "FeatureCollection", "crs": crs, "features": features}


if __name__ == "__main__":
    main()
