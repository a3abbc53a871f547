"""Folders of a rig's cameras: frames by name, what does not match, and what rig.json may say."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.photos.idle_options import require_effect
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.given import NOTHING_ELSE, Given
from veduta.photos.intake.read import read_photos
from veduta.photos.mapping.rigs import RigTold, cameras_of, given_poses
from veduta.photos.matching.pairs import choose_pairs
from veduta.photos.options import CameraOptions, MatchOptions, PhotosOptions
from veduta.photos.report_rig import rig_alarms
from veduta.run.errors import InputError


def write(folder: Path, *names: str, size: tuple[int, int] = (80, 70)) -> Path:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        rng = np.random.default_rng(sum(map(ord, name)))
        Image.fromarray(rng.integers(0, 255, (*size[::-1], 3), dtype=np.uint8)).save(path)
    return folder


def test_what_two_cameras_see_alike_are_no_copies(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "left/b.png")
    (tmp_path / "right").mkdir()
    for name in ("a.png", "b.png"):
        (tmp_path / "right" / name).write_bytes((tmp_path / "left" / name).read_bytes())
    call = plan_call(tmp_path, rig=True)
    assert len(call.sources) == 4


def test_a_camera_without_photos_that_can_be_read(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "left/b.png")
    (tmp_path / "right").mkdir()
    (tmp_path / "right" / "a.png").write_bytes(b"no picture")
    call = plan_call(tmp_path, rig=True)
    assert [source.name for source in call.sources if source.name.startswith("left/")]


def test_photos_are_called_by_camera_and_frame(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "left/b.png", "left/c.png", "right/A.png", "right/b.png")
    call = plan_call(tmp_path, rig=True)
    assert [source.name for source in call.sources] == [
        "left/a.png",
        "left/b.png",
        "left/c.png",
        "right/A.png",
        "right/b.png",
    ]
    frames = [source.mount.frame for source in call.sources if source.mount is not None]
    assert frames == ["a", "b", "c", "a", "b"]
    assert call.notes == ("a rig of 2 cameras (left, right): 2 frames have all; right lacks 1 (c)",)
    groups = [photo.group for photo in read_photos(call.sources).photos]
    assert groups == [1, 1, 1, 2, 2]


def test_neighbours_in_order_are_frames(tmp_path: Path) -> None:
    names = [f"{camera}/{frame}.png" for camera in ("l", "r") for frame in range(4)]
    photos = read_photos(plan_call(write(tmp_path, *names), rig=True).sources).photos
    by_id = {photo.image_id: photo.name for photo in photos}
    pairs = choose_pairs(photos, MatchOptions(pairs="sequence", neighbours=1)).pairs
    found = {tuple(sorted((by_id[first], by_id[second]))) for first, second in pairs}
    assert {("l/0.png", "r/0.png"), ("l/0.png", "l/1.png"), ("l/1.png", "r/1.png")} <= found


def test_frames_that_do_not_match_are_named(tmp_path: Path) -> None:
    write(tmp_path, "left/IMG_1.png", "left/IMG_2.png", "right/DSC_7.png", "right/DSC_8.png")
    with pytest.raises(InputError) as caught:
        plan_call(tmp_path, rig=True)
    assert caught.value.subject == str(tmp_path)
    assert "of 2 in left 0 are also in right, which has 2" in caught.value.fault
    assert "left/img_1" in caught.value.fault
    assert "right/dsc_7" in caught.value.fault
    assert "the same name" in caught.value.remedy


def test_two_photos_of_one_frame_are_named(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "left/a.jpg", "right/a.png")
    with pytest.raises(InputError, match="second photo of one frame"):
        plan_call(tmp_path, rig=True)


@pytest.mark.parametrize(
    ("names", "fault"),
    [
        (("a.png", "b.png"), "no folder with photos"),
        (("left/a.png", "left/b.png"), "photos in one folder alone, left"),
    ],
)
def test_a_rig_has_two_folders(tmp_path: Path, names: tuple[str, ...], fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        plan_call(write(tmp_path, *names), rig=True)


def test_folders_without_rig_are_pointed_at(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "right/a.png")
    with pytest.raises(InputError) as caught:
        plan_call(tmp_path)
    assert "--rig" in caught.value.remedy


def test_a_photo_of_another_size_is_set_aside(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "left/b.png", "right/a.png", "right/b.png")
    write(tmp_path, "left/c.png", size=(90, 70))
    read = read_photos(plan_call(tmp_path, rig=True).sources)
    assert read.set_aside == (
        ("left/c.png", "has 90 x 70 px, and the first photo of its camera 80 x 70"),
    )


def test_frames_that_show_one_blank_wall_are_no_copies(tmp_path: Path) -> None:
    for number, name in enumerate(("left/a.png", "left/b.png", "right/a.png", "right/b.png")):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        pixels = np.full((70, 80, 3), 120, dtype=np.uint8)
        pixels[0, number] = 125
        Image.fromarray(pixels).save(tmp_path / name)
    read = read_photos(plan_call(tmp_path, rig=True).sources)
    assert len(read.photos) == 4
    assert read.set_aside == ()


def test_a_file_tells_of_cameras_with_photos_alone(tmp_path: Path) -> None:
    """All photos of the camera up are set aside, as they cannot be read."""
    write(tmp_path, "left/a.png", "left/b.png", "right/a.png", "right/b.png")
    (tmp_path / "up").mkdir()
    (tmp_path / "up" / "a.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    told = {"cam_from_rig_rotation": [1, 0, 0, 0], "cam_from_rig_translation": [0, 1, 0]}
    cameras = [{"image_prefix": f"{name}/", **told} for name in ("right", "up")]
    cameras.append({"image_prefix": "left/", "ref_sensor": True})
    (tmp_path / "rig.json").write_text(json.dumps([{"cameras": cameras}]))
    call = plan_call(tmp_path, rig=True)
    photos = read_photos(call.sources).photos
    assert call.rig is not None
    assert set(call.rig.cam_from_rig) == {"left", "right", "up"}
    poses = given_poses(call.rig, photos)
    assert poses is not None
    assert set(poses.cam_from_rig) == set(cameras_of(photos)) == {"left", "right"}
    alone = given_poses(call.rig, [photo for photo in photos if photo.group == 1])
    assert alone is not None
    assert set(alone.cam_from_rig) == {"left"}
    (alarm,) = rig_alarms(RigTold(None, 2, 2, ("left",)))
    assert "only of left of the rig's cameras" in alarm


def config(**right: object) -> str:
    cameras = [{"image_prefix": "left/", "ref_sensor": True}, {"image_prefix": "right/", **right}]
    return json.dumps([{"cameras": cameras}])


def test_what_a_file_says_of_the_rig(tmp_path: Path) -> None:
    write(tmp_path, "left/a.png", "left/b.png", "right/a.png", "right/b.png")
    turn = Rotation.from_rotvec((0.1, -0.4, 0.2))
    x, y, z, w = turn.as_quat().tolist()
    told = config(cam_from_rig_rotation=[w, x, y, z], cam_from_rig_translation=[-0.5, 0.0, 0.1])
    (tmp_path / "rig.json").write_text(told)
    rig = plan_call(tmp_path, rig=True).rig
    assert rig is not None
    np.testing.assert_allclose(rig.cam_from_rig["left"], np.eye(3, 4))
    np.testing.assert_allclose(rig.cam_from_rig["right"][:, :3], turn.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(rig.cam_from_rig["right"][:, 3], (-0.5, 0.0, 0.1))


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("{", "is no rig: the file: Invalid JSON"),
        ("[]", "describes 0 rigs"),
        (config(), "neither that right is the reference, nor its rotation"),
        (
            config(cam_from_rig_rotation=[2, 0, 0, 0], cam_from_rig_translation=[0, 0, 0]),
            "no unit quaternion",
        ),
        (
            config(cam_from_rig_rotation=[1, 0, 0, 0], cam_from_rig_translation=[np.nan, 0, 0]),
            "has no pose for right",
        ),
        (config(ref_sensor=True).replace("right/", "up/"), "where the camera right is"),
    ],
)
def test_a_file_that_is_no_rig(tmp_path: Path, text: str, fault: str) -> None:
    write(tmp_path, "left/a.png", "right/a.png")
    (tmp_path / "rig.json").write_text(text)
    with pytest.raises(InputError) as caught:
        plan_call(tmp_path, rig=True)
    assert caught.value.subject == str(tmp_path / "rig.json")
    assert fault in caught.value.fault


@pytest.mark.parametrize(
    "given",
    [Given(masks=Path("m")), Given(video=Path("v.mp4")), Given(from_colmap=Path("s"))],
)
def test_a_rig_takes_photos_alone(tmp_path: Path, given: Given) -> None:
    write(tmp_path, "left/a.png", "right/a.png")
    with pytest.raises(InputError, match="--rig"):
        plan_call(tmp_path, given, rig=True)


@pytest.mark.parametrize("other", [{"cameras": "per-photo"}, {"focal_px": 900.0}])
def test_what_has_no_use_beside_a_rig(other: dict[str, object]) -> None:
    options = PhotosOptions(camera=CameraOptions.model_validate({"rig": True, **other}))
    with pytest.raises(InputError, match="no use with --rig"):
        require_effect(options, NOTHING_ELSE)
