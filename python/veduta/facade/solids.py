"""Closed solids beside the building's body: boxes, and trays open at the top."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.facade.paint import Finish
from veduta.place.builder import PartBuilder

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Box:
    """Axis-parallel, metres in the part's frame; the street is at low y."""

    x0: float
    x1: float
    y0: float
    y1: float
    z0: float
    z1: float


def add_box(builder: PartBuilder, box: Box, front: Finish, rest: Finish) -> None:
    """Six faces; the one that looks at the street has a finish of its own."""
    _add(builder, front, _facing_street(box, box.y0))
    _add(builder, rest, _facing_back(box, box.y1))
    _add(builder, rest, _facing_right(box, box.x1))
    _add(builder, rest, _facing_left(box, box.x0))
    _add(builder, rest, _facing_up(box, box.z1))
    _add(builder, rest, _facing_down(box, box.z0))


@dataclass(frozen=True)
class TrayFinish:
    """What the sides of a tray show, on both of their faces, and what the rest shows."""

    front: Finish
    right: Finish
    left: Finish
    inner_front: Finish
    rest: Finish


def add_tray(
    builder: PartBuilder, box: Box, wall_m: float, floor_m: float, finish: TrayFinish
) -> None:
    """A balcony: a floor with three railings, open at the top and towards the building.

    wall_m: thickness of the railings; floor_m: thickness of the floor.
    """
    x0, x1, y0, y1, z0, z1 = box.x0, box.x1, box.y0, box.y1, box.z0, box.z1
    a0, a1, b0, c0 = x0 + wall_m, x1 - wall_m, y0 + wall_m, z0 + floor_m
    inner = Box(a0, a1, b0, y1, c0, z1)
    _add(builder, finish.front, _facing_street(box, y0))
    _add(builder, finish.right, _facing_right(box, x1))
    _add(builder, finish.left, _facing_left(box, x0))
    _add(builder, finish.inner_front, _facing_back(inner, b0))
    _add(builder, finish.left, _facing_right(inner, a0))
    _add(builder, finish.right, _facing_left(inner, a1))
    _add(builder, finish.rest, _facing_down(box, z0))
    _add(builder, finish.rest, _facing_up(inner, c0))
    back = [(x1, z0), (x0, z0), (x0, z1), (a0, z1), (a0, c0), (a1, c0), (a1, z1), (x1, z1)]
    _add(builder, finish.rest, [(x, y1, z) for x, z in back])
    rim = [(x0, y0), (x1, y0), (x1, y1), (a1, y1), (a1, b0), (a0, b0), (a0, y1), (x0, y1)]
    _add(builder, finish.rest, [(x, y, z1) for x, y in rim])


def _add(builder: PartBuilder, finish: Finish, ring: list[Point]) -> None:
    builder.polygon([ring], finish.feature, finish.material, finish.uv)


def _facing_street(box: Box, y: float) -> list[Point]:
    return [(box.x0, y, box.z0), (box.x1, y, box.z0), (box.x1, y, box.z1), (box.x0, y, box.z1)]


def _facing_back(box: Box, y: float) -> list[Point]:
    return _facing_street(box, y)[::-1]


def _facing_right(box: Box, x: float) -> list[Point]:
    return [(x, box.y0, box.z0), (x, box.y1, box.z0), (x, box.y1, box.z1), (x, box.y0, box.z1)]


def _facing_left(box: Box, x: float) -> list[Point]:
    return _facing_right(box, x)[::-1]


def _facing_up(box: Box, z: float) -> list[Point]:
    return [(box.x0, box.y0, z), (box.x1, box.y0, z), (box.x1, box.y1, z), (box.x0, box.y1, z)]


def _facing_down(box: Box, z: float) -> list[Point]:
    return _facing_up(box, z)[::-1]
