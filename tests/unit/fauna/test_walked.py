"""An animal on its path: planted feet on slopes, a body that follows the curve, start and stop."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from walking import walking_limbed

from veduta.fauna.build.limbed import build_limbed
from veduta.fauna.build.walker import limbed_walker
from veduta.fauna.document.limbed import Swing
from veduta.fauna.motion import transfer
from veduta.fauna.motion.carried import Joints, composed
from veduta.fauna.motion.figure import Floats
from veduta.fauna.motion.reach import reached_in_space
from veduta.fauna.motion.transfer import TransferLooks, Walked, Walker, walked
from veduta.fauna.motion.whole_path import Pace, curve_of, going

STEEP = np.tan(np.radians(30.0))
GROUNDS: dict[str, Callable[[Floats], Floats]] = {
    "flat": lambda p: np.zeros(len(p)),
    "up": lambda p: STEEP * p[:, 0],
    "down": lambda p: -STEEP * p[:, 0],
    "aside": lambda p: 0.4 * p[:, 1],
    "rough": lambda p: 0.06 * np.sin(3.0 * p[:, 0]) * np.cos(2.5 * p[:, 1]),
}


@pytest.fixture(scope="module")
def walker() -> Walker:
    found = limbed_walker(build_limbed(walking_limbed()))
    assert found is not None
    return found


def _walk(walker: Walker, ground: Callable[[Floats], Floats]) -> Walked:
    x = np.linspace(0.0, 6.0, 60)
    flat = np.column_stack([x, 0.7 * np.sin(0.8 * x)])
    path = np.column_stack([flat, ground(flat)])
    return walked(walker, path, ground, closed=False, looks=TransferLooks())


def _ends(walker: Walker, done: Walked) -> dict[str, Floats]:
    """(t, 3) of each foot's end, from the clip alone."""
    assert walker.skin is not None
    turns = Rotation.from_quat(done.clip.rotations_xyzw.reshape(-1, 4)).as_matrix()
    turns = turns.reshape(*done.clip.rotations_xyzw.shape[:2], 3, 3)
    joints = composed(walker.skin, turns, done.clip.translations_m)
    return {leg.foot.name: joints.ends(leg.joints[-1], leg.end_m) for leg in walker.legs}


@pytest.mark.parametrize("name", list(GROUNDS))
def test_standing_feet_neither_slide_nor_sink(walker: Walker, name: str) -> None:
    done = _walk(walker, GROUNDS[name])
    ends = _ends(walker, done)
    times = done.clip.times_s
    soles = {leg.foot.name: leg.foot.sole_m for leg in walker.legs}
    assert len(done.clip.contacts) == 4
    for contact in done.clip.contacts:
        end = ends[contact.foot]
        assert len(contact.down_s) > 4
        for down, up in contact.down_s:
            row = (times >= down) & (times <= up)
            spread = np.linalg.norm(end[row] - end[row][0], axis=1).max()
            assert spread < 0.01 * walker.stride_m
        under = GROUNDS[name](end[:, :2]) - (end[:, 2] - soles[contact.foot])
        assert under.max() < 0.02
    assert done.slides_m < 0.01 * walker.stride_m
    assert done.aside_m < 0.02 * walker.length_m


def _middles(walker: Walker, done: Walked) -> Floats:
    """(t, 2) the middle of the trunk between hips and shoulders, from the clip alone."""
    skin = walker.skin
    turns = Rotation.from_quat(done.clip.rotations_xyzw.reshape(-1, 4)).as_matrix()
    turns = turns.reshape(*done.clip.rotations_xyzw.shape[:2], 3, 3)
    joints = composed(skin, turns, done.clip.translations_m)
    hips, shoulders = (skin.names.index(name) for name in ("body_0", "body_1"))
    assert skin.parent[shoulders] == hips
    return np.asarray(0.5 * (joints.places[:, hips, :2] + joints.places[:, shoulders, :2]))


def test_how_far_the_body_is_from_its_path_is_seen_by_the_clip_alone(walker: Walker) -> None:
    for name, ground in GROUNDS.items():
        done = _walk(walker, ground)
        x = np.linspace(-2.0, 8.0, 40_000)
        track = np.column_stack([x, 0.7 * np.sin(0.8 * x)])
        away, _ = cKDTree(track).query(_middles(walker, done))
        assert away.max() < 0.02 * walker.length_m, name
        assert done.aside_m == pytest.approx(away.max(), abs=0.01 * walker.length_m)


def test_a_body_that_lies_beside_its_path_is_told(
    walker: Walker, monkeypatch: pytest.MonkeyPatch
) -> None:
    laid = transfer._laid

    def shifted(*given: Any) -> Joints:
        found = laid(*given)
        return Joints(found.turns, found.places + np.array([0.0, 0.1, 0.0]))

    monkeypatch.setattr(transfer, "_laid", shifted)
    x = np.linspace(0.0, 6.0, 60)
    path = np.column_stack([x, 0.0 * x, 0.0 * x])
    flat = GROUNDS["flat"]
    done = walked(walker, path, flat, closed=False, looks=TransferLooks())
    assert done.aside_m == pytest.approx(0.1, abs=1e-3)


def test_bones_keep_their_lengths_and_the_animal_stands_at_both_ends(walker: Walker) -> None:
    done = _walk(walker, GROUNDS["rough"])
    rest = np.linalg.norm(walker.skin.rest_in_parent()[:, :3, 3], axis=1)
    long = np.linalg.norm(done.clip.translations_m, axis=2)
    hung = walker.skin.parent > 0
    np.testing.assert_allclose(long[:, hung], np.tile(rest[hung], (len(long), 1)), atol=1e-9)
    moved = np.abs(np.diff(done.clip.translations_m[:, 0, :2], axis=0)).max(axis=1)
    assert moved[:5].max() < 1e-3
    assert moved[-5:].max() < 1e-3
    assert moved.max() > 5e-3


def test_a_leg_reaches_what_is_in_its_reach_and_stretches_towards_the_rest() -> None:
    joints = np.array([[[0.0, 0.0, 1.0], [0.1, 0.0, 0.5]]])
    end = np.array([[0.0, 0.0, 0.1]])
    _, off = reached_in_space(joints, end, np.array([[0.2, 0.15, 0.2]]))
    assert off[0] < 1e-6
    long = np.linalg.norm([0.1, 0.5]) + np.linalg.norm([0.1, 0.4])
    _, off = reached_in_space(joints, end, np.array([[0.0, 0.0, -1.0]]))
    assert 2.0 - long <= off[0] < 2.2 - long


def test_the_way_is_gone_whole_and_its_speed_has_no_jump() -> None:
    times, way, share = going(7.0, Pace(1.5))
    assert way[0] == 0.0
    assert way[-1] == pytest.approx(7.0)
    speed = np.diff(way) / np.diff(times)
    assert speed.max() == pytest.approx(1.5, rel=1e-6)
    assert np.abs(np.diff(speed)).max() < 0.15
    np.testing.assert_allclose(0.5 * (share[1:] + share[:-1]) * 1.5, speed, atol=0.01)
    short = going(0.2, Pace(1.5))
    assert short[1][-1] == pytest.approx(0.2)


def test_a_curve_goes_on_straight_beyond_its_ends() -> None:
    curve = curve_of(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), closed=False)
    np.testing.assert_allclose(curve.at(np.array([-1.0, 0.5, 3.0]))[:, 0], [-1.0, 0.5, 3.0])


def test_the_centre_of_a_body_that_bows_goes_along_the_path() -> None:
    animal = walking_limbed(plan="lizard")
    gait = animal.gaits[0]
    bows = [
        Swing(segment=name, cos=[size], sin=[0.0], low=-abs(size), high=abs(size))
        for name, size in (("body_0", 0.17), ("body_1", -0.34))
    ]
    bowed = gait.model_copy(update={"swings": [*gait.swings, *bows]})
    feet = [step.limb for step in gait.feet]
    poses = animal.poses.model_copy(update={"feet": feet, "down": [[1] * 4, [0] * 4]})
    bent = animal.model_copy(update={"gaits": [bowed], "poses": poses})
    lizard = limbed_walker(build_limbed(bent))
    assert lizard is not None
    away = _walk(lizard, GROUNDS["flat"]).aside_m
    assert 0.005 * lizard.length_m < away < 0.02 * lizard.length_m
