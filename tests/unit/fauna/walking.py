"""A quadruped that walks, as documents of the fit have it."""

from __future__ import annotations

import numpy as np

from veduta.fauna.document.limbed import LimbedAnimal, LimbedGait, Poses, Step, Swing
from veduta.fauna.document.plan import load_plan
from veduta.fauna.document.schema import Length, Source
from veduta.fauna.motion.figure import figure_of

LATER = {
    "front_leg_left": 0.25, "front_leg_right": 0.75, "hind_leg_left": 0.0, "hind_leg_right": 0.5,
}  # fmt: skip


def walking_limbed(
    name: str = "walk", *, length_m: float = 0.9, stride: float = 0.5, cycle_s: float = 1.0,
    duty: float = 0.6, plan: str = "quadruped",
) -> LimbedAnimal:  # fmt: skip
    """The plan's own animal; each leg swings, and stands from a quarter of its cycle on."""
    body = load_plan(plan)
    figure = figure_of(body)
    swings, feet = [], []
    for limb in figure.feet():
        turn = 2.0 * np.pi * LATER[limb.name]
        for number, size in ((0, 0.3), (1, 0.15)):
            at = turn + 0.5 * np.pi * number
            swing = Swing(
                segment=f"{limb.name}_{number}", cos=[size * np.cos(at)], sin=[-size * np.sin(at)],
                low=-size, high=size,
            )  # fmt: skip
            swings.append(swing)
        down = (-LATER[limb.name]) % 1.0
        feet.append(Step(limb=limb.name, down=down, up=(down + duty) % 1.0))
    names = list(figure.segments)
    still = Swing(segment="root", cos=[0.0], sin=[0.0], low=0.0, high=0.0)
    return LimbedAnimal(
        name="goat", kind=plan, source=Source(file="x", sha256="", frames=9, used=9),
        length=Length(metres=length_m, provenance="edited", score=1.0), plan=body,
        seen="left" if body.view == "side" else "above",
        shape="measured", widths="invented", shape_score=0.9,
        gaits=[
            LimbedGait(
                name=name, cycle_s=cycle_s, stride=stride, swings=swings, rise=still, feet=feet,
                provenance="measured", score=0.9,
            )
        ],
        poses=Poses(
            frame_s=0.04, frame=[0, 1], segments=names, turns=[[0.0] * len(names)] * 2,
            root=[(0.0, 0.57)] * 2, feet=["front_leg_left"], down=[[1], [0]],
        ),
    )  # fmt: skip
