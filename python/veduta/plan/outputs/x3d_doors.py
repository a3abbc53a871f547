"""Doors in X3D: who comes near opens them, and they close behind.

A proximity sensor around each door starts one of two short clocks; each clock sends where the leaf
shall go (an interpolator of one value) to a chaser, which takes the leaf there from wherever it is.
So a door that is left while it still opens turns back without a jump, and no script is needed.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from veduta.formats.x3d import Element, X3dScene, place_of, turn_of
from veduta.place.mover import Mover
from veduta.place.part import Part
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space

NEAR_M = 1.5
"""From a door's plane: within it the door opens."""
BESIDE_M = 0.4
OPENING_S = 1.2
_CLOCK_S = 0.05


def add_doors(scene: X3dScene, whole: Element, part: Part, spaces: Sequence[Space]) -> None:
    """All that moves, closed, with a sensor for each door."""
    holes = {
        f"{space.storey.name} door {hole.opening.id}": (space, hole)
        for space in spaces
        for hole in space.holes
    }
    leaves: dict[str, list[Mover]] = defaultdict(list)
    for mover in part.movers:
        leaves[part.features.name[part.polygon_feature[mover.polygons[0]]]].append(mover)
    for name, movers in leaves.items():
        group = scene.node(whole, "Group", name)
        clocks = _clocks(scene, group, name, *holes[name])
        for mover in movers:
            _leaf(scene, group, part, mover, f"{name} {mover.name}", clocks)


def _clocks(
    scene: X3dScene, group: Element, name: str, space: Space, hole: Hole
) -> tuple[Element, Element]:
    """Two clocks: one that starts when somebody comes, and one when nobody is left."""
    middle = hole.middle
    up = space.storey.elevation_m + hole.low_m + (hole.high_m - hole.low_m) / 2.0
    angle = math.atan2(hole.along[1], hole.along[0])
    turned = scene.node(
        group, "Transform", translation=place_of((middle[0], middle[1], up)),
        rotation=turn_of((0.0, 0.0, 1.0), angle),
    )  # fmt: skip
    size = (
        hole.width_m + 2.0 * BESIDE_M,
        hole.high_m - hole.low_m + 0.4,
        2.0 * (NEAR_M + hole.line.half_m),
    )
    sensor = scene.node(turned, "ProximitySensor", f"{name} near", size=size)
    clocks = []
    for event, what in (("enterTime", "opens"), ("exitTime", "closes")):
        clock = scene.node(group, "TimeSensor", f"{name} {what}", cycleInterval=_CLOCK_S)
        scene.route(sensor, event, clock, "set_startTime")
        clocks.append(clock)
    return clocks[0], clocks[1]


def _leaf(
    scene: X3dScene,
    group: Element,
    part: Part,
    mover: Mover,
    name: str,
    clocks: tuple[Element, Element],
) -> None:
    """A leaf, and what takes it to where a clock tells it to go."""
    closed = place_of(mover.pivot_m)
    leaf = scene.node(group, "Transform", name, translation=closed)
    chosen = np.zeros(len(part.polygon_feature), dtype=np.bool_)
    chosen[mover.polygons] = True
    scene.shapes(leaf, part, chosen, mover.pivot_m)
    if mover.turn_rad:
        turns = [turn_of(mover.axis, 0.0), turn_of(mover.axis, mover.turn_rad)]
        _follow(scene, group, leaf, "rotation", turns, clocks)
    if any(mover.shift_m):
        places = [closed, closed + place_of(mover.shift_m)]
        _follow(scene, group, leaf, "translation", places, clocks)


def _follow(
    scene: X3dScene,
    group: Element,
    leaf: Element,
    field: str,
    ends: list[np.ndarray],
    clocks: tuple[Element, Element],
) -> None:
    """A field of a leaf goes to one of two ends, smoothly, when a clock is started."""
    kind = "Orientation" if field == "rotation" else "Position"
    name = f"{leaf.attrib['DEF']} {field}"
    chaser = scene.node(
        group, f"{kind}Chaser", f"{name} chaser", duration=OPENING_S,
        initialValue=ends[0], initialDestination=ends[0],
    )  # fmt: skip
    scene.route(chaser, "value_changed", leaf, f"set_{field}")
    for clock, end, what in zip(clocks, reversed(ends), ("open", "closed"), strict=True):
        goal = scene.node(
            group, f"{kind}Interpolator", f"{name} {what}", key=(0.0, 1.0), keyValue=[end, end]
        )
        scene.route(clock, "fraction_changed", goal, "set_fraction")
        scene.route(goal, "value_changed", chaser, "set_destination")
