"""Where the key positions of a graph of transitions are in the world."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.way import Way

Matrix = NDArray[np.float64]


def worlds_of(
    count: int, first: Matrix, ends: list[tuple[int, int]], ways: list[Way], ahead: Matrix
) -> list[Matrix]:
    """(4, 4) world_from_camera of each key position, along the transitions from the first one.

    first: that of the first. The best predicted of several ways to a key position counts. ahead:
    (4, 4) where a key position is put, beside the one before, to which no way leads.
    """
    worlds: dict[int, Matrix] = {0: first}
    known = [
        (one, way) for one, way in zip(ends, ways, strict=True) if way.forth is not None
    ]
    known.sort(key=lambda one: 0.0 if one[1].verdict is None else -one[1].verdict.score_db)
    while len(worlds) < count:
        step = next(
            (one for one in known if (one[0][0] in worlds) != (one[0][1] in worlds)), None
        )
        if step is None:
            lost = min(set(range(count)) - set(worlds))
            worlds[lost] = worlds.get(lost - 1, first) @ ahead
            continue
        (start, end), way = step
        pose = np.vstack([way.second_from_first, [0.0, 0.0, 0.0, 1.0]])
        if start in worlds:
            worlds[end] = worlds[start] @ np.linalg.inv(pose)
        else:
            worlds[start] = worlds[end] @ pose
    return [worlds[number] for number in range(count)]
