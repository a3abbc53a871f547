"""A snake and a fish from above: a wave that runs down the axis."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.synthetic.animals.film import Filmed, Tube, film

_POINTS = 120
PLACES = {"fore": 0.25, "middle": 0.5, "hind": 0.75}
"""Where along the body its half thickness is told."""


def film_limbless(
    kind: Literal["snake", "fish"],
    seed: int,
    *,
    frames: int = 40,
    odd: bool = False,
    shadow: bool = False,
) -> Filmed:
    """One that goes to the right through a frame of 360 x 640. odd: as no default body has it.

    shadow: it lies beside the body on the ground. The joint `axis` has all points of a frame in one
    row: (t, 2 n).
    """
    random = np.random.default_rng(seed)
    cycle = random.uniform(14.0, 20.0)
    along = np.linspace(0.0, 1.0, _POINTS)
    time = np.arange(frames)
    if kind == "snake":
        long, thick, waves, most = random.uniform(270.0, 310.0), 0.02, 1.5, 0.75
        swing = np.full(_POINTS, most)
    else:
        long, thick, waves, most = random.uniform(190.0, 220.0), 0.045, 0.9, 0.5
        swing = most * (0.15 + 0.85 * along**1.5)
    thick *= random.uniform(1.5, 1.8) if odd else random.uniform(0.9, 1.1)
    profile = np.minimum(1.0, np.sqrt(np.minimum(along / 0.06, (1.0 - along) / 0.6)))
    half = np.maximum(thick * long * profile, 0.8)
    turn = 2.0 * np.pi * (waves * along - time[:, None] / cycle)
    angle = np.pi + swing * np.sin(turn)
    step = long / (_POINTS - 1) * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    chain = np.concatenate([np.zeros((frames, 1, 2)), np.cumsum(step[:, :-1], axis=1)], axis=1)
    middle = np.stack([320.0 + 2.6 * (time - 0.5 * frames), np.full(frames, 180.0)], axis=1)
    chain = chain - chain.mean(axis=1, keepdims=True) + middle[:, None]
    cast = np.array([[1.0, 0.0, 0.5 * half.max()], [0.0, 1.0, 0.5 * half.max() + 2.0]])
    pictures, behind, masks = film(
        [Tube(chain, half)], (360, 640), random, shadow=cast if shadow else None
    )
    joints = {"axis": chain.reshape(frames, -1), "head": chain[:, 0], "tail": chain[:, -1]}
    return Filmed(
        pictures, behind, masks, joints, cycle, long, lengths={"body": long},
        halves={
            name: float(half[round(share * (_POINTS - 1))]) for name, share in PLACES.items()
        },
    )  # fmt: skip
