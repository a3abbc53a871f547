"""Whether rendered photos of a street are laid into a city model rightly, or refused: whole runs.

    python benchmarks photos/registration_rendered WORK [--seeds 0 1 2 ...] [--keep]

A street of six or more houses is rendered as 40 photos with lens distortion, changing exposure,
noise and a GPS that is 5 m wrong. Structure from motion runs once a street; the model of that
street and the model of another one, laid to the same place, are each tried with GPS and without.
What is done is kept in WORK, and a second call goes on from there.
"""

from __future__ import annotations

import argparse
import io
import json
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from record import Row, keep_or_print
from registration_scores import MOST_DEG, MOST_M, Tried, row_of
from scipy.spatial.transform import Rotation
from street_sets import IMAGES, StreetSet, write_model, write_set

from veduta.formats.place_json import read_place
from veduta.synthetic.streets.plan import plan_street

STREETS = 20
OTHER = 1000
MODEL = "model.city.json"
LAID = ("--force", "--georef", "model", "--no-texture", "--wall-side-px", "128")
"""Pictures of walls take half of the time, and nothing here looks at them."""
NOTES = (
    f"right: accepted, the photos within {MOST_M} m of their true places in the mean, which"
    f" includes what structure from motion has wrong, and turned by {MOST_DEG} degrees"
    " at most in the mean of all. wrong: accepted, but not so.",
    "Not in the model: the model is that of another street, laid to the same place.",
    "Without GPS: the same photos without EXIF.",
)


@dataclass(frozen=True, kw_only=True)
class Outcome(Tried):
    """In the street's own model or not, with GPS or without; why: what was said of it."""

    in_model: bool
    gps: bool
    why: str
    placed: int = 0


def street(seed: int, work: Path) -> list[Outcome]:
    """The outcomes of one street; from its file where it was run before."""
    folder = work / f"street-{seed}"
    done = folder / "outcomes.json"
    if done.exists():
        return [
            Outcome(
                **{name: one[name] for name in ("in_model", "gps", "seconds")},
                **measured(folder, one["in_model"], one["gps"]),
            )
            for one in json.loads(done.read_text())
        ]
    if not (folder / MODEL).exists():
        write_set(StreetSet(seed), folder)
    write_model(plan_street(seed + OTHER), _made(folder / "other"))
    _without_exif(folder / IMAGES, folder / "bare")
    found = folder / "structure"
    if not (found / "report.json").exists():
        veduta(folder / IMAGES, found, "--georef", "off", "--no-walls")
    outcomes = [
        register(folder, in_model, gps) for in_model in (True, False) for gps in (True, False)
    ]
    done.write_text(json.dumps([asdict(one) for one in outcomes], indent=1))
    return outcomes


def register(folder: Path, in_model: bool, gps: bool) -> Outcome:
    """Lay the structure that was found into a model."""
    model = (folder if in_model else folder / "other") / MODEL
    given = ("--from-colmap", str(folder / "structure" / "sparse" / "0"), "--model", str(model))
    started = time.perf_counter()
    veduta(folder / _photos(gps), _out(folder, in_model, gps), *given, *LAID)
    seconds = time.perf_counter() - started
    return Outcome(in_model=in_model, gps=gps, seconds=seconds, **measured(folder, in_model, gps))


def measured(folder: Path, in_model: bool, gps: bool) -> dict[str, Any]:
    """Whether the fit was accepted, and how far off it is."""
    out = _out(folder, in_model, gps)
    georef = json.loads((out / "georef.json").read_text())["components"][0]
    found = {"accepted": georef["accepted"] == "model", "why": georef["tried"][0]["why"]}
    if not found["accepted"]:
        return found
    error_m, error_deg, placed = errors(folder, out, georef)
    return found | {"error_m": error_m, "error_deg": error_deg, "placed": placed}


def errors(folder: Path, out: Path, georef: dict[str, Any]) -> tuple[float, float, int]:
    """Mean distance of the photos (m), the turn of all together (degrees), how many there are."""
    truth = json.loads((folder / "truth.json").read_text())
    true = {photo["name"]: photo for photo in truth["photos"]}
    apart = np.array(georef["origin"]) - np.array(truth["origin_m"])
    cameras = read_place(out / "place.json").cameras
    found = [np.array(camera.transform).reshape(4, 4).T for camera in cameras]
    wanted = [true[camera.name] for camera in cameras]
    distances = [
        np.linalg.norm(one[:3, 3] + apart - np.array(photo["position_m"]))
        for one, photo in zip(found, wanted, strict=True)
    ]
    # Places along a street say little of how it is turned about itself: the photos' own turns do.
    turns = [
        one[:3, :3] @ np.array(photo["cam_from_world"])[:3, :3]
        for one, photo in zip(found, wanted, strict=True)
    ]
    turn = Rotation.from_matrix(np.array(turns)).mean().magnitude()
    return float(np.mean(distances)), float(np.rad2deg(turn)), len(cameras)


def _out(folder: Path, in_model: bool, gps: bool) -> Path:
    return folder / f"{_photos(gps)}-{folder.name if in_model else 'other'}"


def _photos(gps: bool) -> str:
    return IMAGES if gps else "bare"


def veduta(photos: Path, out: Path, *options: str) -> None:
    """One call of the command; a run that was killed goes on."""
    program = [sys.executable, "-m", "veduta.cli.main", "photos", str(photos), "-o", str(out)]
    subprocess.run([*program, *options, "--quiet"], check=True)


def _without_exif(photos: Path, bare: Path) -> None:
    """The same photos (to the pixel) without what the camera noted."""
    _made(bare)
    for path in sorted(photos.iterdir()):
        with Image.open(path) as photo:
            written = io.BytesIO()
            photo.save(written, "JPEG", quality="keep", exif=b"")
        (bare / path.name).write_bytes(written.getvalue())


def _made(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def rows(found: list[Outcome]) -> list[Row]:
    """A row for each kind of model, with and without GPS."""
    return [
        _row(
            in_model,
            gps,
            [one for one in found if (one.in_model, one.gps) == (in_model, gps)],
        )
        for in_model in (True, False)
        for gps in (True, False)
    ]


def _row(in_model: bool, gps: bool, found: list[Outcome]) -> Row:
    fewest = min((one.placed for one in found if one.accepted), default=None)
    return {**row_of(in_model, gps, found), "fewest photos placed": fewest}


def main() -> None:
    """Measure, and print or keep the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("work", type=Path)
    parser.add_argument("--seeds", type=int, nargs="+", default=list(range(STREETS)))
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    found = []
    for seed in given.seeds:
        found += street(seed, given.work)
        for one in found[-4:]:
            print(seed, one, flush=True)
    run = f"Seeds: {', '.join(str(seed) for seed in given.seeds)}."
    keep_or_print("registration-rendered", rows(found), (*NOTES, run), given.keep)


if __name__ == "__main__":
    main()
