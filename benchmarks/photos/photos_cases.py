"""The cases of photos that strangers brought, as `veduta photos` makes them from end to end.

    python benchmarks photos/photos_cases [--keep] [--out FOLDER]

The data is `cases/photos`. Walls in the world are measured against the outlines of the model by a
few lines of their own, which share nothing with how they were laid. `tests/regression/
test_photo_cases.py` has the other cases. The results lie in --out for who wants to look at them.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pyproj import Transformer
from record import Row, keep_or_print

from veduta.formats.place_json import read_place
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.from_colmap import given_model
from veduta.photos.intake.given import Given
from veduta.photos.intake.read import read_photos
from veduta.photos.options import ModelOptions, PhotosOptions
from veduta.photos.pipeline import run_photos
from veduta.photos.world.control_file import read_control
from veduta.photos.world.control_fit import control_georeference
from veduta.run.progress import Progress
from veduta.synthetic.streets.shot import tag_position

DATA = Path(os.environ.get("VEDUTA_DATA", "../shared/data")) / "cases" / "photos"
NEAR_M = 0.25
LEAST_EDGE_M = 2.0
NOTES = (
    "itowns: 20 photos of five stations in a street of Paris, cameras given (component A), a model"
    " of outlines. Asked for: accepted with GPS and model, walls within 0.25 m of the outlines,"
    " textured; without GPS still refused.",
    "Walls: the middle of each wall against the lines of outlines that are 2 m long at least,"
    " within 15 degrees of it and beside it.",
    "fountain7: mapped from the photos with all kinds of cameras tried. Asked for: a third of the"
    " run's time at most goes into the choice of cameras (67 % before the issue).",
    "control points: each of six points of fountain7 moved by 1 and by 3 m, both ways along each"
    " axis. Asked for: the right one is named in 66 of 72.",
)
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Street:
    """The photos of the street with GPS or without, its model, and where they were taken."""

    photos: Path
    model: Path
    true_m: dict[str, tuple[float, float]]


def street(folder: Path, *, with_gps: bool) -> Street:
    """Upright photos with the positions of the panoramas' stations in their EXIF."""
    source, photos = DATA / "itowns", folder / "photos"
    photos.mkdir(parents=True)
    known = {one["id"]: one for one in json.loads((source / "panoramicsMetaData.json").read_text())}
    to_degrees = Transformer.from_crs(2154, 4326, always_xy=True)
    true = {}
    for path in sorted((source / "images").iterdir()):
        station = int(path.stem[-7:])
        place, name = known[station], f"st{station}_c{path.stem.split('-')[2]}.jpg"
        exif = Image.Exif()
        if with_gps:
            east, north = to_degrees.transform(place["easting"], place["northing"])
            tag_position(exif, north, east, float(place["altitude"]))
        with Image.open(path) as image:
            image.rotate(180).save(photos / name, quality=90, exif=exif)
        true[name] = (place["easting"], place["northing"])
    outlines = json.loads((source / "buildingFootprint.json").read_text())
    outlines.pop("crs")
    model = folder / "model.geojson"
    model.write_text(json.dumps(outlines))
    return Street(photos, model, true)


def itowns(out: Path, *, with_gps: bool) -> Row:
    """The street laid into its model, or not."""
    folder = out.with_name(f"{out.name}-given")
    shutil.rmtree(folder, ignore_errors=True)
    given = street(folder, with_gps=with_gps)
    options = PhotosOptions(world=ModelOptions(model=given.model, crs="EPSG:2154"))
    cameras = Given(from_colmap=DATA / "itowns" / "sparse0")
    run_photos(given.photos, out, options, Progress(quiet=True), given=cameras, force=True)
    edges = outline_edges(json.loads(given.model.read_text()))
    place, measures = read_place(out / "place.json"), report_of(out)["measures"]
    told: dict[str, Any] = {
        "case": f"itowns {'with' if with_gps else 'without'} GPS",
        "laid by": measures["georeferenced"] or "refused",
        "faces textured": measures.get("faces_textured", 0),
    }
    if place.crs is None:
        return told
    eyes = np.array([one.transform[12:14] for one in place.cameras]) + place.origin[:2]
    true = np.array([given.true_m[Path(one.name).name] for one in place.cameras])
    walls = json.loads((out / "walls.json").read_text())["walls"]
    off = sorted(wall_distance_m(one, edges, np.array(place.origin[:2])) for one in walls)
    return {
        **told,
        "cameras off, m": float(np.linalg.norm(eyes - true, axis=1).mean()),
        "walls": len(off),
        "within 0.25 m": sum(one <= NEAR_M for one in off),
        "nearest four, m": ", ".join(f"{one:.2f}" for one in off[:4]),
    }


def report_of(out: Path) -> dict[str, Any]:
    """What the run says of itself; also of one that was done before."""
    report: dict[str, Any] = json.loads((out / "report.json").read_text())
    return report


def outline_edges(outlines: dict[str, Any]) -> list[Floats]:
    """(2, 2) ends of the longer lines of all outlines."""
    rings = [
        np.array(ring)[:, :2]
        for feature in outlines["features"]
        for polygon in feature["geometry"]["coordinates"]
        for ring in polygon
    ]
    edges = [np.stack(pair) for ring in rings for pair in zip(ring[:-1], ring[1:], strict=True)]
    return [edge for edge in edges if np.linalg.norm(edge[1] - edge[0]) > LEAST_EDGE_M]


def wall_distance_m(wall: dict[str, Any], edges: list[Floats], origin_m: Floats) -> float:
    """From the middle of a wall to the nearest line that runs as it does, beside it."""
    ends = np.array([wall["start"][:2], wall["end"][:2]]) + origin_m
    along, middle = ends[1] - ends[0], ends.mean(axis=0)
    found = [np.inf]
    for first, last in edges:
        way = (last - first) / np.linalg.norm(last - first)
        cosine = abs(along @ way) / np.linalg.norm(along)
        beside = -3.0 < (middle - first) @ way < np.linalg.norm(last - first) + 3.0
        if cosine > np.cos(np.deg2rad(15.0)) and beside:
            found.append(abs(float((middle - first) @ np.array([-way[1], way[0]]))))
    return min(found)


def camera_choice(out: Path) -> Row:
    """Which share of a run on seven photos goes into choosing the kind of camera."""
    run_photos(DATA / "fountain7", out, PhotosOptions(), Progress(quiet=True), force=True)
    report = report_of(out)
    seconds = {step["name"]: step["seconds"] for step in report["steps"]}
    measures = report["measures"]
    share = seconds["cameras"] / sum(seconds.values())
    return {
        "case": "fountain7",
        "placed": f"{measures['calibrated']} of {measures['photos']}",
        "choice of cameras, share of the run": share,
    }


def blunders() -> Row:
    """Each control point moved in turn: how often the right one is named and left out."""
    call = plan_call(DATA / "fountain7", Given(from_colmap=DATA / "fountain7_sparse"))
    model = given_model(call.models, read_photos(call.sources).photos)
    structure = model.components[0].structure
    good = read_control(DATA / "gcp" / "f_good.txt")
    named = tried = 0
    for row, point in enumerate(good.points):
        for shift in np.concatenate([np.eye(3) * by for by in (-3.0, -1.0, 1.0, 3.0)]):
            moved = replace(point, place_m=np.asarray(point.place_m) + shift)
            points = (*good.points[:row], moved, *good.points[row + 1 :])
            found = control_georeference(structure, replace(good, points=points))
            tried += 1
            alone = found.why.count("is left out") == 1
            named += found.accepted and alone and f"{point.name} is left out" in found.why
    return {"case": "control points of fountain7, one wrong", "named": f"{named} of {tried}"}


def main() -> None:
    """Measure, and print or keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        out = arguments.out or Path(folder)
        rows = [
            itowns(out / "with-gps", with_gps=True),
            itowns(out / "without-gps", with_gps=False),
            camera_choice(out / "fountain7"),
            blunders(),
        ]
    keep_or_print("photos-cases", rows, NOTES, arguments.keep)


if __name__ == "__main__":
    main()
