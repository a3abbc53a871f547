"""`veduta photos --model --gcp`: two houses at a corner get their walls from photos of them."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from command_line import read_json, veduta
from photo_scene import ARC, FOCAL_PX, HEIGHT_PX, WIDTH_PX

from veduta.formats.place_json import read_place

EAST, NORTH = 500_000.0, 5_500_000.0
QUICK = ("--lens", "pinhole", "--cameras", "shared", "--principal-point", "middle",
    "--max-features", "1500")  # fmt: skip
PLACES = np.array([[0, 1, 0.5], [0, 2, 2.4], [1.5, 0, 0.4], [2.2, 0, 2.2], [1, 1, 0]], dtype=float)


def write_model(path: Path) -> None:
    """The walls x = 0 and y = 0 of the corner, each of a house of its own, 3 m high."""
    features = []
    for low, high in (((-4.0, 0.0), (0.0, 4.0)), ((0.0, -4.0), (4.0, 0.0))):
        ring = [low, (high[0], low[1]), high, (low[0], high[1]), low]
        placed = [[EAST + x, NORTH + y] for x, y in ring]
        geometry = {"type": "Polygon", "coordinates": [placed]}
        features.append({"type": "Feature", "properties": {"height": 3}, "geometry": geometry})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


def write_control(path: Path) -> None:
    lines = ["EPSG:25832"]
    for number, (x, y, z) in enumerate(PLACES):
        for photo, pose in enumerate(ARC):
            ray = pose.rotation @ (np.array([x, y, z]) - np.array(pose.eye))
            across, down = ray[:2] / ray[2] * FOCAL_PX + (WIDTH_PX / 2, HEIGHT_PX / 2)
            if 0 < across < WIDTH_PX and 0 < down < HEIGHT_PX:
                place = f"{EAST + x} {NORTH + y} {z} {across:.2f} {down:.2f}"
                lines.append(f"{place} view{photo}.png p{number}")
    path.write_text("\n".join(lines))


@pytest.mark.slow
def faults(told: str) -> list[str]:
    """What is wrong, of what is said: a slow machine hears how far it is, too."""
    return [line for line in told.splitlines() if line.startswith(("error", "warning"))]


def test_a_model_that_photos_lie_in_is_textured(tmp_path: Path, scene: Path) -> None:
    write_model(tmp_path / "lots.geojson")
    write_control(tmp_path / "gcp.txt")
    out = tmp_path / "out"
    model = ("--model", tmp_path / "lots.geojson", "--crs", "EPSG:25832")
    told = (*QUICK, *model, "--gcp", tmp_path / "gcp.txt")
    done = veduta("photos", scene, "-o", out, *told)
    assert (done.returncode, faults(done.stderr)) == (0, [])
    measures = read_json(out / "report.json")["measures"]
    assert measures["faces_textured"] >= 2
    assert 0.003 < measures["texel_mean_m"] < 0.05
    place = read_place(out / "place.json")
    assert [part.id for part in place.parts] == ["lot-1", "lot-2", "walls"]
    assert all((out / part.model).is_file() for part in place.parts)
    city = read_json(out / "model.city.json")
    assert all((out / one["image"]).is_file() for one in city["appearance"]["textures"])
    assert all(
        (out / one["image"].replace(".jpg", "_mask.png")).is_file()
        for one in city["appearance"]["textures"]
    )
    shutil.copytree(out / "sparse", tmp_path / "sparse")
    told = ("--from-colmap", tmp_path / "sparse", "--no-texture", *model)
    done = veduta("photos", scene, "-o", out, *told, "--force")
    assert (done.returncode, faults(done.stderr)) == (0, [])
    left = {path.name for path in out.iterdir()}
    assert not left & {"textures", "parts", "model.city.json", "tileset.json", "frames"}
