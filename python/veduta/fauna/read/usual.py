"""What an animal of each kind is like where the record does not tell: all of it is invented."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from veduta.fauna.document.schema import Slice
from veduta.fauna.options import Limbless

USUAL_BEAT_HZ: dict[Limbless, float] = {"snake": 0.8, "worm": 0.5, "fish": 2.0}
"""Swings to both sides and back, a second."""
USUAL_LENGTH_M: dict[Limbless, float] = {"snake": 1.2, "worm": 0.12, "fish": 0.3}

_PROFILES: dict[Limbless, tuple[tuple[float, float, float], ...]] = {
    # place along the body, half width and half height, all in shares of the length
    "snake": (
        (0.0, 0.0060, 0.0050), (0.012, 0.0120, 0.0085), (0.03, 0.0150, 0.0105),
        (0.05, 0.0120, 0.0100), (0.09, 0.0130, 0.0120), (0.3, 0.0175, 0.0165),
        (0.6, 0.0170, 0.0160), (0.8, 0.0110, 0.0105), (0.93, 0.0050, 0.0050), (1.0, 0.0010, 0.0010),
    ),
    "worm": (
        (0.0, 0.0080, 0.0080), (0.05, 0.0200, 0.0200), (0.2, 0.0290, 0.0290),
        (0.5, 0.0320, 0.0320), (0.8, 0.0250, 0.0250), (0.95, 0.0090, 0.0090), (1.0, 0.0010, 0.0010),
    ),
    "fish": (
        (0.0, 0.0120, 0.0120), (0.02, 0.0200, 0.0210), (0.08, 0.0270, 0.0300),
        (0.25, 0.0280, 0.0340), (0.5, 0.0230, 0.0330), (0.64, 0.0180, 0.0400),
        (0.76, 0.0120, 0.0410), (0.86, 0.0070, 0.0420), (0.95, 0.0030, 0.0330),
        (1.0, 0.0008, 0.0040),
    ),
}  # fmt: skip
_SLICES = 61


def usual_slices(kind: Limbless) -> list[Slice]:
    """Slices along a body as that kind mostly has it, closer together at the ends."""
    rows = np.array(_PROFILES[kind])
    even = np.linspace(0.0, 1.0, _SLICES)
    places = 0.5 * even + 0.5 * (0.5 - 0.5 * np.cos(np.pi * even))
    places[0], places[-1] = 0.0, 1.0
    smooth = [_smooth(places, rows[:, 0], rows[:, column]) for column in (1, 2)]
    return [
        Slice(at=float(at), half_width=float(width), half_height=float(height))
        for at, width, height in zip(places, *smooth, strict=True)
    ]


def _smooth(
    at: NDArray[np.float64], places: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Through the values without bumps between them (monotone cubics)."""
    return np.asarray(PchipInterpolator(places, values)(at))


def usual_angles(kind: Limbless, phase: NDArray[np.float64], samples: int) -> NDArray[np.float64]:
    """(t, samples) the angles A(s) of a kind's wave at phases (t,) in turns, head first.

    A fish's axis goes aside by 0.02 - 0.0825 s + 0.1625 s^2 of its length, in a wave of one length
    (Videler and Hess 1984, of a cod); a snake's and a worm's angle is a sine along it (Hirose's
    serpenoid curve).
    """
    along = (np.arange(samples) + 0.5) / samples
    turn = 2.0 * np.pi * (along[None] - phase[:, None])
    if kind == "fish":
        reach, grows = 0.02 - 0.0825 * along + 0.1625 * along**2, -0.0825 + 0.325 * along
        slope = grows * np.sin(turn) + reach * 2.0 * np.pi * np.cos(turn)
        return np.asarray(np.arctan(-slope))
    most, waves = (0.7, 1.5) if kind == "snake" else (0.5, 1.2)
    return np.asarray(most * np.sin(2.0 * np.pi * (waves * along[None] - phase[:, None])))
