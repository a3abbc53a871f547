"""Reading and laying out lots by their number: time and memory before the first is derived.

    python benchmarks grammar/grammar_lots              # 1000 to 1,000,000 lots, kept in results/
    python benchmarks grammar/grammar_lots 50000        # any numbers, only printed

A GeoJSON file of rectangles is read as `veduta grammar derive` does it: outlines, lots, blocks with
what stands beside each lot, and the keys of the blocks. Each number has a process of its own, whose
processor time and peak memory count.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from record import Value, keep_or_print

COUNTS = (1000, 10_000, 100_000, 1_000_000)
CHILD = "--read"
PROGRAMS = Path(__file__).parents[1]


def main() -> None:
    """Measure, print and keep the result."""
    parser = argparse.ArgumentParser()
    parser.add_argument("counts", nargs="*", type=int, default=COUNTS)
    parser.add_argument(CHILD, type=Path)
    chosen = parser.parse_args()
    if chosen.read is not None:
        print(json.dumps(read(chosen.read)))
        return
    rows = [measured(count) for count in chosen.counts]
    notes = ["seconds are of the processor; peak MB is the memory of the process, 1,000,000 bytes"]
    keep_or_print("grammar_lots", rows, notes, keep=tuple(chosen.counts) == COUNTS)


def measured(count: int) -> dict[str, Value]:
    """So many lots in a process of their own."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lots.geojson"
        write_lots(path, count)
        command = [sys.executable, str(PROGRAMS), "grammar/grammar_lots", CHILD, str(path)]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        found: dict[str, float] = json.loads(said)
        size = path.stat().st_size
    spent = sum(value for name, value in found.items() if name.endswith(" s"))
    return {"lots": count, "file MB": size / 1e6, **found, "ms per lot": 1000 * spent / count}


def read(path: Path) -> dict[str, float]:
    """What it costs to read the file and to lay out its lots."""
    from veduta.grammar.lots import read_lots
    from veduta.grammar.squares import squares_of, told

    began = time.process_time()
    lots = read_lots(path, folder=path.parent)
    reading = time.process_time()
    squares = squares_of(lots.lots, ask_beside=True)
    laying = time.process_time()
    for square in squares.every:
        told(squares.block(square))
    ended = time.process_time()
    return {
        "blocks": len(squares.every),
        "read s": reading - began,
        "blocks s": laying - reading,
        "keys s": ended - laying,
        "peak MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6,
    }


def write_lots(path: Path, count: int) -> None:
    """Rectangles in rows, in a projected CRS."""
    side = math.isqrt(count) + 1
    with path.open("w") as file:
        file.write('{"type":"FeatureCollection","crs":{"type":"name","properties":')
        file.write('{"name":"EPSG:32631"}},"features":[\n')
        for number in range(count):
            x, y = 450_000 + number % side * 16.0, 5_400_000 + number // side * 18.0
            right, top = x + 12 + number % 7 * 0.5, y + 11 + number % 5 * 0.6
            ring = [[x, y], [right, y], [right, top], [x, top], [x, y]]
            shape = {"type": "Polygon", "coordinates": [ring]}
            about = {"height": 6 + number % 9, "use": "house"}
            feature = {"type": "Feature", "id": f"house-{number:07d}", "properties": about}
            file.write(("," if number else "") + json.dumps(feature | {"geometry": shape}) + "\n")
        file.write("]}\n")


if __name__ == "__main__":
    main()
