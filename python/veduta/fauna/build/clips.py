"""Clips of the skeleton from the gaits of an axis: angles become turns, the course root motion."""

from __future__ import annotations

import numpy as np

from veduta.fauna.build.skeleton import Spine, spine_angles
from veduta.fauna.motion.angles import Floats
from veduta.fauna.motion.gaits import Gait
from veduta.place.skin import Clip


def spine_clip(gait: Gait, spine: Spine, length_m: float) -> Clip:
    """The clip of a gait: the root goes straight along x at an even pace, the spine swings over it.

    The first joint of the spine stands where the head is; the others follow by the segments.
    """
    turns = spine_angles(gait.angles)
    count, joints = turns.shape
    heading = np.stack([np.cos(turns), np.sin(turns)], axis=-1)
    behind = np.cumsum(heading, axis=1) - 0.5 * heading
    head = gait.middle * length_m + spine.segment_m * behind.mean(axis=1)
    root = np.zeros((count, 3))
    pace = gait.times_s / gait.times_s[-1] if gait.times_s[-1] > 0.0 else gait.times_s
    root[:, 0] = pace * gait.stride * length_m
    moves = np.zeros((count, joints + 1, 3))
    moves[:, 0] = root
    moves[:, 1, :2] = head - root[:, :2]
    moves[:, 1, 2] = spine.rest_m[0, 2]
    moves[:, 2:] = np.diff(spine.rest_m, axis=0)
    own = np.diff(turns, axis=1, prepend=0.0)
    return Clip(gait.name, gait.times_s, moves, _about_up(own), gait.loops)


def _about_up(angles: Floats) -> Floats:
    """(t, j + 1, 4) quaternions about z of angles (t, j); the root is not turned."""
    found = np.zeros((angles.shape[0], angles.shape[1] + 1, 4))
    found[:, 0, 3] = 1.0
    found[:, 1:, 2], found[:, 1:, 3] = np.sin(0.5 * angles), np.cos(0.5 * angles)
    return found
