"""Doors and windows of `plan.dxf` as blocks, and its dimensions."""

from __future__ import annotations

import math

import numpy as np
from ezdxf.document import Drawing as DxfDocument
from numpy.typing import NDArray

from veduta.plan.drawing import Drawing, Shape

DIMENSIONS = "A-ANNO-DIMS"
"""The layer of dimensions, as the National CAD Standard names it."""
_STYLE = "EZ_M_100_H25_CM"
"""A style of ezdxf: metres, for 1:100, text of 2.5 mm, centimetres shown."""
_FIRST_M, _NEXT_M = 0.8, 0.6
"""How far the first row of dimensions is from the walls, and the next from it."""
_APART_M = 0.05
"""Corners of outer walls that are nearer along a side are one."""
_MM = 3


def place_block(document: DxfDocument, shape: Shape, offset_m: float, layer: str) -> None:
    """An opening as a block reference, whose block is made where no like one was there before."""
    start, along = _frame(shape)
    turn = np.array([[along[0], -along[1]], [along[1], along[0]]])
    own = [np.round((line - start) @ turn, _MM) + 0.0 for line in shape.lines]
    name = _block(document, shape, own, layer)
    width = float(max(line[:, 0].max() for line in own))
    reference = document.modelspace().add_blockref(
        name,
        (float(start[0]) + offset_m, float(start[1])),
        dxfattribs={"layer": layer, "rotation": math.degrees(math.atan2(along[1], along[0]))},
    )
    for tag, text in (("ID", shape.name), ("TYPE", shape.kind), ("WIDTH", f"{width:.3f}")):
        attribute = reference.add_attrib(tag, text, insert=reference.dxf.insert)
        attribute.is_invisible = True


def add_dimensions(document: DxfDocument, drawing: Drawing, offset_m: float) -> None:
    """Below and to the left of a storey: from corner to corner of its outer walls, and overall."""
    outer = {name for wall in drawing.storey.walls if wall.outer for name in (wall.start, wall.end)}
    corners = np.array([one.at_m for one in drawing.storey.junctions if one.id in outer])
    rings = [ring for one in drawing.shapes if one.layer == "walls" for ring in one.rings]
    if not len(corners) or not rings:
        return
    if DIMENSIONS not in document.layers:
        document.layers.add(DIMENSIONS, lineweight=18)
    low = np.min([ring.min(axis=0) for ring in rings], axis=0)
    high = np.max([ring.max(axis=0) for ring in rings], axis=0)
    for axis in (0, 1):
        inner = [at for at in _distinct(corners[:, axis]) if low[axis] < at < high[axis]]
        chain = _distinct(np.array([low[axis], *inner[1:-1], high[axis]]))
        _row(document, axis, chain, low, _FIRST_M, offset_m)
        if len(chain) > 2:
            _row(document, axis, [chain[0], chain[-1]], low, _FIRST_M + _NEXT_M, offset_m)


def _row(
    document: DxfDocument,
    axis: int,
    places: list[float],
    low: NDArray[np.float64],
    away_m: float,
    offset_m: float,
) -> None:
    """Dimensions from each place to the next, along x (0) or y (1)."""
    beside = float(low[1 - axis])
    for first, last in zip(places, places[1:], strict=False):
        points = [(at, beside) if axis == 0 else (beside, at) for at in (first, last)]
        base = (first, beside - away_m) if axis == 0 else (beside - away_m, first)
        moved = [(x + offset_m, y) for x, y in (base, *points)]
        dimension = document.modelspace().add_linear_dim(
            base=moved[0],
            p1=moved[1],
            p2=moved[2],
            angle=90.0 * axis,
            dimstyle=_STYLE,
            dxfattribs={"layer": DIMENSIONS},
        )
        dimension.render()


def _distinct(values: NDArray[np.float64]) -> list[float]:
    """Sorted, each a little more than the one before."""
    found: list[float] = []
    for value in sorted(float(one) for one in values):
        if not found or value - found[-1] > _APART_M:
            found.append(value)
    return found


def _block(
    document: DxfDocument, shape: Shape, lines: list[NDArray[np.float64]], layer: str
) -> str:
    """The name of the block with these lines; made where there is none."""
    stem = f"{shape.layer[:-1]}-{shape.kind or 'plain'}".upper()
    number = 1
    while True:
        name = f"{stem}-{number}"
        if name not in document.blocks:
            break
        there = [
            np.array(one.get_points("xy"))  # type: ignore[attr-defined]
            for one in document.blocks.get(name).query("LWPOLYLINE")
        ]
        if _alike(there, lines):
            return name
        number += 1
    block = document.blocks.new(name)
    for line in lines:
        block.add_lwpolyline(line.tolist(), dxfattribs={"layer": layer})
    return name


def _alike(one: list[NDArray[np.float64]], other: list[NDArray[np.float64]]) -> bool:
    return len(one) == len(other) and all(
        a.shape == b.shape and np.allclose(a, b, atol=2e-3) for a, b in zip(one, other, strict=True)
    )


def _frame(shape: Shape) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where an opening begins on the centre line of its wall, and the unit vector along it."""
    first, second = shape.lines[0], shape.lines[1]
    if shape.layer == "windows":
        start, end = (first[0] + second[0]) / 2.0, (first[-1] + second[-1]) / 2.0
    else:
        start, end = first.mean(axis=0), second.mean(axis=0)
    along = end - start
    return start, along / max(float(np.hypot(*along)), 1e-9)
