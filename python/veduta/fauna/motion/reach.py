"""Legs in space that reach for places: damped least squares over joints that turn any way."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from veduta.fauna.motion.figure import Floats

_ROUNDS = 16
_DAMPING = 1e-5
"""In squared lengths of the leg: where it is stretched its joints do not run wild."""
_MOST_RAD = 0.35
"""A joint turns by so much at most in a round."""


def reached_in_space(joints: Floats, end: Floats, wanted: Floats) -> tuple[Floats, Floats]:
    """Turns (t, n, 3, 3) of a leg's n segments with which its end is where it is wanted, and (t,)
    how far off it stays.

    joints: (t, n, 3) where the segments begin, end: (t, 3) of the last of them, wanted: (t, 3). The
    turns are in the frame of the places, and come after the segments' own; they are as small as
    they can be, so the leg keeps bending the way it bent.
    """
    count, segments = joints.shape[:2]
    places = np.concatenate([joints, end[:, None]], axis=1)
    along = np.diff(places, axis=1)
    long = float(np.linalg.norm(along, axis=2).sum(axis=1).max())
    damping = _DAMPING * long * long * np.eye(3)
    turns = np.tile(np.eye(3), (count, segments, 1, 1))
    for _ in range(_ROUNDS):
        away = wanted - places[:, -1]
        arm = places[:, -1:] - places[:, :-1]
        square = (arm**2).sum(axis=2)
        outer = np.einsum("tni,tnj->tij", arm, arm)
        matrix = square.sum(axis=1)[:, None, None] * np.eye(3) - outer + damping
        push = np.linalg.solve(matrix, away[..., None])[..., 0]
        turn = np.cross(arm, push[:, None])
        size = np.linalg.norm(turn, axis=2, keepdims=True)
        turn *= np.minimum(1.0, _MOST_RAD / np.maximum(size, 1e-12))
        own = Rotation.from_rotvec(turn.reshape(-1, 3)).as_matrix().reshape(count, segments, 3, 3)
        # Each joint turns all that hangs on it: from the far end to the near one.
        whole = own.copy()
        for segment in range(1, segments):
            whole[:, segment] = whole[:, segment - 1] @ own[:, segment]
        turns = whole @ turns
        along = np.einsum("tnij,tnj->tni", whole, along)
        places[:, 1:] = places[:, :1] + np.cumsum(along, axis=1)
    return turns, np.asarray(np.linalg.norm(wanted - places[:, -1], axis=1))
