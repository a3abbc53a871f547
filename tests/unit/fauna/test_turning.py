"""An animal that turns on the spot in the corners of its path."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from walking import walking_limbed

from veduta.fauna.build.limbed import build_limbed
from veduta.fauna.build.walker import limbed_walker
from veduta.fauna.motion.carried import Joints, composed
from veduta.fauna.motion.figure import Floats
from veduta.fauna.motion.pivot import pivot_of, turn_between
from veduta.fauna.motion.transfer import TransferLooks, Walked, Walker, walked
from veduta.fauna.motion.whole_path import curve_of

GROUNDS: dict[str, Callable[[Floats], Floats]] = {
    "flat": lambda p: np.zeros(len(p)),
    "slope": lambda p: np.tan(np.radians(20.0)) * p[:, 0],
    "rough": lambda p: 0.05 * np.sin(3.0 * p[:, 0]) * np.cos(2.5 * p[:, 1]),
}
CORNERS = np.array([[0.0, 0.0], [3.0, 0.0], [0.2, 0.4], [0.2, 3.0]])


@pytest.fixture(scope="module")
def walker() -> Walker:
    found = limbed_walker(build_limbed(walking_limbed()))
    assert found is not None
    return found


def _walk(walker: Walker, ground: Callable[[Floats], Floats]) -> tuple[Walked, Floats]:
    legs = [np.linspace(a, b, 30) for a, b in zip(CORNERS, CORNERS[1:], strict=False)]
    flat = np.concatenate([legs[0], legs[1][1:], legs[2][1:]])
    path = np.column_stack([flat, ground(flat)])
    done = walked(walker, path, ground, closed=False, looks=TransferLooks(), corners=[29, 58])
    return done, path


def _joints(walker: Walker, done: Walked) -> Joints:
    turns = Rotation.from_quat(done.clip.rotations_xyzw.reshape(-1, 4)).as_matrix()
    turns = turns.reshape(*done.clip.rotations_xyzw.shape[:2], 3, 3)
    return composed(walker.skin, turns, done.clip.translations_m)


@pytest.mark.parametrize("name", list(GROUNDS))
def test_feet_keep_their_spots_while_it_turns(walker: Walker, name: str) -> None:
    done, _ = _walk(walker, GROUNDS[name])
    joints, times = _joints(walker, done), done.clip.times_s
    for leg, contact in zip(walker.legs, done.clip.contacts, strict=True):
        end = joints.ends(leg.joints[-1], leg.end_m)
        for down, up in contact.down_s:
            row = (times >= down) & (times <= up)
            assert np.linalg.norm(end[row] - end[row][0], axis=1).max() < 0.01 * walker.stride_m
        under = GROUNDS[name](end[:, :2]) - (end[:, 2] - leg.foot.sole_m)
        assert under.max() < 0.02
    assert done.slides_m < 0.01 * walker.stride_m


def test_it_comes_to_each_corner_turns_there_and_goes_on_the_other_way(walker: Walker) -> None:
    done, _ = _walk(walker, GROUNDS["flat"])
    joints = _joints(walker, done)
    root, ahead = joints.places[:, 0, :2], joints.turns[:, 0, :2, 0]
    yaw = np.unwrap(np.arctan2(ahead[:, 1], ahead[:, 0]))
    for corner in CORNERS[1:3]:
        near = np.flatnonzero(np.linalg.norm(root - corner, axis=1) < 1e-6)
        turned = abs(float(yaw[near[-1]] - yaw[near[0]]))
        assert turned > np.radians(80.0)
        assert float(np.ptp(yaw[near])) == pytest.approx(turned, abs=1e-6)  # never back
    # No joint jumps: the body goes on from piece to piece.
    speed = np.linalg.norm(np.diff(joints.places, axis=0), axis=2).max(axis=1)
    usual = walker.stride_m / float(walker.clip.times_s[-1]) / 30.0
    assert speed.max() < 4.0 * usual
    assert np.abs(np.diff(yaw)).max() < 0.15
    assert np.linalg.norm(root[-1] - CORNERS[-1]) == pytest.approx(0.5 * walker.length_m, abs=0.01)


def test_a_turn_is_the_shorter_one_and_begins_and_ends_as_its_curves_lie() -> None:
    turn = np.linspace(0.0, 1.0, 40)
    arc = np.column_stack([np.sin(turn), 1.0 - np.cos(turn), 0.0 * turn])
    before = curve_of(arc, closed=False)
    end = arc[-1]
    after = curve_of(end + np.linspace(0.0, 1.0, 9)[:, None] * [-1.0, 0.3, 0.0], closed=False)
    angle = turn_between(before, after)
    wanted = np.arctan2(0.3, -1.0) - 1.0
    assert angle == pytest.approx((wanted + np.pi) % (2 * np.pi) - np.pi, abs=0.02)
    done = np.array([0.0, 0.5, 1.0])
    pivot = pivot_of(before, after, done, np.zeros(3), 0.5)
    back = np.full(3, -0.3)
    # At first its rump lies where it came from, at last in the line in which it goes on.
    np.testing.assert_allclose(
        pivot.at(back)[0], before.at(np.array(before.length_m - 0.3)), atol=1e-9
    )
    np.testing.assert_allclose(pivot.at(back)[2], after.at(np.array(-0.3)), atol=1e-9)
    np.testing.assert_allclose(
        pivot.heading(back)[0], before.heading(np.array(before.length_m - 0.3)), atol=1e-9
    )
    np.testing.assert_allclose(np.linalg.norm(pivot.heading(back), axis=1), 1.0)
