"""`veduta fauna` with an animal that has legs, painted markers on it, from the side."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from command_line import refused

from veduta.cli.main import main
from veduta.formats.gltf_chunks import glb_chunks
from veduta.formats.mesh_glb_read import read_model
from veduta.place.mesh import Mesh
from veduta.synthetic.animals import Filmed, film_quadruped

PAINT = {"front_toe_left": "#1ee63c", "hind_toe_left": "#2850f0", "nose": "#e6281e"}
PAD = 20
"""The frames have a rim that is cropped away."""


@pytest.fixture(scope="module")
def filmed() -> Filmed:
    return film_quadruped(100, frames=18, cycle=12.0)


@pytest.fixture(scope="module")
def record(filmed: Filmed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Frames at half the size, with masks and painted joints."""
    folder = tmp_path_factory.mktemp("film")
    for name in ("frames", "masks"):
        (folder / name).mkdir()
    for row, (frame, mask) in enumerate(zip(filmed.frames, filmed.masks, strict=True)):
        painted = frame.copy()
        for joint, colour in PAINT.items():
            x, y = filmed.joints[joint][row] - 0.5
            rgb = tuple(int(colour[k : k + 2], 16) for k in (1, 3, 5))
            cv2.circle(painted, (round(x * 16), round(y * 16)), 80, rgb, -1, cv2.LINE_AA, 4)
        small = cv2.resize(painted, (320, 180), interpolation=cv2.INTER_AREA)
        rimmed = cv2.copyMakeBorder(small, PAD, 0, PAD, 0, cv2.BORDER_CONSTANT, value=(90, 0, 90))
        cv2.imwrite(str(folder / "frames" / f"{row:03d}.png"), rimmed[..., ::-1])
        flat = cv2.resize(mask.astype(np.uint8) * 255, (320, 180), interpolation=cv2.INTER_AREA)
        cv2.imwrite(str(folder / "masks" / f"{row:03d}.png"), flat)
    lines = [f'{joint} = "{colour}"' for joint, colour in PAINT.items()]
    (folder / "markers.toml").write_text("\n".join(lines) + "\n")
    return folder


def test_painted_footage_becomes_a_walking_animal(
    filmed: Filmed, record: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    call = ["fauna", str(record / "frames"), "-o", str(out), "--kind", "quadruped", "--quiet"]
    call += ["--masks", str(record / "masks"), "--markers", str(record / "markers.toml")]
    assert main([*call, "--crop", str(PAD), str(PAD), "320", "180"]) == 0
    report = json.loads((out / "report.json").read_text())
    assert report["measures"]["silhouette_iou_median"] > 0.85
    assert report["measures"]["joints_marked_share"] > 0.9
    assert report["measures"]["cycle_s"] == pytest.approx(12.0 / 25.0, rel=0.04)
    rows = (out / "joints.csv").read_text().splitlines()
    names = rows[1].split(",")
    column = names.index("front_toe_left")
    cells = [row.split(",")[column : column + 2] for row in rows[3:]]
    places = np.array([[float(cell or "nan") for cell in pair] for pair in cells])
    wanted = 0.5 * filmed.joints["front_toe_left"] + PAD
    assert np.nanmedian(np.linalg.norm(places - wanted, axis=1)) < 1.5
    model = read_model(out / "parts" / "frames.glb")
    assert isinstance(model, Mesh)
    walk = model.clips[0]
    assert walk.loops
    assert {one.foot for one in walk.contacts} >= {"front_leg_left", "hind_leg_right"}
    told = glb_chunks((out / "animal.glb").read_bytes()).root
    first = told["scenes"][0]["nodes"][0]
    assert told["nodes"][first]["name"] == "frames armature"
    assert "contact front_leg_left" in {node["name"] for node in told["nodes"]}


def test_markers_of_an_animal_without_legs_are_refused(record: Path, tmp_path: Path) -> None:
    said = refused(
        "fauna", record / "frames", "-o", tmp_path / "out", "--markers", record / "markers.toml"
    )
    assert "is read by its axis alone" in said.stderr


def test_a_crop_beside_the_frames_is_refused(record: Path, tmp_path: Path) -> None:
    said = refused(
        "fauna", record / "frames", "-o", tmp_path / "out", "--crop", "300", "0", "100", "100"
    )
    assert "--crop 300 0 100 100 is no piece" in said.stderr
