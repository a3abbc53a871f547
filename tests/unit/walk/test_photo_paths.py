"""A single camera's path: depth from neighbouring frames whose cameras are known."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.synthetic.walks.record import GorgeWalk, write_walk
from veduta.synthetic.walks.shoot import WalkCamera
from veduta.walk import command
from veduta.walk.build.photo_depth import FramePlanes
from veduta.walk.command import Sources, run_walk
from veduta.walk.options import PhotoOptions, TakeOptions, WalkOptions
from veduta.walk.photo_record import PhotoRecord, read_photo_record
from veduta.walk.read.photo_path import read_photo_path

WALK = GorgeWalk(keys=4, step_m=0.8, width_px=256, height_px=160)


@pytest.fixture(scope="module")
def frames(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A camera that goes ahead through a gorge, and its cameras in Strecha's form."""
    folder = tmp_path_factory.mktemp("frames")
    cameras = write_walk(folder / "pairs", WALK)
    shutil.move(folder / "pairs" / "left", folder / "photos")
    shutil.move(folder / "pairs" / "depth", folder / "depth")
    _write_cameras(folder / "cameras", cameras)
    return folder


def _write_cameras(folder: Path, cameras: list[WalkCamera]) -> None:
    folder.mkdir()
    for number, one in enumerate(cameras):
        rows = [
            [one.focal_px, 0.0, one.width_px / 2.0 - 0.5],
            [0.0, one.focal_px, one.height_px / 2.0 - 0.5], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0],
            *one.world_from_camera[:3, :3].tolist(), one.world_from_camera[:3, 3].tolist(),
            [one.width_px, one.height_px],
        ]  # fmt: skip
        text = "\n".join(" ".join(str(value) for value in row) for row in rows)
        (folder / f"{number:03d}.png.camera").write_text(text + "\n")


def test_depth_comes_from_the_frames_before_and_after(frames: Path) -> None:
    record = read_photo_record(frames / "photos", frames / "cameras", TakeOptions(), 1000)
    assert record.rig.baseline_m == pytest.approx(0.8, rel=0.05)
    assert isinstance(record, PhotoRecord)
    depth, sure = record._planes.depth(1)
    model = record._model(1, {"depth": depth, "sure": sure})
    true = np.load(frames / "depth" / "001.npy")
    seen = model.measured & np.isfinite(true)
    off = np.abs(model.depth_m / true - 1.0)[seen]
    assert seen.mean() > 0.4
    assert np.median(off) < 0.05
    assert (off < 0.2).mean() > 0.8


def test_a_walk_of_a_single_camera(frames: Path, tmp_path: Path) -> None:
    sources = Sources(cameras=frames / "cameras")
    options = WalkOptions(take=TakeOptions(every=2))
    result = run_walk(
        frames / "photos", tmp_path / "out", options, Progress(quiet=True), sources=sources
    )
    assert result.exit_code == 0
    assert result.doubts == []
    told = json.loads((tmp_path / "out" / "walk.json").read_text())
    (way,) = told["transitions"]
    assert way["kind"] == "morph"
    assert way["distance_m"] == pytest.approx(1.6, rel=0.03)
    assert way["score_db"] > way["unmoved_db"] + 1.0
    assert [one["id"] for one in told["keys"]] == ["000", "002"]


def test_depth_is_kept_when_a_run_is_killed(
    frames: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []
    plain = FramePlanes.depth

    def counted(self: FramePlanes, number: int) -> object:
        asked.append(number)
        return plain(self, number)

    def killed(*args: object, **named: object) -> object:
        raise KeyboardInterrupt

    monkeypatch.setattr(FramePlanes, "depth", counted)
    monkeypatch.setattr(command, "find_way", killed)
    sources = Sources(cameras=frames / "cameras")
    options = WalkOptions(take=TakeOptions(every=2))
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            run_walk(
                frames / "photos", tmp_path / "out", options, Progress(quiet=True), sources=sources
            )
    assert asked == [0, 2]


def test_an_unknown_scale_is_said(frames: Path, tmp_path: Path) -> None:
    """COLMAP's cameras have no unit: neighbouring frames count as one metre apart."""
    _write_colmap(tmp_path / "sparse", frames / "cameras")
    path = read_photo_path(frames / "photos", tmp_path / "sparse", 128)
    assert not path.known
    assert path.rig.width_px == 128
    assert path.rig.baseline_m == pytest.approx(1.0)
    assert path.picture(0).shape == (80, 128, 3)
    options = WalkOptions(take=TakeOptions(every=2), photo=PhotoOptions(largest_px=128))
    sources = Sources(cameras=tmp_path / "sparse")
    result = run_walk(
        frames / "photos", tmp_path / "out", options, Progress(quiet=True), sources=sources
    )
    assert " frame steps: " in result.summary
    assert any("scale is not known" in doubt for doubt in result.doubts)
    for name in ("walk.json", "place.json"):
        assert json.loads((tmp_path / "out" / name).read_text())["scale"] == "unknown"


def _write_colmap(folder: Path, cameras: Path) -> None:
    from scipy.spatial.transform import Rotation

    from veduta.cameras import read_cameras

    folder.mkdir()
    found = read_cameras(cameras)
    lines, lens = [], found.cameras[0]
    for number, one in enumerate(found.cameras, start=1):
        turn, shift = one.cam_from_world[:, :3], one.cam_from_world[:, 3]
        x, y, z, w = Rotation.from_matrix(turn).as_quat()
        numbers = " ".join(str(value) for value in (w, x, y, z, *shift))
        lines += [f"{number} {numbers} 1 {one.name}", ""]
    (folder / "images.txt").write_text("\n".join(lines) + "\n")
    camera = f"1 PINHOLE {WALK.width_px} {WALK.height_px} {lens.focal_px[0]} {lens.focal_px[1]}"
    (folder / "cameras.txt").write_text(f"{camera} {lens.centre_px[0]} {lens.centre_px[1]}\n")
    (folder / "points3D.txt").write_text("")


def test_what_is_wrong_with_frames_is_said(frames: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such folder"):
        read_photo_path(tmp_path / "nowhere", frames / "cameras", 500)
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="has 0 cameras with pictures"):
        read_photo_path(tmp_path / "empty", frames / "cameras", 500)
    one = tmp_path / "one"
    shutil.copytree(frames / "cameras", one)
    text = (one / "001.png.camera").read_text()
    focal = str(WALK.focal_px)
    (one / "001.png.camera").write_text(text.replace(focal, str(1.5 * WALK.focal_px)))
    with pytest.raises(InputError, match="another size or lens"):
        read_photo_path(frames / "photos", one, 500)
    still = tmp_path / "still"
    shutil.copytree(frames / "cameras", still)
    for path in still.iterdir():
        path.write_text((still / "000.png.camera").read_text())
    _write_colmap(tmp_path / "sparse", still)
    with pytest.raises(InputError, match="all cameras in one place"):
        read_photo_path(frames / "photos", tmp_path / "sparse", 500)


def test_a_picture_of_another_size_than_its_camera(frames: Path, tmp_path: Path) -> None:
    photos = tmp_path / "photos"
    shutil.copytree(frames / "photos", photos)
    path = read_photo_path(photos, frames / "cameras", 500)
    Image.open(photos / "002.png").resize((100, 60)).save(photos / "002.png")
    with pytest.raises(InputError, match="is 100 x 60, and its camera 256 x 160"):
        path.picture(2)
