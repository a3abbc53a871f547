"""Whether photos of a street are laid into a city model rightly, or refused: simulated structure.

    python benchmarks photos/registration [--seeds 20] [--keep]

For each kind of street: with GPS that is 5 m wrong and without, in the model and not in it.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from record import Row, keep_or_print
from registration_found import found_street, part_street
from registration_scores import MOST_DEG, MOST_M, Tried, row_of
from registration_streets import SimulatedStreet, simulated_street

from veduta.photos.world.georeference import Georeference
from veduta.photos.world.gps_fit import gps_georeference
from veduta.photos.world.gps_positions import GpsPositions
from veduta.photos.world.prior import PlacementPrior
from veduta.photos.world.register import register

KINDS: dict[str, Callable[[int], SimulatedStreet]] = {
    "both sides": lambda seed: simulated_street(seed, sides=2),
    "one side": lambda seed: simulated_street(seed, sides=1),
    "a bent street, walls found": found_street,
    "parts of a bent street": part_street,
}
NOTES = (
    "Towns of 96 boxes in four streets; 40 photos of one street, of about eight houses. Points are"
    " noisy, walls have rough edges, some are missing and some are none, and the model is drawn"
    " 0.07 m (one deviation) off in each measure. Nothing is rendered.",
    "A bent street, walls found: of the project's own planner, seven to eleven houses and thirty"
    " around; the points warp by some centimetres, and the walls are those that `veduta photos`"
    " finds in them.",
    "Parts of a bent street: 24 photos of a car on a third of the street, ahead, to the left and"
    " back: rows go on beyond what they show. GPS is 1.4 m wrong, and hangs together to .3 m.",
    f"right: accepted, the photos within {MOST_M} m in the mean and {MOST_DEG} degrees. wrong:"
    " accepted, but not so. Not in the model: the houses of the street are taken out of it.",
)


@dataclass(frozen=True, kw_only=True)
class Outcome(Tried):
    """margin: nats by which the fit is likelier than the second best; NaN without one."""

    margin: float


def outcome(street: SimulatedStreet, *, in_model: bool, gps: bool) -> Outcome:
    """One street in one model."""
    started = time.perf_counter()
    model = street.model if in_model else street.removed
    found = register(street.structure, street.walls, model, _prior(street) if gps else None, 0)
    seconds = time.perf_counter() - started
    error_m, error_deg = errors(street, found)
    margin = float("nan")
    if found.best is not None and found.second is not None:
        margin = found.best.score - found.second.score
    return Outcome(
        accepted=found.accepted,
        error_m=error_m,
        error_deg=error_deg,
        margin=margin,
        seconds=seconds,
    )


def errors(street: SimulatedStreet, found: Georeference) -> tuple[float, float]:
    """Mean distance of the photos (m), and the angle between the rotations (degrees)."""
    if found.best is None:
        return float("nan"), float("nan")
    got, true = found.best.world_from_model, street.world_from_model
    centres = street.structure.centres()
    apart = np.linalg.norm(got.moved(centres) - true.moved(centres), axis=1)
    cosine = (np.trace(got.rotation.T @ true.rotation) - 1.0) / 2.0
    return float(apart.mean()), float(np.rad2deg(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _prior(street: SimulatedStreet) -> PlacementPrior | None:
    rows = np.arange(len(street.centres_gps))
    positions = GpsPositions(
        street.model.crs or "",
        street.model.origin_m,
        rows,
        street.centres_gps[:, :2],
        street.centres_gps[:, 2],
    )
    return gps_georeference(street.structure, positions, 0)[1]


def rows(seeds: int, only: str | None = None) -> list[Row]:
    """A row for each kind of street, of model, and with and without GPS."""
    found: dict[tuple[str, bool, bool], list[Outcome]] = {}
    for kind, made in KINDS.items():
        if only not in (None, kind):
            continue
        for seed in range(seeds):
            street = made(seed)
            for in_model in (True, False):
                for gps in (True, False):
                    one = outcome(street, in_model=in_model, gps=gps)
                    found.setdefault((kind, in_model, gps), []).append(one)
    return [_row(kind, in_model, gps, all_of) for (kind, in_model, gps), all_of in found.items()]


def _row(kind: str, in_model: bool, gps: bool, found: list[Outcome]) -> Row:
    least = _least([one.margin for one in found if one.accepted])
    return {"photographed": kind, **row_of(in_model, gps, found), "least margin nats": least}


def _least(margins: list[float]) -> float | None:
    known = [margin for margin in margins if np.isfinite(margin)]
    return min(known, default=None)


def main() -> None:
    """Measure, and print or keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--kind", choices=KINDS, help="this kind of street alone")
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    name = "registration"
    if arguments.kind:  # of its own: the table of all kinds stays
        name += "-" + arguments.kind.split()[0]
    keep_or_print(name, rows(arguments.seeds, arguments.kind), NOTES, arguments.keep)


if __name__ == "__main__":
    main()
