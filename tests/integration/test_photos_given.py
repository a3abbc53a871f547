"""`veduta photos` with what may be given beside photos, and with photos of every sort."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pycolmap
import pytest
from command_line import read_json, refused, veduta
from photo_scene import ARC, FOCAL_PX, HEIGHT_PX, WIDTH_PX, Pose, take_photo
from photos_truth import centre_errors
from PIL import Image
from PIL.ExifTags import GPS, IFD, Base

from veduta.photos.intake.call import plan_call
from veduta.photos.intake.given import Given
from veduta.run.errors import InputError

QUICK = ("--lens", "pinhole", "--principal-point", "middle", "--max-features", "1500")
TRUTH = {f"view{number}.png": np.array(pose.eye) for number, pose in enumerate(ARC)}


def write_true_model(folder: Path) -> Path:
    """The true cameras of the scene, and points on its walls where they are seen."""
    rng = np.random.default_rng(0)
    points = rng.uniform(0.2, 2.5, (60, 3))
    points[np.arange(60), rng.integers(0, 2, 60)] = 0.0
    model = pycolmap.Reconstruction()
    params = [FOCAL_PX, FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2]
    camera = pycolmap.Camera(
        camera_id=1, model="PINHOLE", width=WIDTH_PX, height=HEIGHT_PX, params=params
    )
    model.add_camera_with_trivial_rig(camera)
    tracks = [pycolmap.Track() for _ in points]
    for number, pose in enumerate(ARC):
        cam = np.column_stack([pose.rotation, -pose.rotation @ pose.eye])
        seen = camera.img_from_cam(points @ cam[:, :3].T + cam[:, 3])
        image = pycolmap.Image(
            name=f"view{number}.png", keypoints=seen, camera_id=1, image_id=number + 1
        )
        model.add_image_with_trivial_frame(image, pycolmap.Rigid3d(cam))
        for row, track in enumerate(tracks):
            track.add_element(number + 1, row)
    for point, track in zip(points, tracks, strict=True):
        model.add_point3D(point, track, np.zeros(3, np.uint8))
    folder.mkdir()
    model.write_binary(folder)
    return folder


def found_centres(out: Path) -> dict[str, np.ndarray]:
    model = pycolmap.Reconstruction(out / "sparse" / "0")
    return {image.name: image.projection_center() for image in model.images.values()}


def test_a_model_is_taken_and_given_back(tmp_path: Path, scene: Path) -> None:
    """Its cameras are true; and what is written can be taken in again, as text, too."""
    model = write_true_model(tmp_path / "model")
    done = veduta("photos", scene, "--from-colmap", model, "-o", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert "6 of 6 photos calibrated, 60 points, 0.00 px off" in done.stdout
    assert centre_errors(found_centres(tmp_path / "out"), TRUTH).max() < 1e-6
    report = read_json(tmp_path / "out" / "report.json")
    assert [step["name"] for step in report["steps"]] == [
        "read",
        "given model",
        "walls",
        "georeference",
        "pictures",
        "pictures of walls",
        "write",
    ]
    assert any("not adjusted" in note for note in report["notes"])
    for path in (tmp_path / "out" / "sparse" / "0").glob("*.bin"):
        path.unlink()
    again = veduta("photos", scene, "--from-colmap", tmp_path / "out", "-o", tmp_path / "again")
    assert again.returncode == 0, again.stderr
    assert centre_errors(found_centres(tmp_path / "again"), TRUTH).max() < 1e-6


def test_bad_use_of_a_model(tmp_path: Path, scene: Path) -> None:
    model = write_true_model(tmp_path / "model")
    wrong: dict[str, tuple[Path | None, Given]] = {
        "holds no COLMAP model": (scene, Given(from_colmap=scene)),
        "Leave out --masks": (scene, Given(from_colmap=model, masks=scene)),
        "takes photos, not a film": (None, Given(from_colmap=model, video=scene / "view0.png")),
        "is not given": (None, Given(from_colmap=model)),
    }
    for words, (folder, given) in wrong.items():
        with pytest.raises(InputError, match=words):
            plan_call(folder, given)
    (model / "points3D.bin").unlink()
    done = refused("photos", scene, "--from-colmap", model, "-o", tmp_path / "out")
    assert done.returncode == 2, done.stdout
    assert "points3D.bin: is missing. Copy it to where the others lie" in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_mask_of_another_size(tmp_path: Path, scene: Path) -> None:
    (tmp_path / "masks").mkdir()
    Image.new("L", (99, 77), 255).save(tmp_path / "masks" / "view2.png")
    done = refused("photos", scene, "--masks", tmp_path / "masks", "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "view2.png: is 99 x 77 px, and its photo view2.png 480 x 360 px" in done.stderr
    assert "Save the mask in the size" in done.stderr
    assert not (tmp_path / "out").exists()


def test_all_the_same_photo(tmp_path: Path) -> None:
    (tmp_path / "photos").mkdir()
    for quality in (60, 75, 90):
        path = tmp_path / "photos" / f"{quality}.jpg"
        Image.fromarray(take_photo(ARC[0])).save(path, quality=quality)
    done = refused("photos", tmp_path / "photos", "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "holds 1 photo that can be used, of 3" in done.stderr
    assert "shows the same picture as 60.jpg" in done.stderr


@pytest.mark.slow
def test_photos_of_every_sort(tmp_path: Path, scene: Path) -> None:
    """Two sizes, two cameras, EXIF that cannot be true, a file that is cut, and a mask."""
    folder = tmp_path / "mixed"
    folder.mkdir()
    absurd = Image.Exif()
    absurd[Base.Make], absurd[Base.Model] = "Canon", "Canon EOS 5D"
    absurd.get_ifd(IFD.Exif)[Base.FocalLength] = 1e6
    absurd.get_ifd(IFD.GPSInfo).update(
        {GPS.GPSLatitudeRef: "N", GPS.GPSLatitude: (99.0, 0.0, 0.0),
         GPS.GPSLongitudeRef: "E", GPS.GPSLongitude: (2.0, 0.0, 0.0)}
    )  # fmt: skip
    for number in range(6):
        with Image.open(scene / f"view{number}.png") as image:
            if number >= 4:
                image.save(folder / f"view{number}.jpg", quality=97, exif=absurd)
            elif number >= 2:
                image.resize((400, 300), Image.Resampling.BOX).save(folder / f"view{number}.png")
            else:
                image.save(folder / f"view{number}.png")
    (folder / "cut.jpg").write_bytes((folder / "view4.jpg").read_bytes()[:9000])
    mask = np.full((HEIGHT_PX, WIDTH_PX), 255, np.uint8)
    mask[:, :160] = 0
    (tmp_path / "masks").mkdir()
    Image.fromarray(mask).save(tmp_path / "masks" / "view0.png")
    done = veduta("photos", folder, "--masks", tmp_path / "masks", "-o", tmp_path / "out", *QUICK)
    assert done.returncode == 0, done.stderr
    assert "6 of 7 photos calibrated" in done.stdout
    assert "cut.jpg: left out: is trunc" in done.stdout
    notes = read_json(tmp_path / "out" / "report.json")["notes"]
    for words in ("FocalLength 1e+06 mm", "GPS position that cannot", "without a mask"):
        assert any(words in note for note in notes), words
    model = pycolmap.Reconstruction(tmp_path / "out" / "sparse" / "0")
    sizes = {(camera.width, camera.height) for camera in model.cameras.values()}
    assert sizes == {(480, 360), (400, 300)}
    seen = model.find_image_with_name("view0.png").points2D
    assert min(point.xy[0] for point in seen) >= 160.0
    truth = {name if int(name[4]) < 4 else f"{name[:5]}.jpg": eye for name, eye in TRUTH.items()}
    assert 0.0 < centre_errors(found_centres(tmp_path / "out"), truth).mean() < 0.05


def test_a_city_model_that_is_refused_is_said(tmp_path: Path, scene: Path) -> None:
    model = write_true_model(tmp_path / "model")
    ring = [[500_000 + x, 5_500_000 + y] for x, y in ((0, 0), (9, 0), (9, 9), (0, 9), (0, 0))]
    house = {
        "type": "Feature",
        "properties": {"height": 5},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    lots, out = tmp_path / "lots.geojson", tmp_path / "out"
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": [house]}))
    world = ("--model", lots, "--crs", "EPSG:25832", "-o", out)
    no_walls = refused("photos", scene, "--from-colmap", model, *world, "--no-walls")
    assert no_walls.returncode == 2
    assert "--no-walls: leaves nothing to lay onto the facades of --model" in no_walls.stderr
    assert not out.exists()
    done = veduta("photos", scene, "--from-colmap", model, *world)
    assert (done.returncode, done.stderr) == (0, "")
    assert "not laid into the world by the city model: " in done.stdout
    assert "px off on average; not laid into the world" in (out / "report.html").read_text()
    assert not (out / "model.city.json").exists()


@pytest.mark.slow
def test_a_film(tmp_path: Path) -> None:
    """Every third frame is sharp: those are taken, and their cameras are where they were."""
    turns = np.deg2rad(np.linspace(22.0, 68.0, 21))
    eyes = [(6.2 * float(np.cos(turn)), 6.2 * float(np.sin(turn)), 1.7) for turn in turns]
    film = cv2.VideoWriter(
        str(tmp_path / "arc.avi"), cv2.VideoWriter_fourcc(*"MJPG"), 6, (WIDTH_PX, HEIGHT_PX)
    )
    for number, eye in enumerate(eyes):
        frame = take_photo(Pose(eye))
        film.write((frame if number % 3 == 1 else cv2.blur(frame, (5, 5)))[..., ::-1])
    film.release()
    call = ("photos", "--video", tmp_path / "arc.avi", "--video-interval-s", "0.5",
        "-o", tmp_path / "out", *QUICK)  # fmt: skip
    done = veduta(*call)
    # A machine that takes long is told how far it is; nothing else is said there.
    assert done.returncode == 0, done.stderr
    assert "error" not in done.stderr
    assert "warning" not in done.stderr
    assert "7 of 7 photos calibrated" in done.stdout
    names = [f"arc-{number:06d}.jpg" for number in range(1, 21, 3)]
    assert sorted(path.name for path in (tmp_path / "out" / "frames").iterdir()) == names
    truth = {name: np.array(eyes[int(name[4:10])]) for name in names}
    assert 0.0 < centre_errors(found_centres(tmp_path / "out"), truth).mean() < 0.05
    report = read_json(tmp_path / "out" / "report.json")
    assert report["steps"][0]["name"] == "video"
    assert any("7 of 21 frames" in note for note in report["notes"])
    again = veduta(*call)
    assert "is up to date" in again.stdout
