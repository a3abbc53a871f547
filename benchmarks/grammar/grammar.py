"""How many terminals per second the grammar engine derives, with all their polygons.

Beside it the crate `symbios-shape` on the example that it comes with and on a facade of boxes; it
makes scopes, no polygons. It is built from `benchmarks/peers/symbios`, which is no dependency of
Veduta, and left out where it does not build. CPU seconds are given besides those on the clock:
other work on the machine is not in them.
"""

from __future__ import annotations

import os
import resource
import subprocess
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from record import Row, record

from veduta import _core
from veduta.grammar.derivation import parse

HERE = Path(__file__).parents[1]
STYLE = "haussmann"
LOTS = 10_000
HOUSES = 200
RUNS = 3
BOXES = """
Lot --> extrude(12) split(y) { 3 : Ground | ~1 : Floor | ~1 : Floor | 2 : RoofMesh. }
Ground --> split(x) { 1.5 : Column. | ~1 : ShopFront. | 1.5 : Column. }
Floor --> split(x) { { ~2.5 : Window. }* }
"""
FACADE = """
Lot --> extrude(18) split(y) { { ~3 : Floor }* }
Floor --> split(x) { { ~2.4 : Bay }* }
Bay --> split(x) { 0.6 : Wall. | ~1 : Middle | 0.6 : Wall. }
Middle --> split(y) { 0.4 : Wall. | ~1 : Window. | 0.5 : Wall. }
"""
Ring = list[tuple[float, float, float]]


def rectangle(width_m: float, depth_m: float) -> list[Ring]:
    """A lot with its front along x."""
    corners = [(0.0, 0.0), (width_m, 0.0), (width_m, depth_m), (0.0, depth_m)]
    return [[(x, y, 0.0) for x, y in corners]]


def ours(name: str, rules: _core.GrammarRules, lot: list[Ring], count: int, cores: int) -> Row:
    """The best of some runs."""
    runs = []
    for _ in range(RUNS):
        began = time.process_time()
        leaves, polygons, seconds = rules.pace([lot] * count, list(range(count)), cores)
        runs.append((seconds, time.process_time() - began, leaves, polygons))
    seconds, cpu, leaves, polygons = min(runs)
    cpu = min(run[1] for run in runs)
    return row(name, "veduta", cores, leaves, polygons, seconds, cpu)


def row(
    name: str, engine: str, cores: int, leaves: int, polygons: int, seconds: float, cpu: float
) -> Row:
    """One line of the table."""
    return {
        "grammar": name,
        "engine": engine,
        "cores": cores,
        "terminals": leaves,
        "polygons": polygons,
        "seconds": seconds,
        "terminals/s": round(leaves / seconds),
        "CPU s": cpu,
        "terminals/CPU s": round(leaves / cpu),
    }


def peers(cores: Sequence[int]) -> tuple[list[Row], str]:
    """The rows of `symbios-shape`, or why there are none."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", tempfile.gettempdir())) / "symbios-peer"
    build = ["cargo", "build", "--release", "--quiet", "--target-dir", str(target)]
    try:
        subprocess.run(build, cwd=HERE / "peers" / "symbios", check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as fault:
        told = getattr(fault, "stderr", b"") or str(fault).encode()
        return [], "symbios-shape did not build: " + told.decode().strip().splitlines()[-1]
    rows: list[Row] = []
    for count in cores:
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        command = [str(target / "release" / "symbios-peer"), str(count), str(LOTS)]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        found = [line.split() for line in said.splitlines()]
        whole = sum(float(seconds) for _, _, seconds in found)
        for name, terminals, seconds in found:
            # The CPU time of the run, shared out by the clock.
            cpu = used * float(seconds) / whole
            made = (int(terminals), 0, float(seconds), cpu)
            rows.append(row(name, "symbios-shape 0.4.1", count, *made))
    return rows, "symbios-shape makes boxes as scopes, without polygons"


def main() -> None:
    """Both engines on one core and on two."""
    cores = (1, 2)
    rows: list[Row] = []
    boxes, facade = (_core.GrammarRules([("rules.cga", text)]) for text in (BOXES, FACADE))
    style = parse(STYLE).core
    for count in cores:
        rows.append(ours("boxes", boxes, rectangle(15, 15), LOTS, count))
        rows.append(ours("facade", facade, rectangle(24, 24), LOTS // 10, count))
        rows.append(ours(f"{STYLE}.cga", style, rectangle(18, 12), HOUSES, count))
    beside, note = peers(cores)
    notes = [
        "Seconds are the best of 3 runs: derivation and packing of all polygons; "
        "nothing is written.",
        note,
    ]
    record("grammar", rows + beside, notes)


if __name__ == "__main__":
    main()
