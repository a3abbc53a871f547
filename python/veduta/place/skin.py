"""What lets a mesh move: shapes that it morphs into, a skeleton, and clips of its motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

ROOT = -1
"""The parent of a joint that hangs on nothing."""


@dataclass(frozen=True, eq=False)
class Morph:
    """A second shape of a mesh. positions_m: (v, 3) float32, where its vertices are at weight 1."""

    name: str
    positions_m: NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Skin:
    """A skeleton, and how much each vertex follows which joints. Frame: the part's (z up, m).

    parent: (j,) int32, the joint that each hangs on, earlier in the list; -1 for a root.
    rest: (j, 4, 4) float64, part_from_joint in the pose in which the mesh was made; rigid.
    joints: (v, 4) uint16 and weights: (v, 4) float32, which add up to 1 for each vertex.
    """

    names: tuple[str, ...]
    parent: NDArray[np.int32]
    rest: NDArray[np.float64]
    joints: NDArray[np.uint16]
    weights: NDArray[np.float32]

    def __post_init__(self) -> None:
        count = len(self.names)
        if self.parent.shape != (count,) or self.rest.shape != (count, 4, 4):
            raise ValueError("the columns of the skeleton do not belong together")
        if (self.parent >= np.arange(count)).any() or (self.parent < ROOT).any():
            raise ValueError("a joint stands before its parent, or has none that is there")
        if self.joints.shape != self.weights.shape or self.joints.shape[1:] != (4,):
            raise ValueError("joints and weights must be (v, 4)")
        if len(self.joints) and int(self.joints.max()) >= count:
            raise ValueError("a vertex follows a joint that is not there")
        if len(self.weights) and np.abs(self.weights.sum(axis=1) - 1.0).max() > 1e-3:
            raise ValueError("the weights of a vertex do not add up to 1")

    def rest_in_parent(self) -> NDArray[np.float64]:
        """(j, 4, 4) parent_from_joint in the rest pose; of a root, part_from_joint."""
        local = self.rest.copy()
        hanging = self.parent >= 0
        above = np.linalg.inv(self.rest[self.parent[hanging]])
        local[hanging] = above @ self.rest[hanging]
        return local


@dataclass(frozen=True)
class Contact:
    """When a foot stands in a clip. joint: its last one. down_s: from when to when, in order.

    leg: its joints from the body on, if they are known. end_m: where its leg ends, in the frame of
    the last of them.
    """

    foot: str
    joint: str
    down_s: tuple[tuple[float, float], ...]
    leg: tuple[str, ...] = ()
    end_m: tuple[float, float, float] | None = None


@dataclass(frozen=True, eq=False)
class Clip:
    """A motion of a skeleton, key by key: parent_from_joint at each time.

    times_s: (t,) ascending from 0. translations_m: (t, j, 3). rotations_xyzw: (t, j, 4), unit
    quaternions; the frame of a root's parent is the part's. loops: whether it begins anew at its
    end without a jump. contacts: when each foot stands, where that is known.
    """

    name: str
    times_s: NDArray[np.float64]
    translations_m: NDArray[np.float64]
    rotations_xyzw: NDArray[np.float64]
    loops: bool = False
    contacts: tuple[Contact, ...] = ()

    def __post_init__(self) -> None:
        count = len(self.times_s)
        if self.translations_m.shape[:1] != (count,) or self.rotations_xyzw.shape[:1] != (count,):
            raise ValueError(f"clip {self.name!r}: columns do not belong together")
        if count == 0 or self.times_s[0] != 0.0 or (np.diff(self.times_s) <= 0.0).any():
            raise ValueError(f"clip {self.name!r}: times do not ascend from 0")
        if np.abs(np.linalg.norm(self.rotations_xyzw, axis=-1) - 1.0).max() > 1e-3:
            raise ValueError(f"clip {self.name!r}: rotations are no unit quaternions")
