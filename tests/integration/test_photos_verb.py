"""`veduta photos` on a small scene with known cameras: results, bad input, and kills."""

from __future__ import annotations

import json
import signal
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from command_line import (
    DEADLINE_S,
    is_running,
    read_json,
    refused,
    running,
    started_by,
    veduta,
    wait_for,
)
from photo_scene import ARC, Pose, write_photos
from photos_truth import centre_errors
from PIL import Image

from veduta.formats.place_json import read_place

QUICK = ("--lens", "pinhole", "--cameras", "shared", "--principal-point", "middle",
    "--max-features", "1500")  # fmt: skip
CAMERAS = (*QUICK, "--no-walls")
"""Where it is about cameras alone."""
FILES = {
    ".veduta", "sparse", "pictures", "walls", "points.ply", "points.laz", "walls.json",
    "georef.json", "place.json", "report.json", "report.html",
}  # fmt: skip


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory, scene: Path) -> Path:
    folder = tmp_path_factory.mktemp("photos") / "out"
    done = veduta("photos", scene, "-o", folder, *QUICK)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert "6 of 6 photos calibrated" in done.stdout
    assert f"veduta view {folder}" in done.stdout
    return folder


def centre_errors_mm(out: Path) -> np.ndarray:
    model = pycolmap.Reconstruction(out / "sparse" / "0")
    found = {image.name: image.projection_center() for image in model.images.values()}
    true = {f"view{number}.png": np.array(pose.eye) for number, pose in enumerate(ARC)}
    return 1000 * centre_errors(found, true)


@pytest.mark.slow
def test_the_cameras_are_where_they_were(out: Path) -> None:
    """The arc is 6 m in radius: 2 cm are a third of a per cent."""
    errors = centre_errors_mm(out)
    assert len(errors) == 6
    assert 0.0 < errors.mean() < 20.0


@pytest.mark.slow
def test_all_files_are_there_and_agree(out: Path) -> None:
    assert {file.name for file in out.iterdir()} == FILES
    assert {file.name for file in (out / ".veduta").iterdir()} == {"run.json", "lock"}
    place = read_place(out / "place.json")
    report = read_json(out / "report.json")
    model = pycolmap.Reconstruction(out / "sparse" / "0")
    assert place.scale == "unknown"
    assert [camera.name for camera in place.cameras] == [f"view{n}.png" for n in range(6)]
    assert place.points[0].count == report["measures"]["points"] == model.num_points3D()
    assert report["measures"]["calibrated"] == 6
    assert [step["name"] for step in report["steps"]] == [
        "read", "features", "match", "map", "cameras", "walls", "georeference", "pictures",
        "pictures of walls", "write",
    ]  # fmt: skip
    for camera in place.cameras:
        assert Image.open(out / camera.picture).size == (camera.width_px, camera.height_px)
        image = model.find_image_with_name(camera.name)
        world_from_camera = np.array(camera.transform).reshape(4, 4).T
        cam_from_world = np.vstack([image.cam_from_world().matrix(), [0, 0, 0, 1]])
        assert np.allclose(world_from_camera @ cam_from_world, np.eye(4), atol=1e-9)


@pytest.mark.slow
def test_the_corner_stands_upright(out: Path) -> None:
    """All photos were taken 1.7 m above the floor, at most 4.8 m from each other."""
    place = read_place(out / "place.json")
    centres = np.array([camera.transform[12:15] for camera in place.cameras])
    metre = np.linalg.norm(centres[-1] - centres[0]) / np.linalg.norm(
        np.subtract(ARC[-1].eye, ARC[0].eye)
    )
    assert np.ptp(centres[:, 2]) < 0.04 * metre
    # z = 0 is under all but the lowest points, of which some are false.
    assert 1.6 < np.median(centres[:, 2] / metre) < 2.5


@pytest.mark.slow
def test_up_to_date_and_other_options(out: Path, scene: Path) -> None:
    again = veduta("photos", scene, "-o", out, *QUICK)
    assert again.returncode == 0
    assert "is up to date" in again.stdout
    other = veduta("photos", scene, "-o", out, *QUICK, "--seed", "3")
    assert other.returncode == 2
    assert "other inputs or options" in other.stderr


@pytest.mark.slow
def test_an_export_has_points_and_pictures(out: Path, tmp_path: Path) -> None:
    done = veduta("export", out, "--web", tmp_path / "web")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "web" / "points.ply").read_bytes() == (out / "points.ply").read_bytes()
    assert len(list((tmp_path / "web" / "pictures").iterdir())) == 6


@pytest.mark.slow
def test_photos_that_do_not_belong(tmp_path: Path, scene: Path) -> None:
    """Noise, a copy and a damaged file beside four good photos; and a turned, smaller one."""
    folder = tmp_path / "mixed"
    folder.mkdir()
    for number in range(4):
        (folder / f"view{number}.png").write_bytes((scene / f"view{number}.png").read_bytes())
    (folder / "copy.png").write_bytes((scene / "view1.png").read_bytes())
    (folder / "cut.png").write_bytes((scene / "view2.png").read_bytes()[:5000])
    noise = np.random.default_rng(0).integers(0, 256, (300, 400, 3), dtype=np.uint8)
    Image.fromarray(noise).save(folder / "noise.png")
    done = veduta("photos", folder, "-o", tmp_path / "out", *CAMERAS)
    assert done.returncode == 0, done.stderr
    assert "4 of 7 photos calibrated" in done.stdout
    assert "view1.png: left out: has the content of copy.png" in done.stdout
    assert "cut.png: left out: is trunc" in done.stdout
    assert "noise.png: left out: shares no view" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["no overlap", "no depth"])
def test_photos_that_give_nothing(tmp_path: Path, kind: str) -> None:
    folder = tmp_path / "photos"
    if kind == "no overlap":
        for number in range(3):
            write_photos(folder, (ARC[0],), seed=100 * number)[0].rename(folder / f"{number}.png")
    else:  # the camera only turns
        eye = ARC[2].eye
        write_photos(folder, tuple(Pose(eye, (0.5, 0.5 + 0.3 * n, 1.4)) for n in range(3)))
    done = veduta("photos", folder, "-o", tmp_path / "out", *QUICK)
    assert done.returncode == 3
    assert "no photos hang together" in done.stderr
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["state"] == "failed"
    assert not (tmp_path / "out" / "place.json").exists()
    again = veduta("photos", folder, "-o", tmp_path / "out", *QUICK)
    assert (again.returncode, "up to date" in again.stdout) == (3, True)


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({}, "holds no photos"),
        ({"a.png": 0}, "holds one photo"),
        ({"a.png": 0, "b.png": 0}, "copies are counted once"),
    ],
)
def test_too_few(tmp_path: Path, scene: Path, files: dict[str, int], words: str) -> None:
    folder = tmp_path / "photos"
    folder.mkdir()
    for name, number in files.items():
        (folder / name).write_bytes((scene / f"view{number}.png").read_bytes())
    done = refused("photos", folder, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()


def test_all_at_once_without_focal_lengths(tmp_path: Path, scene: Path) -> None:
    done = veduta("photos", scene, "-o", tmp_path / "out", "--mapping", "global")
    assert done.returncode == 2
    assert "--mapping global: the focal length of 6 of 6 photos is not known" in done.stderr
    assert "--mapping incremental" in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out" / "place.json").exists()


@pytest.mark.slow
def test_stopped_in_the_middle(tmp_path: Path, scene: Path) -> None:
    """By a signal that is heard while pictures are read in other processes."""
    out = tmp_path / "out"
    stages = out / ".veduta" / "photos"
    with running("photos", scene, "-o", out, *CAMERAS, "--jobs", "2") as run:
        wait_for(lambda: len(list(stages.glob("features-*.npz"))) >= 2)
        children = started_by(run.pid)
        run.send_signal(signal.SIGINT)
        _, error = run.communicate(timeout=DEADLINE_S)
    assert run.returncode == 130
    assert "Traceback" not in error
    assert "Aborted" not in error
    assert "the same command does the rest" in error
    wait_for(lambda: not any(is_running(child) for child in children))
    stamps = {path.name: path.stat().st_mtime_ns for path in stages.glob("features-*.npz")}
    assert stamps

    with running("photos", scene, "-o", out, *CAMERAS, "--jobs", "2") as run:
        wait_for(lambda: len(list(stages.glob("features-*.npz"))) == len(ARC))
        kept = {name: (stages / name).stat().st_mtime_ns for name in stamps}
        run.communicate(timeout=DEADLINE_S)
    assert run.returncode == 0
    assert kept == stamps, "what was finished is not made again"
    assert centre_errors_mm(out).mean() < 20.0


@pytest.mark.slow
def test_killed_while_it_maps(tmp_path: Path, scene: Path) -> None:
    """What was matched is kept, and the next run ends with all photos."""
    out = tmp_path / "out"
    stages = out / ".veduta" / "photos"
    with running("photos", scene, "-o", out, *CAMERAS) as run:
        wait_for(lambda: any(stages.glob("*.mapping/round-0/growing-*/[0-9]*")))
        run.send_signal(signal.SIGKILL)
        run.communicate(timeout=DEADLINE_S)
    assert run.returncode == -signal.SIGKILL
    assert len(list(stages.glob("matches-*.db"))) == 1
    done = veduta("photos", scene, "-o", out, *CAMERAS)
    assert done.returncode == 0, done.stderr
    assert "6 of 6 photos calibrated" in done.stdout
    assert centre_errors_mm(out).mean() < 20.0
