"""How well photos are placed: real photos whose cameras are known.

    python benchmarks photos/photos [fountain-P11] [lund-door]

Reads `photos/` of $VEDUTA_DATA (else ../shared/data). Writes two tables: the run, and what each
kind of camera would have given (held-out error beside the true one), for each set.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pycolmap
from photos_truth import Centres, centre_errors, colmap_centres, extent, fountain_centres
from record import Row, record

from veduta.photos.cameras.lens import choose_lens, with_cameras
from veduta.photos.options import CameraOptions
from veduta.photos.structure import Structure, adjusted, structure_of

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data")) / "photos"
SETS = ("fountain-P11", "lund-door")
BOUND_MM = {"fountain-P11": 4.5}
"""Mean error of the camera positions that is wanted (mm)."""
RUN_NOTES = (
    "Errors are distances of the camera positions from the known ones after the similarity that"
    " fits best. The reference of lund-door was made by other software and has no metres.",
    "`largest process GiB`: peak resident size of the process that had the largest; while features"
    " are looked for there are as many processes as cores.",
    "Times are of a machine that may have had other work; the errors are not touched by that.",
)
KIND_NOTES = (
    "Each kind of camera adjusted to the photos, points and matches that `veduta photos` found. The"
    " choice sees the held-out error alone; the error of the positions is the truth.",
    "`held out`: observations. What was clearly worse on some of five parts saw no more of them.",
)


def truth(name: str) -> Centres:
    """Where the photos of a set were taken."""
    if name == "fountain-P11":
        return fountain_centres(DATA / name / "cameras")
    return colmap_centres(DATA / name / "colmap_ground_truth" / "images.txt")


def run(name: str, out: Path) -> Row:
    """One set through the command, with its time and memory."""
    command = [sys.executable, "-m", "veduta.cli.main", "photos", str(DATA / name / "images")]
    started = time.perf_counter()
    process = subprocess.Popen([*command, "-o", str(out), "--quiet"])
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - started
    if status:
        raise RuntimeError(f"veduta photos ended with status {status} on {name}")
    report = json.loads((out / "report.json").read_text())
    measures, steps = report["measures"], report["steps"]
    true = truth(name)
    errors = centre_errors(_centres(_structure(out)), true)
    bound = BOUND_MM.get(name)
    mean_mm = 1000 * float(errors.mean())
    metric = name == "fountain-P11"
    return {
        "set": name,
        "photos": measures["photos"],
        "calibrated": measures["calibrated"],
        "mean error mm": mean_mm if metric else None,
        "bound mm": bound,
        "met": None if bound is None else "yes" if mean_mm <= bound else "**missed**",
        "largest error mm": 1000 * float(errors.max()) if metric else None,
        "mean error, ‰ of the cameras' extent": 1000 * float(errors.mean()) / extent(true),
        "reprojection px": measures["error_px"],
        "points": measures["points"],
        "lens": f"{measures['lens']}, {measures['cameras']}, {measures['principal_point']}",
        "s per photo": seconds / measures["photos"],
        **{f"{step['name']} s": step["seconds"] for step in steps},
        "largest process GiB": usage.ru_maxrss / 2**20,
    }


def kinds(name: str, out: Path) -> list[Row]:
    """Every kind of camera on the photos and points that the run found."""
    structure, true = _structure(out), truth(name)
    # One group, as a person who took all photos with one camera would have it.
    groups = dict.fromkeys(structure.image_ids, 1)
    choice = choose_lens(structure, CameraOptions(), groups, seed=0)
    rows: list[Row] = []
    for candidate in choice.tried:
        kind = candidate.kind
        free = kind.principal_point == "free"
        fitted = adjusted(with_cameras(structure, kind, groups), free_principal_point=free)
        errors = centre_errors(_centres(fitted), true)
        rows.append(
            {
                "set": name,
                "lens": kind.lens,
                "cameras": kind.sharing,
                "principal point": kind.principal_point,
                "numbers": candidate.parameters,
                "held out": len(candidate.errors_px),
                "held-out error px": candidate.error_px,
                "mean error, ‰ of the cameras' extent": 1000 * float(errors.mean()) / extent(true),
                "mean error mm": 1000 * float(errors.mean()) if name in BOUND_MM else None,
                "taken": "yes" if kind == choice.kind else "",
            }
        )
    return rows


def _structure(out: Path) -> Structure:
    model = pycolmap.Reconstruction(out / "sparse" / "0")
    return structure_of(model, {image: model.images[image].name for image in model.images})


def _centres(structure: Structure) -> Centres:
    return dict(zip(structure.names, structure.centres(), strict=True))


def main() -> None:
    """Measure the sets, each to results of its own."""
    parser = argparse.ArgumentParser()
    parser.add_argument("sets", nargs="*", metavar="SET", help=", ".join(SETS), default=SETS)
    names = parser.parse_args().sets
    if unknown := set(names) - set(SETS):
        parser.error(f"no set {', '.join(sorted(unknown))}; there are {', '.join(SETS)}")
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            out = Path(folder) / name
            record(f"photos-{name}", [run(name, out)], RUN_NOTES)
            record(f"photos-{name}-cameras", kinds(name, out), KIND_NOTES)


if __name__ == "__main__":
    main()
