"""Where a vehicle is by the transforms of a bag (tf): a tree of frames that move."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Pose = NDArray[np.float64]
_DEEPEST = 64


class Transforms:
    """The last that was heard of each frame. world, vehicle: names of frames; a leading slash is
    left out, as ROS 1 has it.
    """

    def __init__(self, world: str, vehicle: str) -> None:
        self._world, self._vehicle = world.lstrip("/"), vehicle.lstrip("/")
        self._above: dict[str, tuple[str, Pose]] = {}

    @property
    def told(self) -> str:
        """Which way is looked for, in words."""
        return f"{self._world} to {self._vehicle}"

    @property
    def frames(self) -> set[str]:
        """All that were heard of."""
        return set(self._above) | {parent for parent, _ in self._above.values()}

    def hear(self, parent: str, child: str, parent_from_child: Pose) -> bool:
        """Whether this moves the vehicle. parent_from_child: (4, 4)."""
        name = child.lstrip("/")
        self._above[name] = (parent.lstrip("/"), parent_from_child)
        return name in self._way()

    def place(self) -> Pose | None:
        """(4, 4) world_from_vehicle; None while no way leads from the one to the other."""
        way = self._way()
        if not way or self._above[way[-1]][0] != self._world:
            return None
        found: Pose = np.eye(4)
        for name in way:
            found = self._above[name][1] @ found
        return found

    def _way(self) -> list[str]:
        """The frames from the vehicle's up to the one below the world's, as far as is known."""
        found: list[str] = []
        at = self._vehicle
        while at != self._world and at in self._above and len(found) < _DEEPEST:
            found.append(at)
            at = self._above[at][0]
        return found
