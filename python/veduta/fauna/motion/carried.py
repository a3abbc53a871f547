"""Where the joints of a skeleton are in a clip: turned, and carried along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from veduta.fauna.motion.figure import Floats
from veduta.place.skin import Clip, Skin


@dataclass(frozen=True, eq=False)
class Joints:
    """turns: (t, j, 3, 3) and places: (t, j, 3) m of all joints in one frame, parents first."""

    turns: Floats
    places: Floats

    def ends(self, joint: int, offset_m: Floats) -> Floats:
        """(t, 3) where a point is that a joint carries with it; offset: (3,) in its frame."""
        return np.asarray(self.places[:, joint] + self.turns[:, joint] @ offset_m)


def joints_in(
    skin: Skin, clip: Clip, seconds: Floats, share: NDArray[np.float64] | None = None
) -> Joints:
    """The joints at times (t,) of a clip, its root where the animal is.

    share: (t,) 0..1 how much of the clip's motion there is; what is left is how the animal stands.
    """
    rest = skin.rest_in_parent()
    turns = _turns_at(clip, seconds)
    moves = np.stack(
        [
            np.stack([np.interp(seconds, clip.times_s, clip.translations_m[:, joint, axis])
                      for axis in range(3)], axis=1)
            for joint in range(len(skin.names))
        ],
        axis=1,
    )  # fmt: skip
    moves[:, 0] = rest[0, :3, 3]
    if share is not None:
        still = Rotation.from_matrix(rest[:, :3, :3]).as_quat()
        part = share[:, None, None]
        turns = _mixed(np.broadcast_to(still, turns.shape), turns, part)
        moves = rest[:, :3, 3] * (1.0 - part) + moves * part
    matrices = Rotation.from_quat(turns.reshape(-1, 4)).as_matrix().reshape(*turns.shape[:2], 3, 3)
    return composed(skin, matrices, moves)


def composed(skin: Skin, turns: Floats, moves: Floats) -> Joints:
    """The joints from what each does against its parent: turns (t, j, 3, 3), moves (t, j, 3)."""
    whole, places = turns.copy(), moves.copy()
    for joint, parent in enumerate(skin.parent):
        if parent >= 0:
            whole[:, joint] = whole[:, parent] @ turns[:, joint]
            moved = np.einsum("tij,tj->ti", whole[:, parent], moves[:, joint])
            places[:, joint] = places[:, parent] + moved
    return Joints(whole, places)


def against_parents(skin: Skin, joints: Joints) -> tuple[Floats, Floats]:
    """Quaternions (t, j, 4) and moves (t, j, 3) of each joint against its parent."""
    turns, moves = joints.turns.copy(), joints.places.copy()
    for joint, parent in enumerate(skin.parent):
        if parent >= 0:
            back = np.swapaxes(joints.turns[:, parent], 1, 2)
            turns[:, joint] = back @ joints.turns[:, joint]
            away = joints.places[:, joint] - joints.places[:, parent]
            moves[:, joint] = np.einsum("tij,tj->ti", back, away)
    flat = Rotation.from_matrix(turns.reshape(-1, 3, 3)).as_quat()
    return flat.reshape(*turns.shape[:2], 4), moves


def _turns_at(clip: Clip, seconds: Floats) -> Floats:
    """(t, j, 4) between the keys on the shorter way."""
    before = np.clip(
        np.searchsorted(clip.times_s, seconds, side="right") - 1, 0, len(clip.times_s) - 2
    )
    span = clip.times_s[before + 1] - clip.times_s[before]
    share = np.clip((seconds - clip.times_s[before]) / span, 0.0, 1.0)[:, None, None]
    return _mixed(clip.rotations_xyzw[before], clip.rotations_xyzw[before + 1], share)


def _mixed(first: Floats, second: Floats, share: Floats) -> Floats:
    same = np.sign((first * second).sum(axis=2, keepdims=True))
    mixed = first * (1.0 - share) + np.where(same < 0.0, -second, second) * share
    size = np.linalg.norm(mixed, axis=2, keepdims=True)
    return np.asarray(mixed / np.maximum(size, 1e-12))
