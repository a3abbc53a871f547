"""Panoramas as rigs of their views: alone, beside other cameras, and what is said of them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from known_structure import structure_seen
from noise_room import equirectangular_rays, room, seen
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.imaging.shot import Position
from veduta.photos.cameras.lens import choose_lens, with_cameras
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.panoramas import (
    VIEWS,
    cam_from_panorama,
    focal_of,
    panoramas_among,
    pixel_in_view,
    with_panoramas,
)
from veduta.photos.intake.read import PhotoRecord, read_photos
from veduta.photos.intake.source import Mount, View
from veduta.photos.mapping.panorama_rigs import panorama_rigs, snapped, views_among
from veduta.photos.mapping.rig_database import write_rig_database
from veduta.photos.mapping.rig_poses import found_poses
from veduta.photos.matching.pairs import choose_pairs
from veduta.photos.options import CameraOptions, MatchOptions, PhotosOptions, WallOptions
from veduta.photos.panorama_file import panoramas_in
from veduta.photos.pipeline import run_photos
from veduta.photos.rigged import after, between
from veduta.photos.stages import Stages
from veduta.photos.structure import Structure, adjusted, errors_px
from veduta.photos.world.control_file import ControlPoint, ControlPoints
from veduta.photos.world.control_panoramas import marks_in_views
from veduta.photos.world.gps_fit import gps_georeference
from veduta.photos.world.gps_positions import GpsPositions
from veduta.photos.world.position_file import PhotoPositions, at_positions
from veduta.run.progress import Progress

XMP = b'<x:xmpmeta><rdf:Description GPano:ProjectionType="equirectangular"/></x:xmpmeta>'
FRAMES, SIDE = 5, 400
TURN = Rotation.from_rotvec((0.1, 0.9, -0.05)).as_matrix()
TIE = np.column_stack([TURN, -TURN @ (0.3, 0.25, 0.1)])
"""(3, 4) a camera beside the panorama, from it."""
Floats = NDArray[np.float64]


def view_record(image: int, frame: int, number: int) -> PhotoRecord:
    size = (4 * SIDE, 2 * SIDE)
    return PhotoRecord(
        image_id=image, name=f"p{frame}_view{number}.jpg", path=Path("p"), sha256="",
        width_px=SIDE, height_px=SIDE, focal_px=focal_of(SIDE), camera=None, time=None,
        position=None, group=number + 2, notes=(), mount=Mount(f"around/view{number}", str(frame)),
        view=View(f"p{frame}.jpg", size, "around", number),
    )  # fmt: skip


def beside_record(image: int, frame: int) -> PhotoRecord:
    return PhotoRecord(
        image_id=image, name=f"beside/{frame}.jpg", path=Path("p"), sha256="",
        width_px=900, height_px=700, focal_px=None, camera=None, time=None, position=None,
        group=1, notes=(), mount=Mount("beside", str(frame)),
    )  # fmt: skip


def bodies() -> list[Floats]:
    """(3, 4) of the panoramas from the world."""
    rng = np.random.default_rng(5)
    found = []
    for frame in range(FRAMES):
        turn = Rotation.from_rotvec(rng.normal(0.0, (0.05, 0.6, 0.05))).as_matrix()
        found.append(np.column_stack([turn, -turn @ (0.7 * frame - 1.4, 0.1, 0.2 * frame)]))
    return found


def known_rig(noise_px: float = 0.0, *, beside: bool) -> tuple[Structure, list[PhotoRecord]]:
    """Views of five panoramas all around which points lie, and photos of a camera beside them."""
    rng = np.random.default_rng(4)
    points = rng.normal(0.0, 1.0, (900, 3)) * (1.0, 0.35, 1.0)
    points *= (rng.uniform(4.0, 9.0, 900) / np.linalg.norm(points, axis=1))[:, None]
    focal = focal_of(SIDE)
    cameras = [
        pycolmap.Camera(
            camera_id=number + 2, model="PINHOLE", width=SIDE, height=SIDE,
            params=[focal, focal, SIDE / 2, SIDE / 2],
        )
        for number in range(VIEWS)
    ]  # fmt: skip
    cameras.append(
        pycolmap.Camera(
            camera_id=1, model="PINHOLE", width=900, height=700, params=[640, 640, 450, 350]
        )
    )
    own, poses, photos = [], [], []
    for frame, body in enumerate(bodies()):
        for number in range(VIEWS):
            photos.append(view_record(len(photos) + 1, frame, number))
            own.append(cameras[number])
            poses.append(after(cam_from_panorama(number), body))
    for frame, body in enumerate(bodies() if beside else []):
        photos.append(beside_record(len(photos) + 1, frame))
        own.append(cameras[VIEWS])
        poses.append(after(TIE, body))
    keypoints, shown = [], []
    for camera, pose in zip(own, poses, strict=True):
        there = points @ pose[:, :3].T + pose[:, 3]
        places = np.full((len(points), 2), np.nan)
        ahead = there[:, 2] > 0.1
        places[ahead] = np.asarray(camera.img_from_cam(there[ahead]), float)
        inside = ahead & ((places > 0) & (places < (camera.width, camera.height))).all(axis=1)
        keypoints.append(np.nan_to_num(places) + noise_px * rng.standard_normal(places.shape))
        shown.append(np.flatnonzero(inside))
    structure = structure_seen(own, poses, points, keypoints, shown)
    names = tuple(photo.name for photo in photos)
    frame_of = {photo.image_id: int(photo.mount.frame) + 1 for photo in photos if photo.mount}
    views = views_among(photos)
    return replace(structure, names=names, frame_of=frame_of, views=views), photos


def centres_apart(structure: Structure) -> float:
    """How far views of one panorama are from its first one, at most."""
    centres = structure.centres()
    views = FRAMES * VIEWS
    whole = centres[:views].reshape(FRAMES, VIEWS, 3)
    return float(np.linalg.norm(whole - whole[:, :1], axis=2).max())


def test_the_rig_of_a_panorama_is_as_it_was_cut() -> None:
    _, photos = known_rig(beside=True)
    (rig,) = panorama_rigs(photos)
    assert rig.held
    assert list(rig.cam_from_rig) == [f"around/view{number}" for number in range(VIEWS)]
    ahead = np.array([pose[2, :3] for pose in rig.cam_from_rig.values()])
    np.testing.assert_allclose(ahead[2], (1.0, 0.0, 0.0), atol=1e-12)
    np.testing.assert_allclose([pose[:, 3] for pose in rig.cam_from_rig.values()], 0.0)


def test_panoramas_stay_whole_when_all_is_adjusted() -> None:
    noisy, _ = known_rig(0.4, beside=False)
    found = adjusted(noisy, free_principal_point=False)
    assert centres_apart(found) < 1e-9
    assert all(camera.params[0] == focal_of(SIDE) for camera in found.cameras.values())
    assert errors_px(found).mean() < 0.7
    truth, own = noisy.centres(), found.centres()
    size = np.linalg.norm(own[-1] - own[0]) / np.linalg.norm(truth[-1] - truth[0])
    assert size == pytest.approx(1.0, abs=0.02)


def test_a_camera_beside_a_panorama_is_adjusted_and_the_views_are_not() -> None:
    structure, _ = known_rig(0.4, beside=True)
    poses = structure.cam_from_world.copy()
    wrong = np.column_stack([Rotation.from_rotvec((0.0, 0.01, 0.0)).as_matrix(), (0.02, 0.0, 0.0)])
    poses[FRAMES * VIEWS :] = [after(wrong, pose) for pose in poses[FRAMES * VIEWS :]]
    found = adjusted(replace(structure, cam_from_world=poses), free_principal_point=False)
    assert centres_apart(found) < 1e-9
    ties = np.array(
        [
            between(
                found.cam_from_world[VIEWS * frame], found.cam_from_world[VIEWS * FRAMES + frame]
            )
            for frame in range(FRAMES)
        ]
    )
    np.testing.assert_allclose(ties, np.broadcast_to(ties[0], ties.shape), atol=1e-9)
    np.testing.assert_allclose(ties[0][:, :3], TIE[:, :3], atol=2e-3)


def test_a_camera_is_tied_to_all_views_of_a_panorama() -> None:
    """Also to those that no photo of it was compared with, and by three frames alone."""
    structure, photos = known_rig(beside=True)
    few = structure.without_photos(np.arange(len(photos)) >= len(photos) - 2)
    poses = found_poses(few, photos)
    assert set(poses.cam_from_rig) == {"beside", *(f"around/view{n}" for n in range(VIEWS))}
    tie = between(poses.cam_from_rig["around/view0"], poses.cam_from_rig["beside"])
    np.testing.assert_allclose(tie, TIE, atol=1e-9)
    assert poses.unknown == ()


def test_views_that_a_map_moved_are_one_panorama_again() -> None:
    structure, _ = known_rig(beside=True)
    moved = structure.cam_from_world.copy()
    moved[: FRAMES * VIEWS, :, 3] += np.random.default_rng(0).normal(0, 0.01, (FRAMES * VIEWS, 3))
    found = snapped(replace(structure, cam_from_world=moved))
    assert centres_apart(found) < 1e-9
    np.testing.assert_allclose(found.centres(), structure.centres(), atol=0.02)
    np.testing.assert_array_equal(found.cam_from_world[-1], structure.cam_from_world[-1])


def test_lenses_of_views_are_known_whatever_others_have() -> None:
    alone, photos = known_rig(beside=False)
    groups = {photo.image_id: photo.group for photo in photos}
    choice = choose_lens(alone, CameraOptions(), groups, 0)
    assert choice.tried == ()
    assert choice.kind.lens == "pinhole"
    mixed, photos = known_rig(beside=True)
    groups = {photo.image_id: photo.group for photo in photos}
    choice = choose_lens(mixed, CameraOptions(lens="opencv"), groups, 0)
    assert choice.kind.sharing == "shared"
    cameras = with_cameras(mixed, choice.kind, groups).cameras
    models = [cameras[number].model.name for number in sorted(cameras)]
    assert models == ["OPENCV", *["PINHOLE"] * VIEWS]


def test_views_of_one_panorama_are_not_compared_and_neighbours_are_whole() -> None:
    photos = [view_record(8 * f + n + 1, f, n) for f in range(12) for n in range(VIEWS)]
    whole = {photo.image_id: photo.view.panorama for photo in photos if photo.view}
    for kind in ("all", "sequence"):
        pairs = choose_pairs(photos, MatchOptions.model_validate({"pairs": kind})).pairs
        assert not [pair for pair in pairs if whole[pair[0]] == whole[pair[1]]]
        beside = {pair for pair in pairs if {whole[one] for one in pair} == {"p3.jpg", "p4.jpg"}}
        assert len(beside) == VIEWS * VIEWS
    at = [
        replace(photo, position=Position(52.0 + 1e-4 * int(photo.mount.frame), 8.0, None))
        for photo in photos
        if photo.mount
    ]
    near = choose_pairs(at, MatchOptions(pairs="gps", neighbours=8)).pairs
    assert {(whole[a], whole[b]) for a, b in near} >= {("p3.jpg", "p4.jpg"), ("p3.jpg", "p5.jpg")}
    assert not [pair for pair in near if whole[pair[0]] == whole[pair[1]]]


def test_a_pixel_of_a_panorama_is_one_of_a_view() -> None:
    size = (1600, 800)
    rays = equirectangular_rays(1600)
    for column, row in ((10, 400), (805, 300), (1234, 520), (1599, 380)):
        x, y, z = rays[row, column]
        found = pixel_in_view((column + 0.5, row + 0.5), size, SIDE)
        assert found is not None
        number, (across, down) = found
        local = cam_from_panorama(number)[:, :3] @ np.array([x, -z, y])
        np.testing.assert_allclose(
            (across, down), focal_of(SIDE) * local[:2] / local[2] + SIDE / 2, atol=1e-6
        )
        assert 0.0 <= across <= SIDE
    assert pixel_in_view((800.0, 30.0), size, SIDE) is None


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three panoramas along a room, whose XMP says so but for one, and a camera beside each."""
    found = tmp_path_factory.mktemp("rig")
    textures = room(2)
    rays, small = equirectangular_rays(1200), _pinhole_rays(400, 300, 250.0)
    for number in range(3):
        place = np.array([0.5 * number - 0.5, 0.3 * number - 0.3, 0.0])
        for name in ("around", "beside"):
            (found / name).mkdir(exist_ok=True)
        pixels = seen(textures, place, rays)
        xmp = XMP if number != 1 else b""
        Image.fromarray(pixels).save(found / "around" / f"{number}.jpg", xmp=xmp, quality=95)
        other = seen(textures, place + np.array([0.3, 0.0, 0.1]), small)
        Image.fromarray(other).save(found / "beside" / f"{number}.jpg", quality=95)
    return found


def _pinhole_rays(width: int, height: int, focal: float) -> Floats:
    """(h, w, 3) of a level camera that looks north, 40 degrees to the east."""
    x, y = np.meshgrid(
        (np.arange(width) + 0.5 - width / 2) / focal, (np.arange(height) + 0.5 - height / 2) / focal
    )
    c, s = np.cos(0.7), np.sin(0.7)
    return np.stack([c * x + s, -s * x + c, -y], axis=2)


def test_all_photos_of_a_rigs_camera_are_panoramas_where_one_is(folder: Path) -> None:
    sources = plan_call(folder, rig=True).sources
    found = panoramas_among(sources, asked=False)
    assert [one.source.name for one in found] == [f"around/{number}.jpg" for number in range(3)]


def test_panoramas_of_a_rig_keep_their_frames(folder: Path, tmp_path: Path) -> None:
    options = PhotosOptions(camera=CameraOptions(rig=True))
    call = plan_call(folder, rig=True)
    stages = Stages(tmp_path, call, options)
    stages.open()
    cut = with_panoramas(call, stages)
    photos = read_photos(cut.sources).photos
    frames = {photo.name: photo.mount.frame for photo in photos if photo.mount}
    assert frames["around/1_view5.jpg"] == frames["beside/1.jpg"] == "1"
    control = ControlPoints(
        Path("gcp.txt"),
        "EPSG:32632",
        (
            ControlPoint("a", np.zeros(3), (("around/0.jpg", (605.0, 300.0)),)),
            ControlPoint(
                "b", np.ones(3), (("around/1.jpg", (600.0, 5.0)), ("beside/1.jpg", (5, 6)))
            ),
        ),
    )
    moved, told = marks_in_views(control, cut.sources)
    assert [name for name, _ in moved.points[0].seen] == ["around/0_view0.jpg"]
    assert [name for name, _ in moved.points[1].seen] == ["beside/1.jpg"]
    assert "outside of what the views of around/1.jpg show" in told[0]
    where = PhotoPositions(Path("geo.txt"), {"around/0.jpg": Position(50.0, 8.0, None)})
    placed, _ = at_positions(photos, where)
    assert sum(photo.position is not None for photo in placed) == VIEWS


def test_a_mask_of_a_panorama_is_cut_with_it(folder: Path, tmp_path: Path) -> None:
    call = plan_call(folder / "around")
    black = np.full((600, 1200), 255, np.uint8)
    black[:, 500:700] = 0
    Image.fromarray(black).save(tmp_path / "0.png")
    sources = tuple(
        replace(one, mask=tmp_path / "0.png", mask_sha256="0") if one.name == "0.jpg" else one
        for one in call.sources
    )
    stages = Stages(tmp_path, call, PhotosOptions())
    stages.open()
    cut = with_panoramas(replace(call, sources=sources), stages).sources
    masks = {one.name: one.mask for one in cut}
    assert masks["2_view0.jpg"] is None
    ahead, back = masks["0_view0.jpg"], masks["0_view4.jpg"]
    assert ahead is not None
    assert back is not None
    shown = np.asarray(Image.open(ahead).convert("L"))
    assert shown[:, 150].max() == 0
    assert np.asarray(Image.open(back).convert("L")).min() == 255


def test_a_rig_with_a_panorama_is_placed_whole(folder: Path, tmp_path: Path) -> None:
    """In the room: all views of a panorama in one place, the camera beside it where it is."""
    options = PhotosOptions(
        match=MatchOptions(max_features=900),
        camera=CameraOptions(rig=True, lens="pinhole", principal_point="middle"),
        walls=WallOptions(no_walls=True),
    )
    result = run_photos(folder, tmp_path, options, Progress(quiet=True))
    assert result.exit_code == 0
    assert result.measures["panoramas"] == 3
    assert sorted(result.measures["rig_cameras"]) == ["around", "beside"]
    model = pycolmap.Reconstruction(tmp_path / "sparse" / "0")
    (rig,) = [one for one in model.rigs.values() if one.num_sensors() > 1]
    assert rig.num_sensors() == VIEWS + 1
    places = {image.name: image.projection_center() for image in model.images.values()}
    document = json.loads((tmp_path / "panoramas.json").read_text())
    assert [one["name"] for one in document["panoramas"]] == [f"around/{n}.jpg" for n in range(3)]
    steps = []
    for number, one in enumerate(document["panoramas"]):
        centre = np.array(one["transform"]).reshape(4, 4).T[:3, 3]
        views = [places[f"around/{number}_view{view}.jpg"] for view in range(VIEWS)]
        np.testing.assert_allclose(views, np.broadcast_to(centre, (VIEWS, 3)), atol=1e-6)
        steps.append(centre)
    step = np.linalg.norm(steps[2] - steps[0]) / np.hypot(1.0, 0.6)
    base = np.linalg.norm(places["beside/1.jpg"] - steps[1]) / step
    assert base == pytest.approx(np.hypot(0.3, 0.1), abs=0.03)
    report = json.loads((tmp_path / "report.json").read_text())
    assert any("panoramas.json" in note for note in report["notes"])
    page = (tmp_path / "report.html").read_text()
    assert "around (panorama)" in page


def test_the_file_has_the_panorama_and_not_its_views() -> None:
    structure, _ = known_rig(beside=True)
    found = panoramas_in(structure, 0)
    assert len(found) == FRAMES
    for one, body in zip(found, bodies(), strict=True):
        world = np.array(one["transform"]).reshape(4, 4).T
        np.testing.assert_allclose(np.linalg.inv(world)[:3], body, atol=1e-9)


def test_a_database_holds_several_rigs(tmp_path: Path) -> None:
    structure, photos = known_rig(beside=True)
    source = tmp_path / "matches.db"
    with pycolmap.Database.open(source) as opened:
        for number, camera in structure.cameras.items():
            opened.write_camera(
                pycolmap.Camera({**camera.todict(), "camera_id": number}), use_camera_id=True
            )
            rig = pycolmap.Rig(rig_id=number)
            rig.add_ref_sensor(opened.read_camera(number).sensor_id)
            opened.write_rig(rig, use_rig_id=True)
        for image in structure.image_ids:
            own = pycolmap.Image(
                name=str(image), camera_id=structure.camera_of[image], image_id=image
            )
            opened.write_image(own, use_image_id=True)
            frame = pycolmap.Frame(frame_id=image, rig_id=own.camera_id)
            frame.add_data_id(own.data_id)
            opened.write_frame(frame, use_frame_id=True)
    target = tmp_path / "rigs.db"
    write_rig_database(source, photos, panorama_rigs(photos), target)
    with pycolmap.Database.open(target) as opened:
        rigs = [rig.num_sensors() for rig in opened.read_all_rigs()]
        frames = [len(list(frame.data_ids)) for frame in opened.read_all_frames()]
    assert sorted(rigs) == [1, VIEWS]
    assert sorted(frames) == [1] * FRAMES + [VIEWS] * FRAMES


def test_gps_of_two_panoramas_is_that_of_two_places() -> None:
    """Sixteen photos have it, and nobody knows how far it is off."""
    structure, _ = known_rig(beside=False)
    for frames, accepted in ((2, False), (5, True)):
        rows = np.arange(frames * VIEWS)
        there = structure.centres()[rows][:, [0, 2]] * (1.0, -1.0)
        level = replace(structure, cam_from_world=_z_up(structure.cam_from_world))
        positions = GpsPositions(
            "EPSG:32632", (0.0, 0.0, 0.0), rows, 10.0 * there[:, [0, 1]], np.full(len(rows), np.nan)
        )
        found, _ = gps_georeference(level, positions, 0)
        assert found.accepted == accepted, found.why
        assert ("only 2 panoramas" in found.why) != accepted


def _z_up(poses: Floats) -> Floats:
    """The same in a world whose z is up: y was down."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return np.concatenate([poses[:, :, :3] @ turn, poses[:, :, 3:]], axis=2)
