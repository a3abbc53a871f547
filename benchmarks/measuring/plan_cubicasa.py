"""`plans/cubicasa`: scanned Finnish plans; how many rooms there are, and which are joined."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from plan_data import PLANS, picture
from plan_reading import read_plans
from plan_truth import Layout, found_layout
from record import Row

from veduta.plan.document import Storey

CLASSES: Mapping[str, str] = {
    "living": "LivingRoom", "kitchen": "Kitchen", "bedroom": "Bedroom", "bathroom": "Bath",
    "toilet": "Bath", "hall": "Entry", "corridor": "Entry", "storage": "Storage",
    "wardrobe": "Storage", "balcony": "Outdoor", "terrace": "Outdoor",
}  # fmt: skip
"""The set's classes; all else is Other."""
STARTS = 60
Value = str | int | float | bool | None
Graph = NDArray[np.bool_]


def rows(jobs: int, pictures: Path | None) -> list[Row]:
    """Asked for: the count of rooms within one on three of four, adjacency F1 0.7."""
    folder = PLANS / "cubicasa"
    known: dict[str, Any] = json.loads((folder / "rooms.json").read_text())
    paths = sorted(folder.glob("*.jpg"))
    table: list[Row] = []
    for path, reading in zip(paths, read_plans(paths, jobs), strict=True):
        name = path.name.split(".")[0]
        row: dict[str, Value] = {
            "set": "cubicasa",
            "part": name,
            "not read": int(reading.storey is None),
            "seconds": reading.seconds,
        }
        found: Layout | None = None
        px_from_m = np.eye(3)
        if reading.storey is not None:
            if name in known:
                row |= measures(reading.storey, known[name])
            scale = 1.0 / reading.storey.scale.metres_per_px
            px_from_m = np.diag([scale, -scale, 1.0])
            found = found_layout(reading.storey, px_from_m, single_line=False)
        table.append(row)
        if pictures is not None:
            picture(path, f"{row}"[:100], found, None, px_from_m, pictures)
    return table


def measures(storey: Storey, truth: Mapping[str, Any]) -> dict[str, Value]:
    """Counts of rooms indoors, and the F1 of which are joined by a door or a gap."""
    true_names = list(truth["graph"])
    classes = [name.rsplit("_", 1)[0] for name in true_names]
    true = np.zeros((len(true_names),) * 2, bool)
    for name, others in truth["graph"].items():
        for other in others:
            i, j = true_names.index(name), true_names.index(other)
            true[i, j] = true[j, i] = i != j
    found_classes = [CLASSES.get(room.use, "Other") for room in storey.rooms]
    found = joined(storey)
    count = sum(number for kind, number in truth["room_type_count"].items() if kind != "Outdoor")
    own = sum(not room.outdoors for room in storey.rooms)
    same = sum((Counter(found_classes) & Counter(classes)).values())
    return {
        "rooms found": own,
        "rooms true": count,
        "count within one": abs(own - count) <= 1,
        "same class": same,
        "adjacency F1": adjacency_f1(found, true, found_classes, classes),
    }


def joined(storey: Storey) -> Graph:
    """Which rooms share a door or a gap."""
    ways = {opening.id for opening in storey.openings if opening.kind != "window"}
    rooms = [set(room.openings) & ways for room in storey.rooms]
    graph = np.zeros((len(rooms),) * 2, bool)
    for i, j in combinations(range(len(rooms)), 2):
        graph[i, j] = graph[j, i] = bool(rooms[i] & rooms[j])
    return graph


def adjacency_f1(
    found: Graph, true: Graph, found_classes: Sequence[str], classes: Sequence[str]
) -> float:
    """F1 of edges under the pairing of rooms that keeps most edges and, then, most classes.

    The set gives no places of rooms, so the pairing is searched: swaps from many starts, which is
    exact enough for a dozen rooms and can only be too low.
    """
    size = max(len(found), len(true))
    first, second = _padded(found, size), _padded(true, size)
    alike = np.zeros((size, size))
    for i, own in enumerate(found_classes):
        for j, other in enumerate(classes):
            alike[i, j] = 0.25 * (own == other)
    rng = np.random.default_rng(0)
    best, kept = -1.0, 0
    for _ in range(STARTS):
        order = _climb(first, second, alike, rng.permutation(size))
        value = _value(first, second, alike, order)
        if value > best:
            best, kept = value, _edges(first, second, order)
    total = int(found.sum() + true.sum()) // 2
    return 2 * kept / total if total else 1.0


def _padded(graph: Graph, size: int) -> Graph:
    whole = np.zeros((size, size), bool)
    whole[: len(graph), : len(graph)] = graph
    return whole


def _edges(first: Graph, second: Graph, order: NDArray[np.intp]) -> int:
    return int((first & second[np.ix_(order, order)]).sum()) // 2


def _value(
    first: Graph, second: Graph, alike: NDArray[np.float64], order: NDArray[np.intp]
) -> float:
    return _edges(first, second, order) + float(alike[np.arange(len(order)), order].sum())


def _climb(
    first: Graph, second: Graph, alike: NDArray[np.float64], order: NDArray[np.intp]
) -> NDArray[np.intp]:
    """Swap pairs as long as that gains."""
    value = _value(first, second, alike, order)
    gained = True
    while gained:
        gained = False
        for i, j in combinations(range(len(order)), 2):
            order[[i, j]] = order[[j, i]]
            new = _value(first, second, alike, order)
            if new > value:
                value, gained = new, True
            else:
                order[[i, j]] = order[[j, i]]
    return order
