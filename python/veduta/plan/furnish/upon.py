"""Things on things: lamps on nightstands, a computer on a desk, a bowl on a table.

AV3D, "Objects placement": a thing on another rests on the part of it that carries it, not on its
bounding box; the parts that carry are the `surface` table of the catalogue.
"""

from __future__ import annotations

import numpy as np

from veduta.plan.furnish.catalogue.entry import SupportSurface
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.layout import Layout, Stood

UPON: dict[str, tuple[tuple[str, float, int], ...]] = {
    "nightstand": (("table-lamp", 0.9, 9), ("books", 0.4, 9)),
    "desk": (("computer", 0.75, 1), ("laptop", 0.6, 1), ("desk-lamp", 0.8, 1), ("books", 0.5, 1)),
    "coffee-table": (("bowl", 0.6, 1), ("books", 0.7, 1), ("candles", 0.5, 1)),
    "dining-table": (("fruit-bowl", 0.7, 1), ("flowers", 0.7, 1)),
    "round-table": (("flowers", 0.9, 1),),
    "garden-table": (("flowers", 0.5, 1),),
    "chest": (("table-lamp", 0.5, 1), ("vase", 0.5, 1), ("pot-plant", 0.5, 1), ("books", 0.6, 1)),
    "sideboard": (("table-lamp", 0.8, 1), ("vase", 0.7, 1), ("books", 0.7, 1),
                  ("pot-plant", 0.6, 1), ("bowl", 0.5, 1)),
    "console": (("bowl", 0.8, 1), ("vase", 0.6, 1), ("table-lamp", 0.5, 1)),
    "side-table": (("table-lamp", 0.8, 1), ("pot-plant", 0.5, 1)),
    "bookcase-low": (("pot-plant", 0.8, 1), ("vase", 0.6, 1), ("books", 0.6, 1)),
    "shoe-cabinet": (("bowl", 0.8, 1), ("pot-plant", 0.4, 1)),
    "wall-shelf": (("pot-plant", 0.7, 1), ("books", 0.7, 1), ("vase", 0.5, 1)),
    "fireplace": (("candles", 0.9, 1), ("vase", 0.6, 1)),
    "kitchen-unit": (("microwave", 0.8, 1), ("coffee-machine", 0.8, 1), ("kettle", 0.9, 1),
                     ("toaster", 0.8, 1), ("canisters", 0.7, 1), ("fruit-bowl", 0.4, 1)),
    "kitchen-drawers": (("canisters", 0.8, 1), ("kettle", 0.6, 1), ("toaster", 0.6, 1)),
    "kitchen-island": (("fruit-bowl", 0.9, 1),),
}  # fmt: skip
"""By the type of what carries: types, how likely each is, and how often it is in a room."""
SPACING_M = 0.08


def place_upon(layout: Layout, choice: Choice, rng: np.random.Generator) -> None:
    """Put things on all that carries them in a room."""
    count: dict[str, int] = {}
    for parent in list(layout.stood):
        for surface in parent.entry.surfaces:
            if parent.entry.type in UPON:
                _fill(parent, surface, layout, choice, rng, count)


def _fill(
    parent: Stood, surface: SupportSurface, layout: Layout, choice: Choice,
    rng: np.random.Generator, count: dict[str, int],
) -> None:  # fmt: skip
    """From one end of the surface to the other, what fits and does not break there."""
    width, depth, height = parent.size_m
    at = (surface.left - 0.5) * width
    end = (surface.right - 0.5) * width
    deep = (surface.back - surface.front) * depth
    chosen = []
    room = end - at
    for kind, chance, most in UPON[parent.entry.type]:
        if rng.random() >= chance or count.get(kind, 0) >= most or not choice.knows(kind):
            continue
        entry = choice.entry(kind)
        size = entry.sized()
        fits = size[0] <= room and size[1] <= deep and size[2] <= surface.free_m
        if fits and entry.fragility <= surface.fragility:
            chosen.append((entry, size))
            room -= size[0] + SPACING_M
    slack = max(0.0, room + SPACING_M) / (len(chosen) + 1)
    for entry, size in chosen:
        at += slack
        # What has a back, a screen for one, stands with it at the back.
        y = (surface.back - 0.5) * depth - size[1] / 2.0 if "back" in entry.walls or (
            depth > 0.5 and parent.entry.walls
        ) else ((surface.front + surface.back) / 2.0 - 0.5) * depth  # fmt: skip
        point = parent.point(at + size[0] / 2.0, y)
        thing = Stood(
            entry, size, (round(float(point[0]), 4), round(float(point[1]), 4)),
            parent.turn, round(parent.above_m + surface.height * height, 4),
            parent, parent.group,
        )  # fmt: skip
        at += size[0] + SPACING_M
        if layout.allows(thing):
            layout.add([thing])
            count[entry.type] = count.get(entry.type, 0) + 1
