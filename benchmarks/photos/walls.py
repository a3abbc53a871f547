"""How many facades of simulated streets are found as walls, and how well.

    python benchmarks photos/walls [--seeds 20] [--drift 0.03] [--noise 0.5] [--per-m2 4]

Structure is simulated (points on facades with recesses and balconies, ground, clutter, false
tracks, drift), in a frame of its own; up is found as `veduta photos` does, from cameras and points.
Runs with other numbers than these are printed and not kept.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from record import Row, keep_or_print
from simulated_street import simulated_street
from walls_truth import Errors, errors_of, in_world, is_false, visible_facades, world_from

from veduta.photos.cameras.orient import oriented
from veduta.photos.cameras.upright import upright
from veduta.photos.options import WallOptions
from veduta.photos.walls.find_walls import find_walls
from veduta.synthetic.streets.simulated import Simulation

NOTES = (
    "`right`: of the visible facades wider than 4 m, those whose plane is within 0.1 m all along"
    " and 1 degree, and whose ends are within 0.3 m. 90 % are wanted. `heights too`: of these,"
    " those whose bottom and top are within 0.3 m, though photos may not reach up to the eaves.",
    "A facade counts as visible from the first to the last place that three photos see; where that"
    " is not its own end, any end between there and its own is right. Facades that lie in one plane"
    " (0.05 m, 0.5 degrees) end to end count as one: no point tells them apart.",
    "Errors hold the drift of the poses; the frame is the true one, not fitted to the walls."
    " `false`: walls more than 0.5 m or 5 degrees off every wall of the street.",
)


def street(seed: int, simulation: Simulation) -> tuple[Row, int, int]:
    """A street's row, its facades, and how many of them are right."""
    _, simulated, structure = simulated_street(seed, simulation)
    structure, up = upright(oriented(structure).structure)
    simulated = world_from(structure.points, simulated)
    started = time.perf_counter()
    found = find_walls(structure, WallOptions(), 0)
    seconds = time.perf_counter() - started
    walls = [in_world(wall, simulated) for wall in found]
    facades = visible_facades(simulated.walls)
    errors = [errors_of(facade, walls) for facade in facades]
    known = [error for error in errors if error is not None]
    right = sum(error.is_right for error in known)
    lean = np.degrees(np.arccos(simulated.world_from_model[1][2, 2]))
    row: Row = {
        "seed": seed,
        "points": len(structure.points),
        "facades": len(facades),
        "found": len(known),
        "plane right": sum(error.plane_is_right for error in known),
        "right": right,
        "heights too": sum(error.is_right and error.height_is_right for error in known),
        **_medians(known),
        "false": sum(is_false(wall, simulated.walls) for wall in walls),
        "up off °": float(lean),
        "up moved °": up.moved_deg,
        "s": seconds,
    }
    return row, len(facades), right


def _medians(errors: list[Errors]) -> dict[str, float | None]:
    if not errors:
        return {"offset m": None, "angle °": None, "ends m": None, "top m": None}
    return {
        "offset m": float(np.median([error.offset_m for error in errors])),
        "angle °": float(np.median([error.angle_deg for error in errors])),
        "ends m": float(np.median([max(error.edges_m) for error in errors])),
        "top m": float(np.median([error.top_m for error in errors])),
    }


def main() -> None:
    """All seeds, and their sum."""
    parser = argparse.ArgumentParser()
    usual = Simulation()
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--drift", type=float, default=usual.drift_m)
    parser.add_argument("--noise", type=float, default=usual.noise_px)
    parser.add_argument("--per-m2", type=float, default=usual.per_m2)
    given = parser.parse_args()
    simulation = Simulation(given.per_m2, given.noise, drift_m=given.drift)
    rows, facades, right = [], 0, 0
    for seed in range(given.first, given.first + given.seeds):
        row, count, good = street(seed, simulation)
        rows.append(row)
        facades, right = facades + count, right + good
    total: Row = {
        "seed": "all",
        "facades": facades,
        **{
            name: sum(int(str(row[name])) for row in rows)
            for name in ("found", "plane right", "right", "heights too", "false")
        },
        "right %": 100.0 * right / max(1, facades),
        "met": "yes" if right >= 0.9 * facades else "**missed**",
    }
    kept = simulation == usual and given.seeds >= 20 and given.first == 0
    keep_or_print("walls", [*rows, total], NOTES, kept)


if __name__ == "__main__":
    main()
