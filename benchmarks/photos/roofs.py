"""Hip roofs over 120 outlines that other roof software fails on: time, and how many fail.

Beside Veduta stands CGAL (exact predicates) through compas_cgal where that is installed by hand in
the interpreter that `COMPAS_CGAL_PYTHON` names: its licence is none that Veduta could depend on.
polyskel and bpypolyskel are in no package index. The crate `straight-skeleton` is GPL and computes
on a grid of 16-bit integers, which these outlines do not lie on; it is not measured.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from record import Row, record
from roof_checks import FOOTPRINTS, TYPES, Outline, faults, read_outlines, solid

from veduta import _core

RUNS = 21
LIMIT_S = 20.0
DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
DOCS = Path(__file__).parents[2] / "docs" / "roofs.md"
PEER = """
import json, sys, time
import numpy as np
from compas_cgal.straight_skeleton_2 import (
    interior_straight_skeleton, interior_straight_skeleton_with_holes)
for line in sys.stdin:
    rings = [[[x, y, 0.0] for x, y in ring] for ring in json.loads(line)]
    best, why = None, ""
    began = time.process_time()
    for _ in range(5):
        start = time.process_time()
        try:
            if len(rings) == 1:
                interior_straight_skeleton(rings[0])
            else:
                interior_straight_skeleton_with_holes(rings[0], rings[1:])
        except Exception as fault:
            why = type(fault).__name__ + ": " + str(fault)[:80]
            break
        took = time.process_time() - start
        best = took if best is None else min(best, took)
        if time.process_time() - began > 2:
            break
    print(json.dumps([best, why]), flush=True)
"""


def times_ms(over: Outline) -> float:
    """The median of some runs, with what Python takes to call."""
    taken = []
    for _ in range(RUNS):
        began = time.perf_counter()
        _core.roof_solid("hip", over.points_m, over.ring_offsets, 1.0)
        taken.append(1e3 * (time.perf_counter() - began))
    return float(np.median(taken))


def summary(name: str, taken: list[float], failed: int, all_of_them: int) -> Row:
    """One line of the table."""
    return {
        "engine": name,
        "outlines": all_of_them,
        "fail": failed,
        "median ms": float(np.median(taken)),
        "90th ms": float(np.quantile(taken, 0.9)),
        "most ms": float(np.max(taken)),
    }


def cgal(outlines: list[Outline]) -> tuple[list[Row], str]:
    """CGAL's straight skeletons, each in a process that may crash; or why there are none."""
    python = os.environ.get("COMPAS_CGAL_PYTHON")
    if not python:
        return [], "CGAL: not measured; COMPAS_CGAL_PYTHON names no interpreter with compas_cgal"
    taken, failed, reasons = [], 0, set()
    for over in outlines:
        ends = zip(over.ring_offsets, over.ring_offsets[1:], strict=False)
        rings = [over.points_m[first:end].tolist() for first, end in ends]
        try:
            done = subprocess.run(
                [python, "-c", PEER],
                input=json.dumps(rings) + "\n",
                capture_output=True,
                text=True,
                timeout=LIMIT_S,
            )
            best, why = json.loads(done.stdout)
        except subprocess.TimeoutExpired:
            best, why = None, f"takes longer than {LIMIT_S} s"
        except json.JSONDecodeError:
            best, why = None, f"the process ended with {done.returncode}"
        if why:
            failed += 1
            reasons.add(why)
        if best is not None:
            taken.append(1e3 * best)
    note = "CGAL fails with: " + "; ".join(sorted(reasons)) if reasons else "CGAL: compas_cgal"
    if not taken:
        return [], note
    return [summary("CGAL (compas_cgal)", taken, failed, len(outlines))], note


def table(outlines: list[Outline]) -> list[Row]:
    """Which type of roof applies to which outlines, with all checks."""
    rng = np.random.default_rng(7)
    courts = {number for number, over in enumerate(outlines) if len(over.ring_offsets) > 2}
    rows: list[Row] = []
    for kind in TYPES:
        sound: set[int] = set()
        for number, over in enumerate(outlines):
            try:
                made = solid(kind, over)
            except _core.RoofFault:
                continue
            if not faults(made, over, rng):
                sound.add(number)
        rows.append(
            {
                "type": kind,
                "without courts": len(sound - courts),
                "with courts": len(sound & courts),
                "all": len(sound),
            }
        )
    return rows


def publish(rows: list[Row], outlines: list[Outline]) -> None:
    """Puts the table into docs/roofs.md, between its marks."""
    courts = sum(len(over.ring_offsets) > 2 for over in outlines)
    lines = [
        f"| Type | of {len(outlines) - courts} without courts | of {courts} with courts "
        f"| of {len(outlines)} |",
        "|---|---|---|---|",
        *("| " + " | ".join(str(value) for value in row.values()) + " |" for row in rows),
    ]
    text = DOCS.read_text()
    head, rest = text.split("<!-- applies -->")
    tail = rest.split("<!-- /applies -->")[1]
    table_text = "\n".join(lines)
    DOCS.write_text(f"{head}<!-- applies -->\n{table_text}\n<!-- /applies -->{tail}")


def main() -> None:
    """Both tables."""
    path = DATA / FOOTPRINTS
    if not path.is_file():
        sys.exit(f"there is no {path}: set VEDUTA_DATA to the folder that has it")
    outlines = read_outlines(path)
    publish(table(outlines), outlines)
    taken = [times_ms(over) for over in outlines]
    rows = [summary("veduta", taken, 0, len(outlines))]
    beside, note = cgal(outlines)
    notes = [
        f"Veduta: a closed solid, checked, medians of {RUNS} calls from Python, on the clock. "
        "CGAL: the skeleton alone, best of up to 5 calls, CPU time.",
        note,
        "polyskel and bpypolyskel are in no package index; the crate straight-skeleton is GPL and "
        "computes on a grid of 16-bit integers.",
    ]
    record("roofs", rows + beside, notes)


if __name__ == "__main__":
    main()
