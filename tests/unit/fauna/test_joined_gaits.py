"""Gaits of another body, and gaits joined into one motion."""

from __future__ import annotations

import numpy as np
import pytest
from walking import walking_limbed

from veduta.fauna.build.limbed import build_limbed
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.motion.borrowed import borrowed
from veduta.fauna.motion.figure import figure_of, posed
from veduta.fauna.motion.joined import joined_gaits
from veduta.fauna.motion.stride import stride_of
from veduta.run.errors import InputError


def _two() -> LimbedAnimal:
    trot = walking_limbed("trot", stride=0.62, cycle_s=0.6, duty=0.42)
    return borrowed(walking_limbed(), trot, "trot.json")


def test_gaits_of_the_same_body_come_over_as_they_were() -> None:
    walk, trot = walking_limbed(), walking_limbed("trot", stride=0.62, cycle_s=0.6)
    both = borrowed(walk, trot, "trot.json")
    assert [gait.name for gait in both.gaits] == ["walk", "trot"]
    assert both.gaits[1].stride == pytest.approx(0.62)
    assert both.gaits[1].cycle_s == pytest.approx(0.6)
    assert both.gaits[1].provenance == "invented"
    mine, theirs = both.gaits[1].swings, trot.gaits[0].swings
    known = {swing.segment: swing for swing in mine}
    for swing in theirs:
        np.testing.assert_allclose(known[swing.segment].cos, swing.cos, atol=1e-4)
    again = borrowed(walk, walk, "walk.json")
    assert [gait.name for gait in again.gaits] == ["walk", "walk of goat"]


def test_a_leg_of_other_segments_is_turned_by_as_much() -> None:
    walk = walking_limbed()
    parts = [
        part
        if not part.ground
        else part.model_copy(
            update={
                "joints": part.joints[:1] + part.joints[2:],
                "points": part.points[:1] + part.points[2:],
                "deep": part.deep[:2] + part.deep[3:],
            }
        )
        for part in walk.plan.parts
    ]
    short = walk.model_copy(
        update={"plan": walk.plan.model_copy(update={"parts": parts}), "gaits": []}
    )
    large = short.model_copy(update={"length": walk.length.model_copy(update={"metres": 3.6})})
    found = borrowed(large, walk, "walk.json").gaits[0]
    # Four times as large: twice as long for a cycle.
    assert found.cycle_s == pytest.approx(2.0, rel=0.08)
    legs = [swing for swing in found.swings if swing.segment.startswith("front_leg_left")]
    theirs = [s for s in walk.gaits[0].swings if s.segment.startswith("front_leg_left")]
    assert len(legs) == 3
    assert sum(one.cos[0] for one in legs) == pytest.approx(
        sum(one.cos[0] for one in theirs), abs=0.05
    )


def test_gaits_without_a_leg_in_common_are_refused() -> None:
    walk = walking_limbed()
    still = walk.model_copy(update={"gaits": []})
    with pytest.raises(InputError, match="holds no gait"):
        borrowed(walk, still, "x.json")
    with pytest.raises(InputError, match="seen from the top"):
        borrowed(walk, walking_limbed(plan="lizard"), "x.json")
    parts = [
        part.model_copy(update={"name": f"other_{part.name}"}) if part.ground else part
        for part in walk.plan.parts
    ]
    strange = walk.model_copy(update={"plan": walk.plan.model_copy(update={"parts": parts})})
    with pytest.raises(InputError, match="has no leg that this body has"):
        borrowed(strange, walk, "x.json")


def test_joined_gaits_loop_and_their_feet_keep_their_spots() -> None:
    animal = _two()
    figure = figure_of(animal.plan)
    strides = tuple(stride_of(animal, figure, gait) for gait in animal.gaits)
    joined = joined_gaits(figure, strides, side=True)
    assert joined is not None
    stride, way = joined.stride, joined.way
    np.testing.assert_allclose(stride.turns[0], stride.turns[-1])
    speed = np.diff(way) / np.diff(stride.times_s)
    assert speed.min() == pytest.approx(0.5, rel=0.05)
    assert speed.max() == pytest.approx(0.62 / 0.6, rel=0.05)
    assert np.abs(np.diff(speed)).max() < 0.05
    angles = figure.rest + stride.turns
    joints = posed(figure, stride.root, angles, figure.length, figure.apart).joints
    for column, limb in enumerate(figure.feet()):
        toe = joints[:, limb.joints[-1]]
        down = joined.down[:, column]
        both = down[1:] & down[:-1]
        moved = np.diff(toe[:, 0]) + np.diff(way)
        assert np.abs(moved[both]).max() < 0.01 * 0.5
        assert np.abs(toe[down, 1] - figure.deep[limb.joints[-1]]).max() < 0.01
        assert 0.3 < down.mean() < 0.7
    assert np.abs(np.diff(stride.turns, axis=0)).max() < 0.25
    assert joined_gaits(figure, strides[:1], side=True) is None


def test_the_model_has_a_clip_of_both_gaits() -> None:
    built = build_limbed(_two())
    clip = next(one for one in built.mesh.clips if one.name == "joined")
    assert clip.loops
    assert len(clip.contacts) == 4
    assert [one.name for one in built.clips] == ["walk", "trot", "joined", "footage"]
