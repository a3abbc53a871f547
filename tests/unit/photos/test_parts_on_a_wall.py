"""Two groups of photos that share nothing but a distant wall, some of whose matches are false."""

from __future__ import annotations

import numpy as np
import pycolmap
from known_structure import structure_seen
from numpy.typing import NDArray
from photo_scene import Pose
from photos_truth import centre_errors

from veduta.photos.cameras.component import finish_component
from veduta.photos.options import CameraOptions
from veduta.photos.structure import Structure, adjusted

WIDTH_PX, HEIGHT_PX, FOCAL_PX = 1000, 750, 720.0
SIDE = 5
RADIUS_M = 16.5
TURN_DEG = 16.0
"""False matches agree with the second group turned by so much about the wall."""


def turned(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same, turned about the upright axis through the middle of the wall."""
    middle, turn = np.array([-22.0, 7.0, 0.0]), np.deg2rad(TURN_DEG)
    cos, sin = float(np.cos(turn)), float(np.sin(turn))
    rotation = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return (points - middle) @ rotation.T + middle


def two_groups(false: int) -> tuple[Structure, Structure]:
    """What is seen of a tower from two sides, with the wall behind it, and the truth of it.

    false: of 60 matches of the wall between the groups, those that are false.
    """
    rng = np.random.default_rng(1)
    wall = np.column_stack(
        [np.full(60, -22.0), rng.uniform(3.0, 11.0, 60), rng.uniform(0.0, 14.0, 60)]
    )
    wall[:, 0] += rng.uniform(-0.1, 0.1, 60)
    sides = [rng.uniform((-5.0, -5.0, 0.0), (5.0, 5.0, 9.0), (90, 3)) for _ in range(2)]
    points = np.concatenate([wall, *sides])
    owner = np.repeat([0, 1, 2], [60, 90, 90])
    camera = pycolmap.Camera(
        camera_id=1, model="SIMPLE_PINHOLE", width=WIDTH_PX, height=HEIGHT_PX,
        params=[FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2],
    )  # fmt: skip
    poses, keypoints, numbers = [], [], []
    turns = np.deg2rad([*np.linspace(10.0, 55.0, SIDE), *np.linspace(-75.0, -30.0, SIDE)])
    for photo, turn in enumerate(turns):
        eye = (
            RADIUS_M * float(np.cos(turn)),
            RADIUS_M * float(np.sin(turn)),
            1.6 + 0.3 * (photo % 3),
        )
        pose = Pose(eye, (-4.0, 1.5, 4.0))
        cam = np.column_stack([pose.rotation, -pose.rotation @ pose.eye])
        seen = camera.img_from_cam(points @ cam[:, :3].T + cam[:, 3])
        seen = seen + 0.3 * rng.standard_normal(seen.shape)
        if photo >= SIDE:
            wrong = camera.img_from_cam(turned(points[:false]) @ cam[:, :3].T + cam[:, 3])
            seen[:false] += wrong - camera.img_from_cam(points[:false] @ cam[:, :3].T + cam[:, 3])
        group = photo // SIDE + 1
        inside = ((seen > 0) & (seen < (WIDTH_PX, HEIGHT_PX))).all(axis=1)
        shown = np.flatnonzero(inside & ((owner == 0) | (owner == group)))
        poses.append(cam)
        keypoints.append(seen)
        numbers.append(shown)
    truth = structure_seen([camera] * len(poses), poses, points, keypoints, numbers)
    return adjusted(truth, free_principal_point=False), truth


def apart(found: Structure, truth: Structure) -> float:
    """Largest error of a position after the best similarity, as a share of the ring's radius."""
    ours, theirs = (dict(zip(one.names, one.centres(), strict=True)) for one in (found, truth))
    return float(centre_errors(ours, theirs).max()) / RADIUS_M


def test_false_matches_do_not_turn_a_part_about_the_wall() -> None:
    mapped, truth = two_groups(false=6)
    assert apart(mapped, truth) > 0.025
    groups = dict.fromkeys(mapped.image_ids, 0)
    options = CameraOptions(lens="pinhole", cameras="shared", principal_point="middle")
    found = finish_component(mapped, options, groups, 0)
    assert len(found.structure.names) == 2 * SIDE
    assert apart(found.structure, truth) < 0.015
