"""The tail follows the head (paper, equation 9): how snakes move on land."""

from __future__ import annotations

import numpy as np

from veduta.fauna.motion.angles import Floats

HEAD_SHARE = 0.12
"""Over how much of the body the head's own motion fades into the track that it left."""


def own_share(count: int) -> Floats:
    """(count,) m(s): 1 at the head, 0 from a little behind it to the tail."""
    along = np.arange(count) / count / HEAD_SHARE
    return np.where(along < 1.0, 0.5 + 0.5 * np.cos(np.pi * np.minimum(along, 1.0)), 0.0)


def follow_head(angles: Floats, *, periodic: bool) -> Floats:
    """A_f(t, s_k) = m A_c(t, s_k) + (1 - m) A_f(t - 1, s_(k-1)). angles: A_c, (t, n).

    periodic: the rows are a cycle; the recursion then runs until its memory, the length of the
    body, is the cycle's own. Point k reaches in a frame where point k - 1 was: the body slides in
    the head's track if the animal goes on by one point's distance in a frame.
    """
    frames, count = angles.shape
    share = own_share(count)
    before = angles[0].copy()
    runs = 1 + (-(-(count + 1) // frames) if periodic else 0)
    found = np.empty_like(angles)
    for _ in range(runs):
        for frame in range(frames):
            moved = np.concatenate([before[:1], before[:-1]])
            before = share * angles[frame] + (1.0 - share) * moved
            found[frame] = before
    return found
