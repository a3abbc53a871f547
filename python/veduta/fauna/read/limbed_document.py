"""The document of an animal with limbs, from its fitted figure."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from veduta.fauna.document.limbed import LimbedAnimal, LimbedGait, Poses, Step, Swing
from veduta.fauna.document.plan import BodyPlan, Part
from veduta.fauna.document.schema import Length, Source
from veduta.fauna.motion.feet import (
    Chart,
    FeetLooks,
    feet_down,
    gait_name,
    ground_speed,
    step_of,
)
from veduta.fauna.motion.figure import Figure, Floats, posed
from veduta.fauna.motion.planting import reached
from veduta.fauna.options import FaunaOptions
from veduta.fauna.read.limbed import LimbedSeen
from veduta.fauna.read.second_view import SecondLooks, SecondView, rounded

_PHASES = 96
USUAL_LIMBED_M = {"quadruped": 0.8, "lizard": 0.2}
_OTHER_M = 0.5
_GONE, _EVEN = 0.4, 0.25
"""An animal goes through the pictures by so many lengths at least, and is by this share of that
where an even pace would have it.
"""


@dataclass(frozen=True, eq=False)
class Scaled:
    """A fitted animal in its own lengths, on its own ground.

    plan: its own. turns: (t, s) from how it stands. root: (t, 2) forwards from its mean and up from
    the ground. down: (t, f) whether each foot stands. unit_px: pixels in a length.
    """

    figure: Figure
    plan: BodyPlan
    turns: Floats
    root: Floats
    down: Chart
    unit_px: float
    speed: float | None


FROM_ABOVE = "from above one does not see how high the animal is: the plan's roundness was taken"
FROM_THE_SIDE = "one view does not show how wide the animal is: the plan's roundness was taken"
"""Doubts of one view alone; a second one (--second-view) takes them away."""


def with_second_view(animal: LimbedAnimal, second: SecondView) -> LimbedAnimal:
    """The animal whose body is as round as the second view shows it; its limbs stay as planned."""
    plan, is_sure = rounded(animal.plan, second, SecondLooks())
    doubts = [one for one in animal.doubts if one not in (FROM_ABOVE, FROM_THE_SIDE)]
    doubts.append("the second view was taken for the body; how round its limbs are is the plan's")
    if not is_sure:
        doubts.append("which end of the second view is the head is not clear")
    return animal.model_copy(update={"plan": plan, "widths": "measured", "doubts": doubts})


def described_limbs(
    seen: LimbedSeen, plan: BodyPlan, name: str, source: Source, frame_s: float,
    overlaps: Floats, options: FaunaOptions,
) -> LimbedAnimal:  # fmt: skip
    """The document; what the silhouettes do not tell is said in its doubts."""
    scaled = scaled_animal(seen, plan, frame_s)
    if plan.view == "top":
        doubts = [FROM_ABOVE]
    else:
        doubts = _doubts_of_sides(seen)
        doubts.append(FROM_THE_SIDE)
    gaits: list[LimbedGait] = []
    if seen.cycle is None:
        doubts.append("no cycle was found in the footage: it holds no gait, only its own motion")
    else:
        gaits.append(_gait(seen, scaled, frame_s))
        if len({limb.side for limb in scaled.figure.feet()}) > 1:
            doubts.append(
                "the right legs were taken to do what the left ones do, half a cycle later"
            )
    figure = scaled.figure
    poses = Poses(
        frame_s=frame_s,
        frame=seen.frames.astype(int).tolist(),
        segments=list(figure.segments),
        turns=np.clip(scaled.turns, -7.0, 7.0).round(5).tolist(),
        root=scaled.root.round(5).tolist(),
        feet=[limb.name for limb in figure.feet()],
        down=scaled.down.astype(int).tolist(),
    )
    length, assumed = _length(plan.name, options)
    return LimbedAnimal(
        name=name, kind=plan.name, source=source, length=length,
        plan=scaled.plan, seen=_seen_from(seen, plan), shape="measured", widths="invented",
        shape_score=float(np.median(overlaps)), missing=list(seen.missing), gaits=gaits,
        poses=poses, doubts=[*doubts, *assumed],
    )  # fmt: skip


def _doubts_of_sides(seen: LimbedSeen) -> list[str]:
    """Of which pairs of legs nothing tells the near leg from the far one."""
    if _sides_marked(seen):
        return []
    told = {one.part for one in seen.nearer}
    pairs = {limb.part.name for limb in seen.fitted.figure.feet() if limb.side == "left"}
    if pairs <= told:
        return []
    untold = " and ".join(sorted(name.replace("_", " ") for name in pairs - told))
    return [
        f"nothing tells the near {untold} from the far one: the left one may be the right one, half"
        " a cycle later; a front foot was taken to come down after the hind foot of its side"
    ]


def _sides_marked(seen: LimbedSeen) -> bool:
    """Whether somebody has marked legs of both sides."""
    figure = seen.fitted.figure
    legs = {figure.names[joint]: limb.side for limb in figure.feet() for joint in limb.joints}
    told = {
        legs[name]
        for name, at in seen.windows.pins.items()
        if name in legs and np.isfinite(at).any()
    }
    return told >= {"left", "right"}


def _seen_from(seen: LimbedSeen, plan: BodyPlan) -> Literal["left", "right", "above"]:
    if plan.view == "top":
        return "above"
    return "right" if seen.windows.ways().sum() > 0.0 else "left"


def _length(kind: str, options: FaunaOptions) -> tuple[Length, list[str]]:
    """From rump to nose, and the doubt where it was assumed."""
    given = options.animal.length_m
    if given is not None:
        return Length(metres=given, provenance="edited", score=1.0), []
    assumed = USUAL_LIMBED_M.get(kind, _OTHER_M)
    doubt = (
        f"nothing in the footage tells how long the animal is: {assumed:g} m from rump to nose were"
        " assumed (--length-m)"
    )
    return Length(metres=assumed, provenance="invented", score=0.0), [doubt]


def scaled_animal(seen: LimbedSeen, plan: BodyPlan, frame_s: float) -> Scaled:
    """The fitted figure as a plan of its own, and its poses from how it stands."""
    fitted = seen.fitted
    figure = fitted.figure
    top = plan.view == "top"
    stand = fitted.angles.mean(axis=0)
    if top:
        stand = _symmetric(figure, stand)
    at_rest = posed(figure, np.zeros((1, 2)), stand[None], fitted.length, fitted.apart).joints[0]
    body = list(figure.limbs[0].joints)
    unit = _long(at_rest[body], fitted.deep[body])
    feet = [limb.joints[-1] for limb in figure.feet()]
    joints = fitted.joints()
    if top or not feet:
        low = 0.0 if top else float((joints[..., 1] - fitted.deep).min())
    else:
        low = float(np.percentile((joints[:, feet, 1] - fitted.deep[feet]).min(axis=1), 25))
    if not top:
        stand = _on_the_ground(seen, stand, low)
        at_rest = posed(
            figure, np.zeros((1, 2)), stand[None], fitted.length, fitted.apart
        ).joints[0]  # fmt: skip
    high = 0.0 if top else float(fitted.root[:, 1].mean()) - low
    points = (at_rest + np.array([0.0, high])) / unit
    own = _own_plan(plan, figure, points, fitted.deep / unit, seen.missing)
    root = (fitted.root - np.array([float(fitted.root[:, 0].mean()), low])) / unit
    speed = speed_in_pictures(seen, unit * fitted.px_per_length, frame_s)
    places = _places_of_feet(seen, unit * fitted.px_per_length, even=speed is not None, top=top)
    turns = fitted.angles - stand
    down = (
        _cycle_down(seen, places, frame_s, speed)
        if seen.cycle is not None
        else feet_down(places, _row_s(seen, frame_s), FeetLooks(), cyclic=False, ground=speed)
    )
    return Scaled(figure, own, turns, root, down, unit * fitted.px_per_length, speed)


def speed_in_pictures(seen: LimbedSeen, unit_px: float, frame_s: float) -> float | None:
    """How fast it goes through the pictures (lengths/s), if it does so evenly; else None.

    A camera that stands still, or a canvas, shows that; feet tell it less well.
    """
    times = (seen.frames - seen.frames[0]) * frame_s
    x = _root_ahead(seen) / unit_px
    speed, begin = np.polyfit(times, x, 1)
    gone = float(speed) * float(times[-1])
    off = float(np.abs(x - begin - speed * times).max())
    return float(speed) if gone > _GONE and off < _EVEN * gone else None


def _root_ahead(seen: LimbedSeen) -> Floats:
    """(t,) how far forwards in the pictures the root is, px."""
    windows = seen.windows
    x = windows.in_picture(seen.fitted.root[:, None], seen.fitted.px_per_length)[:, 0, 0]
    ways = windows.ways()
    if (ways == ways[0]).all():
        return np.asarray(x * windows.faces)
    # Where it turns it goes on as it mostly goes.
    step, late = np.diff(x) * ways[1:], np.diff(seen.frames)
    same = ways[1:] == ways[:-1]
    step = np.where(same, step, np.median((step / late)[same]) * late)
    return np.concatenate([[0.0], np.cumsum(step)])


def _places_of_feet(seen: LimbedSeen, unit_px: float, *, even: bool, top: bool) -> Floats:
    """(t, f, 2) of the feet from the root, in lengths; from above their height is 0.

    even: of an animal that goes evenly through the pictures forwards from an even pace, not from
    its root, which sways with the spine and where the fit is unsure of it: what stands stands in
    the pictures.
    """
    fitted = seen.fitted
    feet = [limb.joints[-1] for limb in fitted.figure.feet()]
    away = (fitted.joints()[:, feet] - fitted.root[:, None]) * (fitted.px_per_length / unit_px)
    if even:
        ahead = _root_ahead(seen)
        pace = np.polyval(np.polyfit(seen.frames, ahead, 1), seen.frames)
        away[..., 0] += ((ahead - pace) / unit_px)[:, None]
    if top:
        away[..., 1] = 0.0
    return np.asarray(away)


def _row_s(seen: LimbedSeen, frame_s: float) -> float:
    """Seconds between two frames that were read: of long footage not every one is."""
    return float(np.median(np.diff(seen.frames))) * frame_s


def _on_the_ground(seen: LimbedSeen, stand: Floats, low: float) -> Floats:
    """The mean angles, with the legs stretched or bent so that all feet stand (from the side)."""
    fitted = seen.fitted
    root = np.array([[0.0, float(fitted.root[:, 1].mean()) - low]])
    figure = replace(
        fitted.figure, length=fitted.length, deep=fitted.deep, apart=fitted.apart, rest=stand
    )
    turns = np.zeros((1, len(stand)))
    for limb in figure.feet():
        toe = limb.joints[-1]
        joints = posed(figure, root, stand[None], fitted.length, fitted.apart).joints
        wanted = np.array([[float(joints[0, toe, 0]), float(fitted.deep[toe])]])
        turns, _ = reached(figure, turns, root, limb, wanted)
    return np.asarray(stand + turns[0])


def _cycle_down(seen: LimbedSeen, places: Floats, frame_s: float, speed: float | None) -> Chart:
    """The chart of the frames from that of the mean cycle."""
    phases = np.arange(_PHASES) / _PHASES
    cycle = seen.cycle or 1.0
    at = (seen.frames / cycle) % 1.0
    mean = mean_cycle(places.reshape(len(places), -1), at).reshape(_PHASES, -1, 2)
    key_s = cycle * frame_s / _PHASES
    down = feet_down(mean, key_s, FeetLooks(), cyclic=True, ground=speed)
    rows = np.floor(at * _PHASES).astype(int) % _PHASES
    return np.asarray(down[rows] if len(phases) else down)


def mean_cycle(values: Floats, phase: Floats, order: int = 6) -> Floats:
    """(96, n) a cycle of values (t, n) at phases (t,), averaged: harmonics by least squares."""
    few = min(order, max(1, (len(phase) - 1) // 3))
    at = np.arange(_PHASES) / _PHASES
    share, *_ = np.linalg.lstsq(_harmonics(phase, few), values, rcond=None)
    return np.asarray(_harmonics(at, few) @ share)


def _harmonics(phase: Floats, order: int) -> Floats:
    turn = 2.0 * np.pi * phase[:, None] * np.arange(1, order + 1)
    return np.concatenate([np.ones((len(phase), 1)), np.cos(turn), np.sin(turn)], axis=1)


def _gait(seen: LimbedSeen, scaled: Scaled, frame_s: float) -> LimbedGait:
    """The mean cycle as harmonics, with its steps."""
    figure, cycle = scaled.figure, seen.cycle or 1.0
    phase = (seen.frames / cycle) % 1.0
    order = min(4, max(1, (len(phase) - 1) // 3))
    columns = np.concatenate([scaled.turns, scaled.root[:, 1:]], axis=1)
    share, *_ = np.linalg.lstsq(_harmonics(phase, order), columns, rcond=None)
    whole = _harmonics(np.arange(_PHASES) / _PHASES, order)[:, 1:] @ share[1:]
    swings = [
        Swing(
            segment=name, cos=share[1 : order + 1, k].round(5).tolist(),
            sin=share[order + 1 :, k].round(5).tolist(),
            low=float(np.round(whole[:, k].min(), 4) - 1e-4),
            high=float(np.round(whole[:, k].max(), 4) + 1e-4),
        )
        for k, name in enumerate((*figure.segments, "root"))
    ]  # fmt: skip
    cycle_s = cycle * frame_s
    places = _places_of_feet(
        seen, scaled.unit_px, even=scaled.speed is not None, top=scaled.plan.view == "top"
    )
    mean = mean_cycle(places.reshape(len(places), -1), phase).reshape(_PHASES, -1, 2)
    key_s = cycle_s / _PHASES
    down = feet_down(mean, key_s, FeetLooks(), cyclic=True, ground=scaled.speed)
    speed = scaled.speed or ground_speed(mean, key_s, cyclic=True)
    steps = []
    for column, limb in enumerate(figure.feet()):
        found = step_of(down[:, column])
        if found is not None:
            steps.append(Step(limb=limb.name, down=found[0], up=found[1]))
    name = gait_name([(step.limb, step.down, step.up) for step in steps])
    return LimbedGait(
        name=name, cycle_s=cycle_s, stride=speed * cycle_s, swings=swings[:-1], rise=swings[-1],
        feet=steps, provenance="measured", score=float(np.clip(seen.cycle_score, 0.0, 1.0)),
    )  # fmt: skip


def _long(body: Floats, deep: Floats) -> float:
    """From the rump to the nose along the body."""
    return float(np.linalg.norm(np.diff(body, axis=0), axis=1).sum() + deep[0] + deep[-1])


def _symmetric(figure: Figure, stand: Floats) -> Floats:
    """Turns at rest that are the same on both sides, and none in the middle (seen from above)."""
    found = stand.copy()
    rest = figure.rest
    left = {limb.part.name: limb for limb in figure.limbs if limb.side == "left"}
    for limb in figure.limbs:
        rows = list(limb.segments)
        if limb.side == "middle":
            found[rows] = rest[rows]
        elif limb.side == "right":
            twin = list(left[limb.part.name].segments)
            turn = 0.5 * ((stand[twin] - rest[twin]) - (stand[rows] - rest[rows]))
            found[twin], found[rows] = rest[twin] + turn, rest[rows] - turn
    return found


def _own_plan(
    plan: BodyPlan, figure: Figure, points: Floats, deep: Floats, missing: tuple[str, ...]
) -> BodyPlan:
    limbs = {limb.part.name: limb for limb in figure.limbs if limb.side != "right"}
    parts: list[Part] = []
    for part in plan.parts:
        if part.name in missing or part.name not in limbs:
            continue
        rows = list(limbs[part.name].joints)
        place = [(round(float(x), 5), round(float(y), 5)) for x, y in points[rows]]
        changed = {
            "points": place if part.on is None else place[1:],
            "start": None if part.on is None else place[0],
            "deep": [round(max(float(value), 1e-4), 5) for value in deep[rows]],
            "optional": False,
        }
        parts.append(part.model_copy(update=changed))
    return BodyPlan(name=plan.name, view=plan.view, parts=parts)
