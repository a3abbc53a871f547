"""`veduta photos` laid into the world by ground control points; references that cannot be used."""

from __future__ import annotations

import json
from pathlib import Path

import laspy
import numpy as np
import pytest
from command_line import read_json, refused, veduta
from photo_scene import ARC, FOCAL_PX, HEIGHT_PX, WIDTH_PX

from veduta.formats.place_json import read_place

ORIGIN = np.array([500_000.0, 5_500_000.0, 100.0])
QUICK = ("--lens", "pinhole", "--cameras", "shared", "--principal-point", "middle",
    "--max-features", "1500")  # fmt: skip
PLACES = np.array([[0, 1, 0.5], [0, 2, 2.4], [1.5, 0, 0.4], [2.2, 0, 2.2], [1, 1, 0]], dtype=float)


def control(path: Path) -> Path:
    """Where the points truly lie in the photos, in pixels of two decimals."""
    lines = ["EPSG:25832"]
    for number, place in enumerate(PLACES):
        x, y, z = place + ORIGIN
        for photo, pose in enumerate(ARC):
            ray = pose.rotation @ (place - np.array(pose.eye))
            across, down = ray[:2] / ray[2] * FOCAL_PX + (WIDTH_PX / 2, HEIGHT_PX / 2)
            if 0 < across < WIDTH_PX and 0 < down < HEIGHT_PX:
                lines.append(f"{x} {y} {z} {across:.2f} {down:.2f} view{photo}.png p{number}")
    path.write_text("\n".join(lines))
    return path


@pytest.mark.slow
def test_control_points_make_everything_metres(tmp_path: Path, scene: Path) -> None:
    out = tmp_path / "out"
    done = veduta("photos", scene, "-o", out, *QUICK, "--gcp", control(tmp_path / "gcp.txt"))
    assert (done.returncode, done.stderr) == (0, "")
    assert "in EPSG:25832 by ground control points" in done.stdout
    place = read_place(out / "place.json")
    assert (place.crs, place.scale) == ("EPSG:25832", "metres")
    eyes = np.array([camera.transform[12:15] for camera in place.cameras]) + place.origin
    errors = np.linalg.norm(eyes - ORIGIN - np.array([pose.eye for pose in ARC]), axis=1)
    # By themselves six photos know their focal length to a few per cent, and so their distance:
    # they are adjusted to the points.
    assert errors.max() < 0.15
    notes = read_json(out / "report.json")["notes"]
    assert any("adjusted to 5 control points" in note for note in notes)
    component = read_json(out / "georef.json")["components"][0]
    assert component["accepted"] == "gcp"
    assert len(component["tried"][0]["best"]["residuals"]) == 5
    cloud = laspy.read(out / "points.laz")
    middle = np.median(np.asarray(cloud.xyz), axis=0)
    assert np.abs(middle - ORIGIN).max() < 5.0
    assert cloud.header.parse_crs().to_epsg() == 25832


def test_references_that_cannot_be_used(tmp_path: Path, scene: Path) -> None:
    ring = [[0, 0], [50, 0], [50, 50], [0, 0]]
    feature = {
        "type": "Feature",
        "properties": {"height": 9},
        "geometry": {"type": "Polygon", "coordinates": [[[1000 + x, 2000 + y] for x, y in ring]]},
    }
    model = tmp_path / "lots.geojson"
    model.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    for arguments, told in (
        (("--model", model), "Add --crs with its EPSG code"),
        (("--model", tmp_path / "missing.gml"), "missing.gml: does not exist"),
        (("--georef", "gcp"), "Add --gcp FILE"),
        (("--crs", "EPSG:25832"), "Give --model, too"),
    ):
        done = refused("photos", scene, "-o", tmp_path / "out", *arguments)
        assert done.returncode == 2
        assert told in done.stderr
        assert not (tmp_path / "out").exists()
