"""Poses of a rig's cameras, read off maps, and kept by all adjustments."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from known_structure import structure_seen
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from veduta.photos.cameras.component import without_weak
from veduta.photos.cameras.orient import transformed
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.intake.source import Mount
from veduta.photos.mapping.rig_poses import agreed, found_poses
from veduta.photos.rigged import rigs_among
from veduta.photos.structure import Structure, adjusted, errors_px, model_of, structure_of

FRAMES = 6
TURN = Rotation.from_rotvec((0.05, 0.5, -0.1)).as_matrix()
TIE = np.column_stack([TURN, -TURN @ (0.4, 0.05, -0.1)])
"""(3, 4) second camera from the first."""


def two_cameras(noise_px: float = 0.0) -> Structure:
    """Photos 1 to 6 of a first camera, 7 to 12 of a second one that is fixed to it."""
    rng = np.random.default_rng(3)
    points = rng.uniform((-4.0, -3.0, 4.0), (5.0, 3.0, 9.0), (700, 3))
    cameras = [
        pycolmap.Camera(
            camera_id=number, model="PINHOLE", width=900, height=700, params=[f, f, 450, 350]
        )
        for number, f in ((1, 700.0), (2, 640.0))
    ]
    firsts = []
    for frame in range(FRAMES):
        turn = Rotation.from_rotvec(rng.normal(0.0, 0.05, 3)).as_matrix()
        firsts.append(np.column_stack([turn, -turn @ (0.5 * frame - 1.0, 0.1, 0.0)]))
    seconds = [
        np.column_stack([TIE[:, :3] @ one[:, :3], TIE[:, :3] @ one[:, 3] + TIE[:, 3]])
        for one in firsts
    ]
    poses, keypoints, shown = [*firsts, *seconds], [], []
    for row, pose in enumerate(poses):
        there = points @ pose[:, :3].T + pose[:, 3]
        seen = np.asarray(cameras[row // FRAMES].img_from_cam(there), float)
        seen = seen + noise_px * rng.standard_normal(seen.shape)
        inside = (there[:, 2] > 0) & ((seen > 0) & (seen < (900, 700))).all(axis=1)
        keypoints.append(seen)
        shown.append(np.flatnonzero(inside))
    by_photo = [cameras[row // FRAMES] for row in range(len(poses))]
    return structure_seen(by_photo, poses, points, keypoints, shown)


def in_frames(structure: Structure) -> Structure:
    frame_of = {image: (image - 1) % FRAMES + 1 for image in structure.image_ids}
    return replace(structure, frame_of=frame_of)


def records(structure: Structure) -> list[PhotoRecord]:
    return [
        PhotoRecord(
            image_id=image,
            name=name,
            path=Path(name),
            sha256="",
            width_px=900,
            height_px=700,
            focal_px=None,
            camera=None,
            time=None,
            position=None,
            group=structure.camera_of[image],
            notes=(),
            mount=Mount("ab"[structure.camera_of[image] - 1], str((image - 1) % FRAMES)),
        )
        for image, name in zip(structure.image_ids, structure.names, strict=True)
    ]


def ties(structure: Structure) -> NDArray[np.float64]:
    """(f, 3, 4) the second camera from the first, in each frame."""
    poses = np.tile(np.eye(4), (len(structure.names), 1, 1))
    poses[:, :3] = structure.cam_from_world
    return np.array([(b @ np.linalg.inv(a))[:3] for a, b in zip(poses[:6], poses[6:], strict=True)])


def test_the_tie_of_a_rig_is_found_though_a_photo_is_placed_falsely() -> None:
    structure = two_cameras()
    poses = structure.cam_from_world.copy()
    poses[8] = np.column_stack([np.eye(3), (9.0, 0.0, 3.0)])
    found = found_poses(replace(structure, cam_from_world=poses), records(structure))
    own, other = (found.cam_from_rig[name] for name in "ab")
    turn = other[:, :3] @ own[:, :3].T
    np.testing.assert_allclose(turn, TURN, atol=1e-9)
    np.testing.assert_allclose(other[:, 3] - turn @ own[:, 3], TIE[:, 3], atol=1e-9)
    assert sorted(found.frames.values()) == [5, 6]
    assert found.unknown == ()


def test_a_camera_that_no_frames_tie_is_unknown() -> None:
    structure = two_cameras()
    few = [replace(one, mount=Mount("b", f"x{one.image_id}")) for one in records(structure)[6:]]
    found = found_poses(structure, [*records(structure)[:6], *few])
    assert found.unknown == ("b",) or found.unknown == ("a",)


def test_frames_that_disagree_tell_nothing() -> None:
    rng = np.random.default_rng(0)
    turns = Rotation.random(8, random_state=1).as_matrix()
    each = np.concatenate([turns, rng.normal(0, 3, (8, 3, 1))], axis=2)
    assert agreed(each, 0.1) is None


def test_all_frames_keep_their_tie_when_all_is_adjusted() -> None:
    noisy = two_cameras(noise_px=0.5)
    free = ties(adjusted(noisy, free_principal_point=False))
    held = adjusted(in_frames(noisy), free_principal_point=False)
    assert np.ptp(free[:, :, 3], axis=0).max() > 1e-4
    np.testing.assert_allclose(ties(held), ties(held)[:1].repeat(FRAMES, axis=0), atol=1e-9)
    assert float(np.median(errors_px(held))) < 0.7
    moved = ties(held)[0] - TIE
    assert 1e-6 < float(np.abs(moved[:, 3]).max()) < 0.02


def test_a_rig_that_is_given_stays_as_it_is() -> None:
    given = replace(in_frames(two_cameras(noise_px=0.5)), rig_held=True)
    held = adjusted(given, free_principal_point=False)
    np.testing.assert_allclose(ties(held), np.tile(TIE, (FRAMES, 1, 1)), atol=1e-9)
    assert float(np.median(errors_px(held))) < 0.7


def test_the_model_has_the_rig_and_gives_it_back() -> None:
    turned = transformed(in_frames(two_cameras()), 2.5, TURN, np.array([1.0, -2.0, 0.5]))
    model = model_of(turned)
    assert sorted(rig.num_sensors() for rig in model.rigs.values()) == [2]
    assert model.num_reg_frames() == FRAMES
    back = structure_of(model, dict(zip(turned.image_ids, turned.names, strict=True)))
    np.testing.assert_allclose(back.cam_from_world, turned.cam_from_world, atol=1e-9)
    frames = {
        frozenset(i for i, f in back.frame_of.items() if f == n) for n in back.frame_of.values()
    }
    assert frames == {frozenset({n, n + FRAMES}) for n in range(1, FRAMES + 1)}


def test_a_photo_without_points_stays_where_its_frame_is_held() -> None:
    structure = in_frames(two_cameras())
    blank = structure.observed(structure.image_of != 9)
    assert len(without_weak(blank)[0].names) == 2 * FRAMES
    alone = replace(blank, frame_of={})
    assert len(without_weak(alone)[0].names) == 2 * FRAMES - 1


@pytest.mark.parametrize("chain", [((1, 2), (2, 3)), ((2, 3), (1, 2))])
def test_cameras_are_tied_over_others(chain: tuple[tuple[int, int], ...]) -> None:
    turns = Rotation.random(3, random_state=4).as_matrix()
    rig = {number: np.column_stack([turns[number - 1], (number, 0.0, 1.0)]) for number in (1, 2, 3)}
    poses, camera_of, frame_of = {}, {}, {}
    for frame, cameras in enumerate(chain):
        body = np.eye(4)
        body[:3, :3], body[:3, 3] = turns[frame], (0.0, frame, 2.0)
        for camera in cameras:
            image = 10 * frame + camera
            inner = np.vstack([rig[camera], (0, 0, 0, 1)]) @ body
            poses[image], camera_of[image], frame_of[image] = inner[:3], camera, frame
    (found,) = rigs_among(poses, camera_of, frame_of)
    whole = {number: np.vstack([pose, (0, 0, 0, 1)]) for number, pose in rig.items()}
    for number, pose in found.cam_from_rig.items():
        np.testing.assert_allclose(pose, (whole[number] @ np.linalg.inv(whole[1]))[:3], atol=1e-9)
    assert [len(members) for members in found.frames.values()] == [2, 2]
