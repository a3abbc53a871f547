"""How maps are begun and grown: the first pair, and photo by photo against all at once.

    python benchmarks photos/mapping [fountain-P11] [lund-door] [street] [--work DIR]

Reads `photos/` of $VEDUTA_DATA (else ../shared/data); the street is rendered (20 photos). Features
are few (1,000 px, 3,000 a photo), so that a map takes seconds. Databases are kept in `--work` and
used again. The same matches are mapped in each way, and adjusted in the end as by `veduta photos`.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pycolmap
from photos_truth import Centres, centre_errors, colmap_centres, extent, fountain_centres
from record import Row, keep_or_print
from street_sets import IMAGES, StreetSet, write_set

from veduta.photos.cameras.component import finish_component
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.read import UNKNOWN_FOCAL, ReadPhotos, read_photos
from veduta.photos.mapping import growing
from veduta.photos.mapping.at_once import map_at_once
from veduta.photos.mapping.mapping import Mapped, map_photos
from veduta.photos.matching.features import FeaturesJob, run_features
from veduta.photos.matching.match import match_pairs, write_database
from veduta.photos.matching.pairs import choose_pairs
from veduta.photos.options import CameraOptions, MatchOptions
from veduta.photos.structure import structure_of
from veduta.run.errors import NotFoundError

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data")) / "photos"
SETS = ("fountain-P11", "lund-door", "street")
STREET = StreetSet(seed=7, photos=20, gps=False)
QUICK = MatchOptions(max_side_px=1000, max_features=3000)
FOUNTAIN_FOCAL_PX = 1379.74
"""Of the photos at half size, as surveyed."""
NOTES = (
    "Errors are distances of the camera positions of the largest component from the known ones"
    " after the similarity that fits best; `as mapped`: before the kind of camera is chosen and all"
    " is adjusted once more.",
    "`focal lengths`: what the map begins with. `EXIF`: as the photos state them. `assumed`: 1.2"
    " times the longer side. `view graph`: the engine's calibration from the fundamental matrices."
    " `surveyed`: those of the truth.",
    "Times are of a machine that had other work: they tell factors, not seconds.",
)


@dataclass(frozen=True)
class Way:
    """How a database is mapped, and with which focal lengths."""

    name: str
    focal: str
    map_all: Callable[[Path, Path, Sequence[int], int], Mapped]


def by_engines_pair(database: Path, work: Path, image_ids: Sequence[int], seed: int) -> Mapped:
    """Photo by photo, where no pair is offered: the engine chooses."""
    with patch.object(growing, "weighed_pairs", lambda *_: iter(())):
        return map_photos(database, work, image_ids, seed)


def ways(name: str) -> list[Way]:
    """What is compared on a set."""
    stated = "assumed" if name == "fountain-P11" else "EXIF"
    grown = [
        Way("incremental, engine's pair", stated, by_engines_pair),
        Way("incremental, thesis's pair", stated, map_photos),
    ]
    focals = ["assumed", "view graph", "surveyed" if name == "fountain-P11" else "EXIF"]
    return grown + [Way("global", focal, map_at_once) for focal in focals]


def prepared(name: str, work: Path) -> tuple[Path, ReadPhotos, Centres]:
    """Database, photos and truth of a set."""
    if name == "street":
        place = work / "street"
        if not (place / "outlines.geojson").exists():
            write_set(STREET, place)
        images = place / IMAGES
        told = json.loads((place / "truth.json").read_text())["photos"]
        true: Centres = {photo["name"]: np.array(photo["position_m"]) for photo in told}
    else:
        images = DATA / name / "images"
        true = (
            fountain_centres(DATA / name / "cameras")
            if name == "fountain-P11"
            else colmap_centres(DATA / name / "colmap_ground_truth" / "images.txt")
        )
    read = read_photos(plan_call(images).sources)
    folder = work / f"{name}-matches"
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / f"{photo.image_id}.npz" for photo in read.photos]
    for photo, file in zip(read.photos, files, strict=True):
        if not file.exists():
            run_features(FeaturesJob(photo.path, QUICK, file))
    database = folder / "matches.db"
    if not database.exists():
        write_database(database, read.photos, files, per_photo=False)
    match_pairs(database, choose_pairs(read.photos, QUICK), QUICK, seed=0)
    return database, read, true


def with_focal(database: Path, focal: str, target: Path) -> Path:
    """A copy of a database whose cameras begin with other focal lengths."""
    shutil.copyfile(database, target)
    with pycolmap.Database.open(target) as opened:
        for camera in opened.read_all_cameras():
            if focal in ("assumed", "view graph"):
                camera.focal_length = UNKNOWN_FOCAL * max(camera.width, camera.height)
                camera.has_prior_focal_length = False
            if focal == "surveyed":
                camera.focal_length = FOUNTAIN_FOCAL_PX
                camera.has_prior_focal_length = True
            opened.update_camera(camera)
    if focal == "view graph":
        options = pycolmap.ViewGraphCalibrationOptions()
        options.random_seed = 0
        pycolmap.calibrate_view_graph(target, options)
    return target


def measured(name: str, way: Way, database: Path, read: ReadPhotos, true: Centres) -> Row:
    """One map."""
    ids = [photo.image_id for photo in read.photos]
    with tempfile.TemporaryDirectory() as work:
        source = with_focal(database, way.focal, Path(work) / "own.db")
        started = time.perf_counter()
        mapped = way.map_all(source, Path(work) / "map", ids, 0)
        seconds = time.perf_counter() - started
    row: dict[str, str | int | float | None] = {
        "set": name,
        "map": way.name,
        "focal lengths": way.focal,
        "photos": len(ids),
        "placed": ", ".join(str(model.num_reg_images()) for model in mapped.models),
        "map s": seconds,
    }
    if mapped.starts:
        pair = mapped.starts[0].pair
        names = {photo.image_id: photo.name for photo in read.photos}
        row["first pair"] = f"{names[pair.first]}, {names[pair.second]}"
        row["matches"], row["by a homography"] = pair.matches, pair.planar
        row["rays apart °"] = pair.angle_deg
    return row | (_errors(mapped, read, true) if mapped.models else {})


def _errors(mapped: Mapped, read: ReadPhotos, true: Centres) -> dict[str, float | None]:
    """Of the largest component, as mapped and when all is adjusted."""
    groups = {photo.image_id: photo.group for photo in read.photos}
    names = {photo.image_id: photo.name for photo in read.photos}
    structure = structure_of(mapped.models[0], names)
    unit = 1000.0 / extent(true)

    def mean(centres: np.ndarray, shown: Sequence[str]) -> float:
        return unit * float(centre_errors(dict(zip(shown, centres, strict=True)), true).mean())

    found: dict[str, float | None] = {
        "reprojection px": float(mapped.models[0].compute_mean_reprojection_error()),
        "mean error as mapped, ‰ of the cameras' extent": mean(
            structure.centres(), structure.names
        ),
    }
    try:
        last = finish_component(structure, CameraOptions(), groups, 0).structure
        found["mean error in the end, ‰"] = mean(last.centres(), last.names)
    except NotFoundError:
        found["mean error in the end, ‰"] = None
    return found


def main() -> None:
    """Map the sets in each way."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sets", nargs="*", metavar="SET", help=", ".join(SETS), default=SETS)
    parser.add_argument("--work", type=Path)
    asked = parser.parse_args()
    if unknown := set(asked.sets) - set(SETS):
        parser.error(f"no set {', '.join(sorted(unknown))}; there are {', '.join(SETS)}")
    rows = []
    with tempfile.TemporaryDirectory() as own:
        for name in asked.sets:
            database, read, true = prepared(name, asked.work or Path(own))
            for way in ways(name):
                rows.append(measured(name, way, database, read, true))
                print(rows[-1], flush=True)
    keep_or_print("mapping", rows, NOTES, keep=set(asked.sets) == set(SETS))


if __name__ == "__main__":
    main()
