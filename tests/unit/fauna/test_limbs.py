"""Animals with limbs: body plans, the figure, its fit, feet, planting, the document."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta.fauna.document.limbed import LimbedAnimal, LimbedGait, Poses, Step, Swing
from veduta.fauna.document.load import load_animal, save_animal
from veduta.fauna.document.plan import PLANS, load_plan
from veduta.fauna.document.schema import Length, Source
from veduta.fauna.motion.feet import FeetLooks, feet_down, gait_name, ground_speed, step_of
from veduta.fauna.motion.figure import Floats, figure_of, posed
from veduta.fauna.motion.planting import phases_down, planted_cycle
from veduta.fauna.read.basis import FitLooks, cycle_basis
from veduta.fauna.read.fit import Fit
from veduta.fauna.read.windows import repeat_of, windows_of
from veduta.run.errors import InputError


def test_the_quadruped_has_eleven_parts_and_the_lizard_legs_on_both_sides() -> None:
    quadruped = figure_of(load_plan("quadruped"))
    assert len(quadruped.limbs) == 11
    assert {limb.name for limb in figure_of(load_plan("lizard")).feet()} == {
        "front_leg_left", "front_leg_right", "hind_leg_left", "hind_leg_right",
    }  # fmt: skip


@pytest.mark.parametrize("kind", ["quadruped", "lizard"])
def test_at_rest_the_joints_lie_where_the_plan_has_them(kind: str) -> None:
    plan = load_plan(kind)
    figure = figure_of(plan)
    root = np.array([plan.parts[0].points[0]])
    at = posed(figure, root, figure.rest[None], figure.length, figure.apart).joints[0]
    for limb in figure.limbs:
        flip = -1.0 if limb.side == "right" and plan.view == "top" else 1.0
        wanted = np.array(limb.part.points) * [1.0, flip]
        np.testing.assert_allclose(at[list(limb.joints)][-len(wanted) :], wanted, atol=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ('on = "shoulder"', 'on = "wing"', "hangs on 'wing'"),
        ("ground = true", "wheels = true", "wheels"),
        ('view = "side"', 'view = "below"', "view"),
        ("deep = [0.09, 0.05, 0.03, 0.022, 0.018]", "deep = [0.09]", "deep"),
        ('name = "quadruped"', "name = quadruped", "is no TOML"),
    ],
)
def test_a_broken_plan_is_refused_with_the_reason(
    tmp_path: Path, old: str, new: str, fault: str
) -> None:
    text = (PLANS / "quadruped.toml").read_text()
    assert old in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(InputError, match=fault) as caught:
        load_plan("quadruped", path)
    assert "docs/fauna.md" in caught.value.remedy


def _walk(frames: int = 24, cycle: float = 16.0) -> tuple[Floats, Floats]:
    """Turns (t, s) of the quadruped, legs in a walk, and its root."""
    figure = figure_of(load_plan("quadruped"), ("ear", "horn", "beard"))
    turns = np.zeros((frames, len(figure.start)))
    phase = np.arange(frames) / cycle
    for limb in figure.feet():
        later = 0.5 * (limb.side == "right") + 0.25 * limb.name.startswith("front")
        turns[:, limb.segments[0]] = 0.3 * np.cos(2.0 * np.pi * (phase + later))
        turns[:, limb.segments[1]] = 0.25 * np.sin(2.0 * np.pi * (phase + later))
    root = np.tile([0.0, 0.57], (frames, 1))
    return turns, root


def test_the_loss_falls_as_its_gradient_says() -> None:
    figure = figure_of(load_plan("quadruped"), ("ear", "horn", "beard"))
    random = np.random.default_rng(3)
    masks = np.zeros((6, 60, 90), dtype=np.bool_)
    masks[:, 15:35, 10:75] = True
    masks[:, 35:55, 15:22] = masks[:, 35:55, 60:66] = True
    frames = np.arange(6.0)
    windows = windows_of(masks, 40)
    fit = Fit(figure, windows, cycle_basis(frames, 5.0, FitLooks()), FitLooks(), frames)
    at = random.normal(size=fit.size) * 0.1
    gradient = fit.loss(at, 70.0, 0.05)[1]
    step = 1e-3
    for name, (place, _) in fit.slots.items():
        way = np.zeros(fit.size)
        way[place] = random.normal(size=place.stop - place.start)
        ahead, behind = (fit.loss(at + sign * step * way, 70.0, 0.05)[0] for sign in (1.0, -1.0))
        # The taper's own turn is left out of the gradient: it is small.
        measured = (ahead - behind) / (2.0 * step)
        assert abs(measured - gradient @ way) < 0.25 * abs(measured) + 0.01, name


def test_what_leaves_the_windows_is_pulled_back() -> None:
    figure = figure_of(load_plan("quadruped"), ("ear", "horn", "beard"))
    masks = np.zeros((5, 60, 90), dtype=np.bool_)
    masks[:, 15:35, 10:75] = True
    frames = np.arange(5.0)
    looks = replace(FitLooks(), weight=0.0)
    fit = Fit(figure, windows_of(masks, 40), cycle_basis(frames, 5.0, looks), looks, frames)
    away = np.zeros(fit.size)
    fit.part(away, "root")[:, 0] = 30.0  # three lengths
    near = 0.9 * away
    far_loss, gradient, _ = fit.loss(away, 70.0, 0.05)
    assert far_loss > fit.loss(near, 70.0, 0.05)[0] + 1.0
    assert (fit.part(gradient, "root")[:, 0] > 0.0).all()


def test_silhouettes_repeat_after_half_a_stride() -> None:
    masks = np.zeros((40, 80, 120), dtype=np.bool_)
    masks[:, 20:45, 20:100] = True
    for frame in range(40):
        for leg in (0.0, 0.5):
            swing = 12.0 * np.sin(2.0 * np.pi * (frame / 17.0 + leg))
            for middle in (35.0, 85.0):
                left = round(middle + swing)
                masks[frame, 45:70, left : left + 6] = True
    found = repeat_of(windows_of(masks, 60))
    assert found is not None
    assert found[0] == pytest.approx(8.5, abs=0.3)


def test_a_foot_stands_while_it_goes_back_with_the_ground() -> None:
    count, duty, speed = 80, 0.65, 1.3
    phase = np.arange(count) / count
    places = np.zeros((count, 2, 2))
    truth = np.zeros((count, 2), dtype=np.bool_)
    for foot, later in enumerate((0.0, 0.5)):
        since = (phase + later) % 1.0
        share = np.clip((since - duty) / (1.0 - duty), 0.0, 1.0)
        back = 0.5 - speed * since
        ahead = 0.5 - speed * duty * (1.0 - share)
        truth[:, foot] = since <= duty
        places[:, foot, 0] = np.where(truth[:, foot], back, ahead)
        places[:, foot, 1] = 0.08 * np.sin(np.pi * share)
    found = feet_down(places, 0.01, FeetLooks(), cyclic=True)
    assert (found == truth).mean() > 0.95
    assert ground_speed(places, 0.01, cyclic=True) == pytest.approx(speed / 0.8, rel=0.02)
    step = step_of(found[:, 0])
    assert step is not None
    assert (step[1] - step[0]) % 1.0 == pytest.approx(duty, abs=0.05)


def test_a_gait_is_called_by_how_long_feet_stand_and_which_together() -> None:
    def steps(duty: float, hind: float) -> list[tuple[str, float, float]]:
        return [
            (f"{name}_leg_{side}", at % 1.0, (at + duty) % 1.0)
            for name, begin in (("front", 0.0), ("hind", hind))
            for side, at in (("left", begin), ("right", begin + 0.5))
        ]

    assert gait_name(steps(0.65, 0.25)) == "walk"
    assert gait_name(steps(0.4, 0.5)) == "trot"
    assert gait_name(steps(0.4, 0.02)) == "pace"


def test_planted_feet_neither_slide_nor_sink() -> None:
    plan = load_plan("quadruped")
    figure = figure_of(plan)
    turns, root = _walk(48, 48.0)
    whole = np.zeros((48, len(figure.start)))
    whole[:, : turns.shape[1]] = turns
    steps = {
        limb.name: ((0.4 - later) % 1.0, (0.4 - later + 0.6) % 1.0)
        for limb in figure.feet()
        for later in [0.5 * (limb.side == "right") + 0.25 * limb.name.startswith("front")]
    }
    stride = 0.5
    planted = planted_cycle(figure, whole, root, stride, steps, side=True)
    at = posed(
        figure, planted.root, figure.rest + planted.turns, figure.length, figure.apart
    ).joints
    phase = np.arange(48) / 48
    for limb in figure.feet():
        toe, (down, up) = limb.joints[-1], steps[limb.name]
        stands = phases_down(down, up, phase)
        inner = stands & np.roll(stands, 6) & np.roll(stands, -6)
        since = (phase - down) % 1.0
        way = at[inner, toe, 0] + stride * since[inner]
        assert np.ptp(way) < 0.01 * stride
        assert np.abs(at[inner, toe, 1] - figure.deep[toe]).max() < 2e-3


def test_a_foot_that_stands_for_no_key_swings_as_it_did() -> None:
    figure = figure_of(load_plan("quadruped"))
    turns, root = _walk(48, 48.0)
    whole = np.zeros((48, len(figure.start)))
    whole[:, : turns.shape[1]] = turns
    name = figure.feet()[0].name
    never = (0.5 / 48, 0.6 / 48)
    planted = planted_cycle(figure, whole, root, 0.5, {name: never}, side=True)
    np.testing.assert_array_equal(planted.turns, whole)
    assert planted.worst == 0.0


def small_limbed() -> LimbedAnimal:
    """A quadruped as its plan has it, in a slow walk."""
    plan = load_plan("quadruped")
    figure = figure_of(plan)
    swings = [
        Swing(segment=f"{limb.name}_0", cos=[0.3], sin=[0.0], low=-0.31, high=0.31)
        for limb in figure.feet()
        if limb.side == "left"
    ]
    names = list(figure.segments)
    return LimbedAnimal(
        name="goat", kind="quadruped", source=Source(file="x", sha256="", frames=9, used=9),
        length=Length(metres=0.9, provenance="edited", score=1.0), plan=plan, seen="left",
        shape="measured", widths="invented", shape_score=0.9,
        gaits=[
            LimbedGait(
                name="walk", cycle_s=1.0, stride=0.4, swings=swings,
                rise=Swing(segment="root", cos=[0.0], sin=[0.0], low=0.0, high=0.0),
                feet=[Step(limb="front_leg_left", down=0.1, up=0.7)], provenance="measured",
                score=0.9,
            )
        ],
        poses=Poses(
            frame_s=0.04, frame=[0, 1], segments=names, turns=[[0.0] * len(names)] * 2,
            root=[(0.0, 0.57)] * 2, feet=["front_leg_left"], down=[[1], [0]],
        ),
    )  # fmt: skip


def test_the_document_comes_back_as_it_was_written(tmp_path: Path) -> None:
    animal = small_limbed()
    save_animal(animal, tmp_path / "animal.json")
    assert load_animal(tmp_path / "animal.json") == animal


def test_poses_that_miss_a_row_are_refused(tmp_path: Path) -> None:
    animal = small_limbed()
    save_animal(animal, tmp_path / "animal.json")
    text = (tmp_path / "animal.json").read_text()
    (tmp_path / "animal.json").write_text(text.replace('"down": [[1], [0]]', '"down": [[1]]'))
    with pytest.raises(InputError, match="not one row for each frame"):
        load_animal(tmp_path / "animal.json")
