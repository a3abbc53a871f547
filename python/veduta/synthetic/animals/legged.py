"""A quadruped from the side, a lizard from above: feet on planned places, legs by two circles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.animals.film import Filmed, Floats, Tube, film


@dataclass(frozen=True)
class Proportions:
    """Of a quadruped, in pixels times `trunk`: the length from hips to shoulders is 1."""

    trunk: float
    leg: float = 0.95
    neck: float = 0.42
    head: float = 0.3
    tail: float = 0.6
    deep: float = 0.2
    thin: float = 0.05


def film_quadruped(
    seed: int,
    *,
    frames: int = 48,
    cycle: float = 22.0,
    odd: bool = False,
    shadow: bool = False,
    mottled: bool = False,
) -> Filmed:
    """One that walks to the right through a frame of 360 x 640. odd: as no plan has it.

    shadow: it lies on the ground before the animal, a seventh as deep as that is high.
    mottled: its coat has spots.
    """
    random = np.random.default_rng(seed)
    like = Proportions(
        trunk=random.uniform(88.0, 100.0),
        leg=random.uniform(0.55, 0.7) if odd else random.uniform(0.88, 1.05),
        neck=random.uniform(0.6, 0.75) if odd else random.uniform(0.34, 0.48),
        head=random.uniform(0.26, 0.34), tail=random.uniform(0.5, 0.8),
        deep=random.uniform(0.17, 0.22), thin=random.uniform(0.04, 0.055),
    )  # fmt: skip
    unit, ground = like.trunk, 300.0
    time = np.arange(frames)
    stride, duty, high = 0.75 * like.leg, random.uniform(0.6, 0.68), 0.93 * like.leg
    ahead = 1.3 + stride * time / cycle
    sway = 0.012 * np.sin(4.0 * np.pi * time / cycle)
    hip = np.stack([ahead, high + sway], axis=1)
    shoulder = hip + np.array([1.0, 0.02])
    neck = shoulder + like.neck * np.array([0.8, 0.6])
    nose = neck + like.head * np.array([0.9, -0.35])
    swing = -0.9 + 0.15 * np.sin(2.0 * np.pi * time / cycle)
    low = hip + np.array([-0.12, 0.06])
    tail = [low + like.tail * k / 3.0 * np.stack([np.cos(np.pi - swing), np.sin(swing)], axis=1)
            for k in range(4)]  # fmt: skip
    joints: dict[str, Floats] = {"hip": hip, "shoulder": shoulder, "neck": neck, "nose": nose}
    legs: dict[str, list[Floats]] = {}
    down: dict[str, NDArray[np.bool_]] = {}
    begins = {"hind_leg_left": 0.0, "front_leg_left": 0.75, "hind_leg_right": 0.5,
              "front_leg_right": 0.25}  # fmt: skip
    for name, begin in begins.items():
        phase = (time / cycle + begin) % 1.0
        hung = (hip if name.startswith("hind") else shoulder) - [0.0, 0.08]
        toe, stands = _foot(hung[:, 0], phase, stride, duty, cycle, 0.11 * like.leg)
        back = name.startswith("hind")
        lean = np.radians(112.0 if back else 96.0) - np.where(stands, 0.0, 0.5) * np.sin(
            np.pi * np.clip((phase - duty) / (1.0 - duty), 0.0, 1.0)
        )
        low_leg = (0.3 if back else 0.26) * like.leg
        hock = toe + low_leg * np.stack([np.cos(lean), np.sin(lean)], axis=1)
        both = 0.5 * (like.leg * 1.04 - low_leg)
        knee = _bent(hung, hock, both, both, 1.0 if back else -1.0)
        legs[name], down[name] = [hung, knee, hock, toe], stands
        side = name.rsplit("_", 1)[1]
        names = ("knee", "hock", "hind_toe") if back else ("elbow", "wrist", "front_toe")
        for joint, at in zip(names, (knee, hock, toe), strict=True):
            joints[f"{joint}_{side}"] = at

    def px(points: list[Floats]) -> Floats:
        return np.asarray(np.stack(points, axis=1) * [unit, -unit] + [0.0, ground])

    thick = np.array([0.13, 0.075, like.thin, like.thin]) * unit
    body = px([hip, 0.5 * (hip + shoulder) - [0.0, 0.02], shoulder, neck, nose])
    wide = np.array([0.9 * like.deep, like.deep, like.deep, 0.11, 0.06]) * unit
    # It goes to the right, so its right legs are the near ones.
    tubes = [Tube(px(legs[n]), thick, 0.8) for n in ("hind_leg_left", "front_leg_left")]
    tubes.append(Tube(px(tail), np.array([0.06, 0.05, 0.035, 0.03]) * unit))
    tubes.append(Tube(body, wide))
    tubes += [Tube(px(legs[n]), thick, 1.12) for n in ("hind_leg_right", "front_leg_right")]
    # Feet touch their shadow at the ground; what is above falls before it.
    lying = np.array([[1.0, 0.12, -0.12 * ground], [0.0, -1.0 / 7.0, ground * (1.0 + 1.0 / 7.0)]])
    cast = lying if shadow else None
    pictures, behind, masks = film(
        tubes, (360, 640), random, grass=12, shadow=cast, mottled=mottled
    )
    places = {name: px([at])[:, 0] for name, at in joints.items()}
    length = (1.0 + like.neck + like.head + 0.9 * like.deep + 0.06) * unit
    return Filmed(
        pictures, behind, masks, places, cycle, length, down,
        {"trunk": unit, "front_leg": like.leg * unit, "hind_leg": like.leg * unit},
        {"back": like.deep * unit, "shoulder": like.deep * unit},
    )  # fmt: skip


def film_lizard(
    seed: int,
    *,
    frames: int = 40,
    cycle: float = 18.0,
    odd: bool = False,
    shadow: bool = False,
) -> Filmed:
    """One that runs to the right, seen from above, its spine bending from side to side.

    shadow: it lies beside the body on the ground.
    """
    random = np.random.default_rng(seed)
    unit = random.uniform(110.0, 125.0)
    tail_long = random.uniform(0.6, 0.7) if odd else random.uniform(0.95, 1.1)
    leg = random.uniform(0.26, 0.3) if odd else random.uniform(0.34, 0.4)
    time = np.arange(frames)
    phase = 2.0 * np.pi * time / cycle
    stride, duty = 0.42, 0.6
    hip = np.stack([1.35 + stride * time / cycle, np.zeros(frames)], axis=1)
    lean = 0.22 * np.sin(phase)
    chain, angle = [hip], lean.copy()
    for size, bend in ((0.3, -0.25), (0.3, -0.25), (0.16, 0.1), (0.2, 0.1)):
        angle = angle + bend * np.sin(phase)
        chain.append(chain[-1] + size * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    tail, angle = [hip], np.pi + lean
    for number in range(4):
        angle = angle + 0.3 * np.sin(phase - 0.9 * (number + 1))
        step = 0.25 * tail_long * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        tail.append(tail[-1] + step)
    joints: dict[str, Floats] = {
        "hip": hip, "back": chain[1], "shoulder": chain[2], "nose": chain[4], "tail_end": tail[4],
    }  # fmt: skip
    legs, down = [], {}
    for name, begin in (("front_leg_left", 0.0), ("front_leg_right", 0.5),
                        ("hind_leg_left", 0.5), ("hind_leg_right", 0.0)):  # fmt: skip
        sign = 1.0 if name.endswith("left") else -1.0
        front = name.startswith("front")
        root = chain[2] if front else hip
        hung = root + np.array([0.0, 0.04 * sign])
        middle = hip[:, 0] + (0.6 if front else 0.0) + (0.1 if front else -0.02)
        toe, stands = _foot(middle, (time / cycle + begin) % 1.0, stride, duty, cycle, 0.0)
        toe = np.stack([toe[:, 0], np.full(frames, sign * 0.8 * leg)], axis=1)
        bend = sign if front else -sign  # elbows point back, knees forward
        knee = _bent(hung, toe, 0.55 * leg, 0.6 * leg, bend)
        legs.append([hung, knee, toe])
        down[name] = stands
        side = name.rsplit("_", 1)[1]
        joints[f"{'elbow' if front else 'knee'}_{side}"] = knee
        joints[f"{'front' if front else 'hind'}_toe_{side}"] = toe

    def px(points: list[Floats]) -> Floats:
        return np.asarray(np.stack(points, axis=1) * [unit, -unit] + [0.0, 180.0])

    wide = np.array([0.065, 0.1, 0.08, 0.055, 0.03]) * unit
    tubes = [Tube(px(one), np.array([0.04, 0.03, 0.025]) * unit, 0.9) for one in legs]
    tubes.append(Tube(px(tail), np.array([0.06, 0.045, 0.03, 0.018, 0.006]) * unit))
    tubes.append(Tube(px(chain), wide))
    cast = np.array([[1.0, 0.0, 5.0], [0.0, 1.0, 7.0]]) if shadow else None
    pictures, behind, masks = film(tubes, (360, 640), random, shadow=cast)
    return Filmed(
        pictures, behind, masks, {name: px([at])[:, 0] for name, at in joints.items()}, cycle,
        0.96 * unit + 0.095 * unit, down, {"trunk": 0.6 * unit, "tail": tail_long * unit},
        {"back": 0.1 * unit, "shoulder": 0.08 * unit},
    )  # fmt: skip


def _foot(
    middle: Floats, phase: Floats, stride: float, duty: float, cycle: float, lift: float
) -> tuple[Floats, NDArray[np.bool_]]:
    """Where a foot is, under `middle` in the midst of its stand, and whether it stands."""
    stands = phase < duty
    share = np.clip((phase - duty) / (1.0 - duty), 0.0, 1.0)
    ease = share * share * (3.0 - 2.0 * share)
    reach = stride * duty
    away = np.where(stands, 0.5 * reach - stride * phase, -0.5 * reach + reach * ease)
    return np.stack([middle + away, lift * np.sin(np.pi * share)], axis=1), stands


def _bent(first: Floats, last: Floats, upper: float, lower: float, bend: float) -> Floats:
    """The joint between two bones: where two circles meet, on the side that `bend` says."""
    way = last - first
    far = np.minimum(np.linalg.norm(way, axis=1), 0.999 * (upper + lower))
    ahead = way / np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-9)
    along = (far**2 + upper**2 - lower**2) / (2.0 * far)
    aside = np.sqrt(np.maximum(upper**2 - along**2, 0.0))
    normal = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    return np.asarray(first + along[:, None] * ahead + bend * aside[:, None] * normal)
