"""How well a plan was read: walls, openings, rooms, scale, by what issue and papers ask for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from plan_truth import Gap, Layout, Space
from scipy.optimize import linear_sum_assignment
from shapely.geometry.base import BaseGeometry

LEAST_OVERLAP = 0.5
LEAST_ROOM_IOU = 0.8
LEAST_PARALLEL = 0.9
BESIDE_M = 0.25
SAME_USE = ({"hall", "corridor"},)
"""Uses that plans do not tell apart: which way through a house is called a hall."""

Item = TypeVar("Item")


@dataclass(frozen=True)
class Hits:
    """How many of two lists belong together."""

    right: int
    found: int
    true: int

    @property
    def precision(self) -> float:
        """Share of what was found that is right; 1 where there was nothing to find."""
        return self.right / self.found if self.found else float(self.true == 0)

    @property
    def recall(self) -> float:
        """Share of the truth that was found."""
        return self.right / self.true if self.true else 1.0

    @property
    def f1(self) -> float:
        """Their harmonic mean."""
        both = self.found + self.true
        return 2 * self.right / both if both else 1.0

    def __add__(self, other: Hits) -> Hits:
        """Counts of several sheets."""
        return Hits(self.right + other.right, self.found + other.found, self.true + other.true)


NONE = Hits(0, 0, 0)


@dataclass(frozen=True)
class Score:
    """One sheet. Where nothing could be read, IoU is 0 and nothing was found."""

    wall_iou: float
    wall_recall: float
    openings: Hits
    any_kind: Hits
    doors: Hits
    windows: Hits
    rooms: Hits
    shapes: Hits
    scale_error: float | None


def iou(first: BaseGeometry, second: BaseGeometry) -> float:
    """Intersection over union of areas; 1 for two empty ones."""
    union = first.union(second).area
    return float(first.intersection(second).area / union) if union > 0 else 1.0


def matched(
    found: Sequence[Item], true: Sequence[Item], affinity: Callable[[Item, Item], float]
) -> list[tuple[int, int]]:
    """Pairs one to one with affinity above 0, of the largest total (Hungarian method)."""
    if not found or not true:
        return []
    table = np.array([[affinity(first, second) for second in true] for first in found])
    rows, columns = linear_sum_assignment(-table)
    return [(int(i), int(j)) for i, j in zip(rows, columns, strict=True) if table[i, j] > 0]


def gap_overlap(found: Gap, true: Gap) -> float:
    """IoU of two openings along the true one's wall; 0 unless in the same wall."""
    start, end = true.ends_m
    size = float(np.hypot(*(end - start)))
    along = (end - start) / size
    across = np.array([-along[1], along[0]])
    own = found.ends_m[1] - found.ends_m[0]
    if abs(float(own @ along)) < LEAST_PARALLEL * float(np.hypot(*own)):
        return 0.0
    beside = max(BESIDE_M, true.wall_thickness_m)
    if abs(float((found.ends_m.mean(axis=0) - true.ends_m.mean(axis=0)) @ across)) > beside:
        return 0.0
    low, high = sorted(float(value) for value in (found.ends_m - start) @ along)
    common = min(high, size) - max(low, 0.0)
    return max(0.0, common) / (max(high, size) - min(low, 0.0))


def opening_hits(found: Sequence[Gap], true: Sequence[Gap], kind: bool = True) -> Hits:
    """Openings that overlap by half along the wall and, if asked, are of the right kind."""

    def affinity(first: Gap, second: Gap) -> float:
        share = gap_overlap(first, second)
        same = not kind or first.kind == second.kind
        return share if share >= LEAST_OVERLAP and same else 0.0

    return Hits(len(matched(found, true, affinity)), len(found), len(true))


def same_use(first: str, second: str) -> bool:
    """Whether two rooms serve the same use."""
    return first == second or any({first, second} <= group for group in SAME_USE)


def room_hits(found: Sequence[Space], true: Sequence[Space], use: bool = True) -> Hits:
    """Rooms whose polygons agree by 0.8 and, if asked, that have the same use."""

    def affinity(first: Space, second: Space) -> float:
        if use and not same_use(first.use, second.use):
            return 0.0
        share = iou(first.area, second.area)
        return share if share >= LEAST_ROOM_IOU else 0.0

    return Hits(len(matched(found, true, affinity)), len(found), len(true))


def of_kind(gaps: Sequence[Gap], *kinds: str) -> list[Gap]:
    """The gaps of these kinds."""
    return [gap for gap in gaps if gap.kind in kinds]


def score(found: Layout | None, true: Layout) -> Score:
    """One sheet's measures; None where the sheet could not be read."""
    if found is None:
        lost, rooms = Hits(0, 0, len(true.gaps)), Hits(0, 0, len(true.spaces))
        doors = Hits(0, 0, len(of_kind(true.gaps, "door")))
        windows = Hits(0, 0, len(of_kind(true.gaps, "window")))
        return Score(0.0, 0.0, lost, lost, doors, windows, rooms, rooms, None)
    covered = found.solid.intersection(true.solid).area
    return Score(
        iou(found.solid, true.solid),
        covered / true.solid.area,
        opening_hits(found.gaps, true.gaps),
        opening_hits(found.gaps, true.gaps, kind=False),
        opening_hits(of_kind(found.gaps, "door"), of_kind(true.gaps, "door")),
        opening_hits(of_kind(found.gaps, "window"), of_kind(true.gaps, "window")),
        room_hits(found.spaces, true.spaces),
        room_hits(found.spaces, true.spaces, use=False),
        found.metres_per_px / true.metres_per_px - 1.0,
    )
