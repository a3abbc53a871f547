"""Places to photograph, each from one seed: a street, a block, and a tower among houses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from veduta.synthetic.seeds import stream
from veduta.synthetic.streets.house import House, Street
from veduta.synthetic.streets.rows import Rows
from veduta.synthetic.styles import design

END_M = 12.0
"""From the end of the street to the house that closes it."""
AROUND_TOWER_M = 22.0
"""From the tower's middle to the fronts around it."""
TOWER_WALK_M = 16.5
"""From there to those who take photos of it."""


def plan_street(seed: int) -> Street:
    """Seven to eleven different houses along 60 to 80 m, one at the end, and thirty around.

    The street bends once.
    """
    rng = stream(seed, "street plan")
    width = float(rng.uniform(13.5, 17.0))
    heading = float(rng.uniform(0.0, 2 * np.pi))
    bend = float(np.deg2rad(rng.uniform(12.0, 32.0))) * (1.0 if rng.random() < 0.5 else -1.0)
    lengths = rng.uniform((32.0, 28.0), (42.0, 38.0))
    ways = np.array([[np.cos(a), np.sin(a)] for a in (heading, heading + bend)])
    path = np.concatenate([np.zeros((1, 2)), np.cumsum(lengths[:, None] * ways, axis=0)])
    path -= path[1]
    # The square before the last house is kept free, too.
    rows = Rows(rng, seed, np.concatenate([path, [path[2] + 0.8 * END_M * ways[1]]]), width)
    rows.close(path[2] + END_M * ways[1], ways[1])
    for side in (1.0, -1.0):
        rows.row(path[0], ways[0], float(lengths[0]), side)
        rows.row(path[1], ways[1], float(lengths[1]), side)
    houses = tuple(rows.placed)
    rows.around(path[1], 25.0)
    return Street(seed, path, width, houses, tuple(rows.placed[len(houses) :]))


def plan_block(seed: int) -> Street:
    """A street round a block, with houses on both sides and across its corners."""
    rng = stream(seed, "block plan")
    width = float(rng.uniform(14.0, 16.0))
    size = rng.uniform((78.0, 58.0), (90.0, 66.0))
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * size / 2
    turn = float(rng.uniform(0.0, np.pi / 2))
    c, s = np.cos(turn), np.sin(turn)
    path = corners @ np.array([[c, s], [-s, c]])
    rows = Rows(rng, seed, path, width)
    for corner in path[:4]:
        out = corner / np.linalg.norm(corner)
        rows.close(corner + (0.75 * width + 2.0) * out, out)
    for side in (1.0, -1.0):
        for start, end in zip(path, path[1:], strict=False):
            length = float(np.linalg.norm(end - start))
            rows.row(start, (end - start) / length, length, side)
    houses = tuple(rows.placed)
    rows.around(np.zeros(2), 70.0)
    return Street(seed, path, width, houses, tuple(rows.placed[len(houses) :]))


def plan_tower(seed: int) -> Street:
    """A house with the same front on all four sides, in the middle of a ring of others.

    The path goes round it.
    """
    rng = stream(seed, "tower plan")
    layout = design("modern", seed, 3, 3)
    side = layout.width_m
    tower = House(
        "tower",
        (-side / 2, -side / 2),
        0.0,
        side,
        side,
        0.0,
        layout.height_m,
        replace(layout, depth_m=side),
        seed,
        four_sided=True,
    )
    turns = np.linspace(0.0, 2 * np.pi, 33)
    path = TOWER_WALK_M * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    rows = Rows(rng, seed, path, 0.0, fewest_floors=4)
    rows.placed.append(tower)
    rows.ring(AROUND_TOWER_M)
    return Street(seed, path, 30.0, tuple(rows.placed), ())
