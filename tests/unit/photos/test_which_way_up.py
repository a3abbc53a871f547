"""Surveys from the air: which way is up, by GPS, gimbal, rows and the ground; and the scale."""

from __future__ import annotations

from datetime import datetime
from io import BytesIO
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from known_structure import known_structure, structure_seen
from numpy.typing import NDArray
from PIL import Image
from pyproj import Transformer
from scipy.spatial.transform import Rotation

from veduta.imaging.read import read_image
from veduta.imaging.shot import Position
from veduta.photos.cameras.component import Component
from veduta.photos.cameras.lens import CameraKind, LensChoice
from veduta.photos.cameras.orient import oriented, transformed
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.report import up_note
from veduta.photos.structure import Structure
from veduta.photos.world.gps_fit import gps_georeference
from veduta.photos.world.gps_positions import gps_positions
from veduta.photos.world.which_way_up import is_held_upright, looks_down, which_way_up

HEIGHT_M, SIDE_M = 60.0, 120.0


def survey(
    seed: int, pitch_deg: float = -90.0, *, turns: bool = True
) -> tuple[Structure, NDArray[np.float64], NDArray[np.float64]]:
    """A village from the air in any frame; its up there, and the true places of the photos."""
    rng = np.random.default_rng(seed)
    ground = np.column_stack([rng.uniform(-90, 90, (2500, 2)), rng.normal(0.0, 0.3, 2500)])
    roofs = np.column_stack([rng.uniform(-60, 60, (900, 2)), rng.uniform(3.0, 9.0, 900)])
    points = np.concatenate([ground, roofs])
    camera = pycolmap.Camera(
        camera_id=1, model="PINHOLE", width=1200, height=900, params=[1000, 1000, 600, 450]
    )
    poses, keypoints, shown, places = [], [], [], []
    for line in range(5):
        for stand in range(6):
            turned = turns and line % 2 == 1
            heading = np.pi if turned else 0.0
            place = np.array([-60.0 + 30.0 * line, -50.0 + 20.0 * stand, HEIGHT_M])
            place += rng.normal(0.0, 1.0, 3)
            pitch = np.deg2rad(pitch_deg) + rng.normal(0.0, 0.01)
            ahead = np.array(
                [-np.sin(heading) * np.cos(pitch), np.cos(heading) * np.cos(pitch), np.sin(pitch)]
            )
            right = np.array([np.cos(heading), np.sin(heading), 0.0])
            rotation = np.stack([right, np.cross(ahead, right), ahead])
            rotation = Rotation.from_rotvec(rng.normal(0.0, 0.01, 3)).as_matrix() @ rotation
            pose = np.column_stack([rotation, -rotation @ place])
            there = points @ rotation.T + pose[:, 3]
            seen = np.full((len(points), 2), -1.0)
            before = there[:, 2] > 1.0
            seen[before] = camera.img_from_cam(there[before])
            inside = ((seen > 0) & (seen < (1200, 900))).all(axis=1)
            poses.append(pose)
            keypoints.append(seen)
            shown.append(np.flatnonzero(inside))
            places.append(place)
    cameras = [camera] * len(poses)
    structure = structure_seen(cameras, poses, points, keypoints, shown)
    turn = Rotation.random(random_state=seed).as_matrix()
    return transformed(structure, 0.137, turn, rng.normal(0, 5, 3)), turn[:, 2], np.array(places)


def component(structure: Structure) -> Component:
    found = oriented(structure)
    kind = CameraKind("pinhole", "shared", "middle")
    return Component(found.structure, LensChoice(kind, ()), found.level_deg)


def records(
    structure: Structure,
    places: NDArray[np.float64] | None,
    noise_m: float = 1.0,
    pitch_deg: float | None = None,
) -> list[PhotoRecord]:
    rng = np.random.default_rng(5)
    to_world = Transformer.from_crs("EPSG:32632", "EPSG:4326", always_xy=True)
    found = []
    for row, name in enumerate(structure.names):
        position = None
        if places is not None:
            x, y, z = places[row] + rng.normal(0.0, noise_m, 3) + (500_000.0, 5_400_000.0, 300.0)
            longitude, latitude = to_world.transform(x, y)
            position = Position(latitude, longitude, z)
        now = datetime(2026, 1, 1)
        found.append(
            PhotoRecord(
                row + 1,
                name,
                Path(name),
                "",
                1200,
                900,
                None,
                None,
                now,
                position,
                1,
                (),
                pitch_deg=pitch_deg,
            )
        )
    return found


def off_deg(found: Component, before: Structure, up: NDArray[np.float64]) -> float:
    """Between z of the result and the true up, by how the cameras were turned."""
    turn = found.structure.cam_from_world[0, :, :3].T @ before.cam_from_world[0, :, :3]
    return float(np.rad2deg(np.arccos(np.clip((turn @ up)[2], -1.0, 1.0))))


@pytest.mark.parametrize("pitch_deg", [-90.0, -60.0, -45.0])
@pytest.mark.parametrize("turns", [True, False])
def test_gps_says_which_way_is_up(pitch_deg: float, turns: bool) -> None:
    structure, up, places = survey(1, pitch_deg, turns=turns)
    found = which_way_up(component(structure), records(structure, places))
    assert off_deg(found, structure, up) < 1.0
    assert looks_down(found.structure)
    assert found.upright is not None
    assert 0.0 < found.upright.sd_deg < 1.0
    assert "from the positions of GPS" in up_note(found)


def test_the_scale_of_a_survey_is_that_of_gps() -> None:
    structure, _, places = survey(2)
    photos = records(structure, places)
    found = which_way_up(component(structure), photos).structure
    positions = gps_positions(found, photos, None, None)
    assert positions is not None
    fit, _ = gps_georeference(found, positions, 0)
    assert fit.accepted, fit.why
    assert fit.best is not None
    own = found.centres()
    true = np.linalg.norm(places[0] - places[-1]) / np.linalg.norm(own[0] - own[-1])
    assert abs(fit.best.world_from_model.scale / true - 1.0) < 0.01


def test_the_ground_says_it_where_photos_turn() -> None:
    """Without GPS: photos whose tops point to all sides look down."""
    for seed in range(3):
        structure, up, _ = survey(seed)
        found = which_way_up(component(structure), records(structure, None))
        assert off_deg(found, structure, up) < 1.0


def test_oblique_photos_of_both_ways_agree_on_the_columns() -> None:
    structure, up, _ = survey(3, -45.0)
    assert off_deg(component(structure), structure, up) < 3.0


@pytest.mark.parametrize("pitch_deg", [-90.0, -60.0])
def test_a_gimbal_says_it(pitch_deg: float) -> None:
    structure, up, _ = survey(4, pitch_deg, turns=False)
    found = which_way_up(component(structure), records(structure, None, pitch_deg=pitch_deg))
    assert off_deg(found, structure, up) < 1.5
    assert looks_down(found.structure)
    assert "from the gimbal" in up_note(found)


def test_the_pitch_of_a_gimbal_is_read(tmp_path: Path) -> None:
    packet = b'<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:Description drone-dji:%s/></x:xmpmeta>'
    for tag, expected in (
        (b'GimbalPitchDegree="-89.90"', -89.9),
        (b'GimbalPitchDegree="+0.00"', 0.0),
        (b'GimbalPitchDegree="-400"', None),
        (b'GimbalYawDegree="-10"', None),
    ):
        data = BytesIO()
        Image.new("RGB", (80, 80), "grey").save(data, "JPEG", xmp=packet % tag)
        (tmp_path / "a.jpg").write_bytes(data.getvalue())
        assert read_image(tmp_path / "a.jpg").shot.pitch_deg == expected


def test_heights_of_gps_do_not_tilt_photos_of_people() -> None:
    """Round a thing, held upright, GPS whose height drifts by a fifth of the way."""
    structure = known_structure()
    drifted = 20.0 * structure.centres()
    drifted[:, 2] += 0.2 * drifted[:, 0]
    before = component(structure)
    found = which_way_up(before, records(structure, drifted, 0.3))
    assert found is before
    assert "people hold cameras level" in up_note(found)
    assert is_held_upright(before.structure)
    assert not is_held_upright(component(survey(1)[0]).structure)
