"""Frames and leaves of doors. Each leaf is a mover: it turns about its hinges, or slides.

Where no drawing says on which side a leaf hangs, `hanging` does, and the feature is marked as
invented.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from shapely.geometry import box

from veduta.place.mover import Mover, Vector
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.entrance import OF_TERRACES
from veduta.plan.house.frame import Frame, Sculptor, Surface, ring_of, upright
from veduta.plan.house.hole import Hole
from veduta.plan.house.sliding import LEAF_M, OVER_M, SLIDING
from veduta.plan.house.space import Space
from veduta.plan.options import HouseOptions

FRAME_M = 0.05
GAP_M = 0.004
TURN_RAD = math.radians(90.0)
OPENED = 0.92
"""How far open doors stand: a leaf at a right angle would touch the wall behind it."""
_OVER_M = OVER_M - GAP_M
_STILE_M = 0.11


@dataclass(frozen=True)
class Leaf:
    """A leaf between two distances from the opening's start; hinge: which of them it turns about.

    turn: +1 counter-clockwise seen from above when it opens, -1 the other way.
    """

    name: str
    start_m: float
    end_m: float
    hinge_m: float
    turn: float


def add_door(hole: Hole, space: Space, sculptor: Sculptor, options: HouseOptions) -> None:
    """Fill one door; a plain gap gets its lining only."""
    opening = hole.opening
    frame = upright(hole.start, hole.along, space.storey.elevation_m)
    drawn = opening.hinge != "none" and opening.swing != "none"
    in_wall = opening.type == "pocket" and opening.hinge != "none"
    known = drawn or in_wall or opening.type == "garage"
    feature = sculptor.builder.feature(
        SemanticClass.DOOR,
        Provenance.INFERRED if known and opening.origin != "invented" else Provenance.INVENTED,
        f"{space.storey.name} door {opening.id}",
        shell=sculptor.builder.new_shell(),
        size_m=(hole.width_m, hole.high_m - hole.low_m),
    )
    inset = 0.0
    if options.door_frames == "surround":
        inset = FRAME_M
        _add_lining(hole, frame, sculptor, feature)
    elif options.door_frames == "bottom":
        _add_threshold(hole, frame, sculptor, feature)
    if opening.kind == "door" and opening.type != "plain":
        door = _Door(hole, frame, sculptor, feature, inset, options.doors == "open")
        door.add()


def _add_lining(hole: Hole, frame: Frame, sculptor: Sculptor, feature: int) -> None:
    """Boards on both sides and above, as deep as the wall and a little more."""
    outer = box(0.0, hole.low_m, hole.width_m, hole.high_m)
    inner = box(FRAME_M, hole.low_m, hole.width_m - FRAME_M, hole.high_m - FRAME_M)
    reach = hole.line.half_m + _OVER_M
    sculptor.prism(outer.difference(inner), -reach, reach, frame, Surface(feature, "frame"))


def _add_threshold(hole: Hole, frame: Frame, sculptor: Sculptor, feature: int) -> None:
    reach = hole.line.half_m
    foot = box(0.0, hole.low_m, hole.width_m, hole.low_m + 0.02)
    sculptor.prism(foot, -reach, reach, frame, Surface(feature, "frame"))


class _Door:
    """The leaves of one door. `side` is +1 where it opens to the left of its wall."""

    def __init__(
        self,
        hole: Hole,
        frame: Frame,
        sculptor: Sculptor,
        feature: int,
        inset_m: float,
        is_open: bool,
    ) -> None:
        self.hole, self.frame, self.sculptor, self.feature = hole, frame, sculptor, feature
        self.first = inset_m + GAP_M
        self.last = hole.width_m - inset_m - GAP_M
        self.bottom = hole.low_m + (0.012 if hole.reaches_floor else GAP_M)
        self.top = hole.high_m - inset_m - GAP_M
        self.opened = OPENED if is_open else 0.0
        self.side = self._side()

    def add(self) -> None:
        """Add what the type of the door asks for."""
        kind = self.hole.type
        if kind in SLIDING:
            self._slide(in_wall=kind == "pocket")
        elif kind == "garage":
            self._lift()
        elif kind == "folding":
            self._fold()
        elif kind in {"double", "french"} or self.hole.hinge == "both":
            middle = (self.first + self.last) / 2.0
            self._swing(Leaf("left", self.first, middle - GAP_M / 2, self.first, self.side))
            self._swing(Leaf("right", middle + GAP_M / 2, self.last, self.last, -self.side))
        elif self.hole.hinge == "end":
            self._swing(Leaf("leaf", self.first, self.last, self.last, -self.side))
        else:
            self._swing(Leaf("leaf", self.first, self.last, self.first, self.side))

    def _side(self) -> float:
        hole = self.hole
        if hole.type == "garage":  # it goes up under the ceiling, inside
            return -1.0 if hole.right is not None and hole.left is None else 1.0
        return -1.0 if hole.swing == "right" else 1.0

    @property
    def look(self) -> str:
        """Doors to the outside are darker, those of terraces framed as windows are."""
        if self.hole.type == "garage":
            return "garage door"
        if not self.hole.is_outer:
            return "leaf"
        return "frame" if self.is_glazed else "entrance"

    @property
    def is_glazed(self) -> bool:
        """Doors onto terraces are of glass, and French doors always are."""
        kind = self.hole.type
        return kind == "french" or (self.hole.is_outer and kind in OF_TERRACES)

    def _swing(self, leaf: Leaf) -> None:
        """A leaf in the wall's face on the side to which it opens."""
        face = self.hole.line.half_m
        polygons = self._leaf(leaf, self.side * (face - LEAF_M), self.side * face)
        self._mover(leaf.name, polygons, (leaf.hinge_m, self.side * face), leaf.turn * TURN_RAD)

    def _slide(self, *, in_wall: bool) -> None:
        """Before the wall or within it, to the ends at which leaves hang."""
        face = self.hole.line.half_m + OVER_M
        near, far = (-LEAF_M / 2, LEAF_M / 2) if in_wall else (face, face + LEAF_M)
        middle = (self.first + self.last) / 2.0
        leaves = {
            "start": [Leaf("leaf", self.first, self.last, self.first, 0.0)],
            "end": [Leaf("leaf", self.first, self.last, self.last, 0.0)],
            "both": [
                Leaf("left", self.first, middle - GAP_M / 2, self.first, 0.0),
                Leaf("right", middle + GAP_M / 2, self.last, self.last, 0.0),
            ],
        }
        for leaf in leaves[self.hole.hinge]:
            polygons = self._leaf(leaf, self.side * near, self.side * far)
            beyond = 1.0 if leaf.hinge_m == leaf.end_m else -1.0
            way = beyond * (leaf.end_m - leaf.start_m) * self.hole.along
            shift = (float(way[0]), float(way[1]), 0.0)
            self._mover(leaf.name, polygons, (leaf.start_m, 0.0), 0.0, shift)

    def _fold(self) -> None:
        """Two leaves that fold onto each other at one end, or two at each."""
        middle = (self.first + self.last) / 2.0
        if self.hole.hinge == "both":
            self._fold_part(self.first, middle - GAP_M / 2, at_end=False, name="left ")
            self._fold_part(middle + GAP_M / 2, self.last, at_end=True, name="right ")
        else:
            self._fold_part(self.first, self.last, at_end=self.hole.hinge == "end")

    def _fold_part(self, start: float, end: float, *, at_end: bool, name: str = "") -> None:
        """Two leaves between two places along the wall, at the end of which they hang."""
        middle = (start + end) / 2.0
        face = self.side * self.hole.line.half_m
        hung, folded = f"{name}hung", f"{name}folded"
        first = Leaf(hung, middle, end, end, -self.side) if at_end else Leaf(
            hung, start, middle, start, self.side
        )  # fmt: skip
        second = Leaf(folded, start, middle, middle, self.side) if at_end else Leaf(
            folded, middle, end, middle, -self.side
        )  # fmt: skip
        self._swing(first)
        polygons = self._leaf(second, face - self.side * LEAF_M, face)
        length = middle - start
        way = length * (
            self.side * self.hole.leftward + (1.0 if at_end else -1.0) * self.hole.along
        )
        way = way + (1.0 if not at_end else -1.0) * LEAF_M * self.hole.along
        shift = (float(way[0]), float(way[1]), 0.0)
        self._mover(folded, polygons, (middle, face), second.turn * TURN_RAD, shift)

    def _lift(self) -> None:
        """One leaf that turns up about its upper edge."""
        leaf = Leaf("leaf", self.first, self.last, self.first, 0.0)
        polygons = self._leaf(leaf, -LEAF_M / 2, LEAF_M / 2)
        pivot = self.frame.place(np.array([[0.0, self.top, 0.0]]))[0]
        along = self.hole.along
        self.sculptor.builder.mover(
            Mover(
                f"{self._name} leaf",
                polygons,
                (float(pivot[0]), float(pivot[1]), float(pivot[2])),
                (float(along[0]), float(along[1]), 0.0),
                self.side * TURN_RAD,
                opened=1.0 if self.opened else 0.0,
            )
        )

    def _leaf(self, leaf: Leaf, first_left: float, last_left: float) -> np.ndarray:
        """The polygons of a leaf between two distances to the left of the centre line."""
        builder = self.sculptor.builder
        start = builder.polygon_count
        near, far = sorted((-first_left, -last_left))  # the frame's third axis points right
        panel = box(leaf.start_m, self.bottom, leaf.end_m, self.top)
        surface = Surface(self.feature, self.look)
        if self.is_glazed:
            glass = box(
                leaf.start_m + _STILE_M, self.bottom + 2 * _STILE_M,
                leaf.end_m - _STILE_M, self.top - _STILE_M,
            )  # fmt: skip
            panel = ring_of(panel, [glass])
            middle = (near + far) / 2.0
            pane = Surface(self.feature, "glass")
            self.sculptor.prism(glass, middle - 0.004, middle + 0.004, self.frame, pane)
        self.sculptor.prism(panel, near, far, self.frame, surface)
        if leaf.turn:
            self._add_handles(leaf, near, far)
        return np.arange(start, builder.polygon_count, dtype=np.int64)

    def _add_handles(self, leaf: Leaf, near: float, far: float) -> None:
        free = leaf.end_m if leaf.hinge_m == leaf.start_m else leaf.start_m
        inwards = -1.0 if free == leaf.end_m else 1.0
        reach = sorted((free + inwards * 0.05, free + inwards * 0.17))
        height = self.hole.low_m + 1.02
        if height + 0.05 > self.top or leaf.end_m - leaf.start_m < 0.3:
            return
        surface = Surface(self.feature, "handle")
        for low, high in ((near - 0.05, near - 0.03), (far + 0.03, far + 0.05)):
            self.sculptor.slab(
                (reach[0], reach[1]), (height, height + 0.022), (low, high), self.frame, surface
            )
        stem = free + inwards * 0.06
        self.sculptor.slab(
            (stem - 0.01, stem + 0.01), (height, height + 0.022),
            (near - 0.05, far + 0.05), self.frame, surface,
        )  # fmt: skip

    @property
    def _name(self) -> str:
        return self.hole.opening.id

    def _mover(
        self,
        name: str,
        polygons: np.ndarray,
        at: tuple[float, float],
        turn_rad: float,
        shift_m: Vector = (0.0, 0.0, 0.0),
    ) -> None:
        """A mover about an upright axis. at: along the wall, and to the left of its centre line."""
        pivot = self.frame.place(np.array([[at[0], self.bottom, -at[1]]]))[0]
        self.sculptor.builder.mover(
            Mover(
                f"{self._name} {name}",
                polygons,
                (float(pivot[0]), float(pivot[1]), float(pivot[2])),
                turn_rad=turn_rad,
                shift_m=shift_m,
                opened=self.opened,
            )
        )
