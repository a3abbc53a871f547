"""Surface models of the right street and of others: which ones does the path of a drive tell apart?

    python benchmarks drive/refused_models FOLDER [SEEDS] [MINUTES]

Streets of boxes, and of whole houses in bends. Each drive looks for itself in the model of its own
street, of another one along the same line and as wide, and of another that is wider by 6 m. The
tests against wrong models are off while it looks, so that all they go by is told; what they would
say stands beside it. FOLDER keeps each row: call it again until it says that all is done.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import record
from synthetic_path import BENDS, MADE, OFF_DEG, OFF_M, TRUCK, Row, made_house

from veduta.drive.read.localise import LocaliseParameters, localise
from veduta.drive.read.loops import close_loops
from veduta.drive.read.rivals import sharpness_of
from veduta.drive.read.scan_chain import ScanChain, chain_scans
from veduta.drive.read.surface_model import SurfaceModel, read_surface_model
from veduta.run.errors import NotFoundError
from veduta.synthetic.drives import (
    MadeStreet,
    MadeStreetOptions,
    Street,
    StreetOptions,
    build_street,
    make_street,
    scan_street,
)
from veduta.synthetic.drives.surface import surface_of, write_surface

LENGTH_M, WIDE_M, WIDER_M, APART = 200.0, 11.0, 17.0, 5000
FIRST, CHOSEN = 400, 3
OPEN = replace(LocaliseParameters(), least_margin=-np.inf, least_sharp=0.0, sharp_alike=0.0)
MODELS = {"its own": (0, WIDE_M), "another, as wide": (APART, WIDE_M), "another": (APART, WIDER_M)}
NOTES = [
    f"{LENGTH_M:.0f} m of street; houses: by the facade generator and by rules, in bends of"
    f" {BENDS.radius_m:.0f} m; the start is {OFF_M:.0f} m and {OFF_DEG:.0f} degrees off. Another:"
    f" other houses along the same line, {WIDER_M:.0f} m from the path instead of {WIDE_M:.0f}.",
    f"Margin: how much of the path's fit no place around has. Sharpness: of the points near edges,"
    " the share on them (a third by chance). Refused: a margin below"
    f" {OPEN.unique} with a sharpness below {LocaliseParameters().sharp_alike}, a margin below"
    f" {LocaliseParameters().least_margin}, or a sharpness below"
    f" {LocaliseParameters().least_sharp}.",
    f"The first and the third were chosen on seeds {FIRST} to {FIRST + CHOSEN - 1}; the others are"
    " unseen.",
]


def street_of(kind: str, seed: int, front_m: float) -> Street | MadeStreet:
    """Of boxes, or of whole houses."""
    if kind == "boxes":
        return build_street(StreetOptions(length_m=LENGTH_M, front_m=front_m), seed)
    options = MadeStreetOptions(length_m=LENGTH_M, way=BENDS, front_m=front_m)
    return make_street(options, seed, lru_cache(made_house))


def model_of(street: Street | MadeStreet, seed: int) -> SurfaceModel:
    """As a drive reads it."""
    with tempfile.TemporaryDirectory() as name:
        heights, low = surface_of(street, 1.0, seed)
        write_surface(heights, low, Path(name) / "surface.tif")
        return read_surface_model(Path(name) / "surface.tif", TRUCK.height_m)


def driven(street: Street | MadeStreet, seed: int) -> tuple[ScanChain, NDArray[np.float64]]:
    """The matched horizontal scans, and (s, 3, 4) where they were taken."""
    scans = scan_street(street, MADE if isinstance(street, MadeStreet) else TRUCK, seed)
    if scans.level_ranges is None:
        raise ValueError("the truck has no scanner that looks level")
    ranges = scans.level_ranges.astype(np.float64)
    angles = np.deg2rad(TRUCK.beam_step_deg) * np.arange(ranges.shape[1])
    beams = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    met = (ranges >= 0.5) & (ranges < TRUCK.farthest_m)
    chain = chain_scans(
        np.ascontiguousarray((beams * row[:, None])[own])
        for row, own in zip(ranges, met, strict=True)
    )
    return chain, scans.world_from_vehicle


def looked_for(chain: ScanChain, poses: NDArray[np.float64], model: SurfaceModel, seed: int) -> Row:
    """What the tests go by where the drive settles in a model, and how far off that is."""
    random = np.random.default_rng(seed)
    away = random.uniform(0.0, 2.0 * np.pi)
    x, y = poses[0, :2, 3] + OFF_M * np.array([np.cos(away), np.sin(away)])
    heading = np.deg2rad(90.0 + OFF_DEG * random.choice([-1.0, 1.0]))
    reach = (25.0, 25.0, float(np.deg2rad(30.0)))
    _, loops = close_loops(chain)
    start = (float(x), float(y), float(heading))
    try:
        found = localise(chain, model, start, reach, seed, loops, parameters=OPEN)
    except NotFoundError as error:
        return {"told": f"refused before: {error}"[:100]}
    off = np.linalg.norm(found.poses[:, :2] - poses[chain.keys, :2, 3], axis=1)
    return {
        "margin": found.margin.share,
        "sharpness": sharpness_of(found.poses, chain.scans, model),
        "mean off (m)": float(off.mean()),
    }


def told(row: Row) -> Row:
    """With what the tests say."""
    if "told" in row:
        return row
    rule, margin, sharp = (
        LocaliseParameters(), float(row["margin"] or 0), float(row["sharpness"] or 0),
    )  # fmt: skip
    refused = sharp < rule.least_sharp or margin < rule.least_margin
    refused |= margin < rule.unique and sharp < rule.sharp_alike
    return row | {"told": "refused" if refused else "followed"}


def main() -> None:
    """Measure, print and keep."""
    folder = Path(sys.argv[1])
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    until = time.monotonic() + 60.0 * (float(sys.argv[3]) if len(sys.argv) > 3 else 1e6)
    folder.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    for kind in ("boxes", "houses"):
        for seed in range(FIRST, FIRST + seeds):
            files = {name: folder / f"{kind}-{seed}-{name}.json" for name in MODELS}
            left = [name for name, path in files.items() if not path.is_file()]
            if left:
                chain, poses = driven(street_of(kind, seed, WIDE_M), seed)
            for name in left:
                if time.monotonic() > until:
                    print("not done yet: call again")
                    return
                other, front_m = MODELS[name]
                model = model_of(street_of(kind, seed + other, front_m), seed)
                files[name].write_text(json.dumps(looked_for(chain, poses, model, seed)))
            for name, path in files.items():
                head: Row = {"street": kind, "seed": seed, "model": name}
                head["unseen"] = seed >= FIRST + CHOSEN
                rows.append(told(head | json.loads(path.read_text())))
    record("drive-refused-models", rows, [*NOTES, *counts(rows)])


def counts(rows: list[Row]) -> list[str]:
    """Of each kind of street and model, how many are refused."""
    found = []
    for kind, name in dict.fromkeys((row["street"], row["model"]) for row in rows):
        own = [row for row in rows if row["street"] == kind and row["model"] == name]
        refused = [str(row["told"]).startswith("refused") for row in own]
        unseen = [one for one, row in zip(refused, own, strict=True) if row["unseen"]]
        near = sum(
            row["told"] == "followed" and float(row["mean off (m)"] or 0.0) < 1.0 for row in own
        )
        found.append(
            f"{kind}, {name}: {sum(refused)} of {len(own)} refused, {sum(unseen)} of {len(unseen)}"
            f" of the unseen; {near} followed within 1 m of the true path."
        )
    return found


if __name__ == "__main__":
    main()
