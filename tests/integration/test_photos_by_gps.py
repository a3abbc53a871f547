"""`veduta photos` laid into the world by positions alone: the model is textured; a rough place."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from command_line import read_json, veduta
from photo_scene import ARC
from test_photos_given import write_true_model

from veduta.formats.place_json import read_place

EAST, NORTH = 500_000.0, 5_500_000.0
LARGE = 20.0
"""Photos do not say how large things are: the corner of 3 m is one of 60, on which GPS is fine."""
ELSEWHERE_M = (0.0, 45.0, -40.0, 35.0, -45.0, 40.0)
"""How far each position lies off, to and fro."""


def _positions(path: Path, off_m: tuple[float, ...] = (0.3, -0.4, 0.2, 0.4, -0.3, -0.2)) -> Path:
    lines = ["EPSG:25832"]
    for number, (pose, off) in enumerate(zip(ARC, off_m, strict=True)):
        x, y, z = LARGE * np.array(pose.eye)
        lines.append(f"view{number}.png {EAST + x + off:.2f} {NORTH + y - off:.2f} {z:.2f}")
    path.write_text("\n".join(lines) + "\n")
    return path


def _model(path: Path, away_m: float = 0.0) -> Path:
    """A house at each wall of the corner, 60 m high; away_m: how far all lie from there."""
    features = []
    for low, high in (((-4.0, 0.0), (0.0, 4.0)), ((0.0, -4.0), (4.0, 0.0))):
        ring = [low, (high[0], low[1]), high, (low[0], high[1]), low]
        placed = [[EAST + away_m + LARGE * x, NORTH + away_m + LARGE * y] for x, y in ring]
        shape = {"type": "Polygon", "coordinates": [placed]}
        features.append({"type": "Feature", "properties": {"height": 3 * LARGE}, "geometry": shape})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


@pytest.mark.slow
def test_a_model_is_textured_where_positions_alone_say_where(tmp_path: Path, scene: Path) -> None:
    cameras = ("--from-colmap", write_true_model(tmp_path / "model"), "--georef", "gps")
    given = ("--model", _model(tmp_path / "lots.geojson"), "--crs", "EPSG:25832")
    out = tmp_path / "out"
    placed = ("--positions", _positions(tmp_path / "geo.txt"))
    done = veduta("photos", scene, "-o", out, *cameras, *given, *placed)
    assert done.returncode == 0, done.stderr
    report = read_json(out / "report.json")
    assert report["measures"]["georeferenced"] == "gps"
    assert report["measures"]["faces_textured"] >= 2
    place = read_place(out / "place.json")
    assert {"lot-1", "lot-2"} <= {part.id for part in place.parts}
    city = read_json(out / "model.city.json")
    shares = [
        surface["seen_share"]
        for thing in city["CityObjects"].values()
        for shape in thing.get("geometry", ())
        for surface in shape["semantics"]["surfaces"]
        if "seen_share" in surface
    ]
    assert max(shares) > 0.5
    eyes = np.array([camera.transform[12:15] for camera in place.cameras]) + place.origin
    true = LARGE * np.array([pose.eye for pose in ARC]) + (EAST, NORTH, 0.0)
    assert np.linalg.norm(eyes - true, axis=1).max() < 3.0


@pytest.mark.slow
def test_a_poor_place_is_taken_only_where_it_is_asked_for(tmp_path: Path, scene: Path) -> None:
    model = write_true_model(tmp_path / "model")
    called = ("--from-colmap", model, "--no-walls")
    called = (*called, "--positions", _positions(tmp_path / "geo.txt", ELSEWHERE_M))
    refused = veduta("photos", scene, "-o", tmp_path / "auto", *called)
    assert refused.returncode == 0, refused.stderr
    assert read_json(tmp_path / "auto" / "report.json")["measures"]["georeferenced"] != "gps"
    assert read_place(tmp_path / "auto" / "place.json").crs is None
    rough = veduta("photos", scene, "-o", tmp_path / "rough", *called, "--georef", "rough")
    assert rough.returncode == 0, rough.stderr
    assert "the place is rough" in rough.stdout
    assert read_place(tmp_path / "rough" / "place.json").crs == "EPSG:32632"
    found = read_json(tmp_path / "rough" / "georef.json")["components"][0]
    assert found["accepted"] == "gps"
    (tried,) = found["tried"]
    left = [one["distance_m"] for one in tried["best"]["residuals"]]
    deviation = max(tried["best"]["shift_sd_m"])
    assert deviation >= np.sqrt(np.mean(np.square(left))) - 0.01
    assert deviation > 5.0
