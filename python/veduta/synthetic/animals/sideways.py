"""A fish from the side: it swings towards the camera and away, and seems the shorter for it."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.animals.film import Filmed, Tube, film
from veduta.synthetic.animals.limbless import PLACES

_POINTS = 160
_FIN = 0.86
"""Where the tail's fin begins, in lengths."""


def film_fish_from_side(
    seed: int,
    *,
    frames: int = 60,
    odd: bool = False,
    leftwards: bool = False,
    keeled: bool = False,
) -> Filmed:
    """One that goes through a frame of 300 x 640, its lengths and half heights known.

    odd: twice as high as the usual. Its course leads up to 12 degrees towards the camera or from
    it. keeled: its slices are no ellipses about its spine; the belly reaches three times as far
    down as the back does up. lengths: "body" as it is, not as it seems; cycle: frames of a swing
    to both sides.
    """
    random = np.random.default_rng(seed)
    cycle = random.uniform(9.0, 14.0)
    long = random.uniform(200.0, 240.0)
    tall = random.uniform(0.08, 0.11) * (random.uniform(1.6, 1.9) if odd else 1.0)
    along = np.linspace(0.0, 1.0, _POINTS)
    body = np.sqrt(np.clip(along / 0.12, 0.0, 1.0)) * (1.0 - 0.85 * np.clip(along / 0.9, 0, 1) ** 2)
    fin = np.where(along > _FIN, (along - _FIN) / (1.0 - _FIN), 0.0)
    half = long * np.maximum(tall * np.maximum(body, 0.9 * fin), 0.004)
    time = np.arange(frames)[:, None]
    swing = random.uniform(0.45, 0.6) * (0.1 + 0.9 * along**2)
    aside = swing * np.cos(2.0 * np.pi * (along - time / cycle))
    step = long / (_POINTS - 1)
    back = np.cumsum(step * np.cos(aside), axis=1)
    away = np.cumsum(step * np.sin(aside), axis=1)
    course = np.radians(random.uniform(-12.0, 12.0))
    seen = np.cos(course) * (back - back.mean(axis=1, keepdims=True)) + np.sin(course) * (
        away - away.mean(axis=1, keepdims=True)
    )
    x = 320.0 - seen + 4.4 * (time - 0.5 * frames)
    y = 150.0 + 6.0 * np.sin(2.0 * np.pi * time / 80.0) + 0.0 * x
    chain = np.stack([640.0 - x if leftwards else x, y], axis=2)
    shown = chain + np.stack([np.zeros(_POINTS), 0.5 * half if keeled else 0.0 * half], axis=1)
    pictures, behind, masks = film([Tube(shown, half, upright=True)], (300, 640), random)
    return Filmed(
        pictures, behind, masks,
        {"axis": chain.reshape(frames, -1), "head": chain[:, 0], "tail": chain[:, -1]},
        cycle, long, lengths={"body": long},
        halves={name: float(half[round(at * (_POINTS - 1))]) for name, at in PLACES.items()},
    )  # fmt: skip
