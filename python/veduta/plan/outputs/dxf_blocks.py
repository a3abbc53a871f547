"""Doors and windows of `plan.dxf` as blocks, and its dimensions."""

from __future__ import annotations

import math

import numpy as np
from ezdxf.document import Drawing as DxfDocument
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.drawing import Drawing, Shape
from veduta.plan.house.space import pieces_of
from veduta.plan.terrace import axis_of

DIMENSIONS = "A-ANNO-DIMS"
"""The layer of dimensions, as the National CAD Standard names it."""
_STYLE = "EZ_M_100_H25_CM"
"""A style of ezdxf: metres, for 1:100, text of 2.5 mm, centimetres shown."""
_FIRST_M, _NEXT_M = 0.8, 0.6
"""How far the first row of dimensions is from the walls, and the next from it."""
_APART_M = 0.05
"""Corners of outer walls that are nearer along a side are one."""
_TURN_RAD = math.radians(20.0)
"""What turns less is a bow's, whose pieces turn by 6 degrees."""
_PLAIN_M = 0.005
_JOG_M = 0.1
"""Where an outline turns twice within this, it turns by both together."""
_TAGS = ("ID", "TYPE", "WIDTH")
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
    for tag, text in zip(_TAGS, (shape.name, shape.kind, f"{width:.3f}"), strict=True):
        attribute = reference.add_attrib(tag, text, insert=reference.dxf.insert)
        attribute.is_invisible = True


def add_dimensions(document: DxfDocument, drawing: Drawing, offset_m: float) -> None:
    """Beside a storey, along its walls: from corner to corner of their outer faces, and overall."""
    rings = [ring for ring in drawing.outlines_m if len(ring) > 2]
    if not rings:
        return
    if DIMENSIONS not in document.layers:
        document.layers.add(DIMENSIONS, lineweight=18)
    axis = axis_of(drawing.storey)
    frame = np.array([[np.cos(axis), np.sin(axis)], [-np.sin(axis), np.cos(axis)]])
    corners = np.concatenate([_corners(ring) for ring in rings]) @ frame.T
    points = np.concatenate(rings) @ frame.T
    low, high = points.min(axis=0), points.max(axis=0)
    for row in (0, 1):
        ends = [float(low[row]), float(high[row])]
        chain = [ends[0], *_between(corners[:, row], *ends), ends[1]]
        _row(document, frame, row, chain, low, _FIRST_M, offset_m)
        if len(chain) > 2:
            _row(document, frame, row, ends, low, _FIRST_M + _NEXT_M, offset_m)


def _corners(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 2) where an outline turns: not along bows, nor where a wall is a little thicker."""
    # Where walls meet in a bow, slits without a width may be left between them.
    closed = Polygon(ring).buffer(_PLAIN_M, join_style="mitre")
    whole = pieces_of(closed.buffer(-_PLAIN_M, join_style="mitre").simplify(_PLAIN_M))
    plain = np.array(max(whole, key=lambda one: one.area).exterior.coords)[:-1]
    into = plain - np.roll(plain, 1, axis=0)
    out = np.roll(into, -1, axis=0)
    turn = np.arctan2(into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0], (into * out).sum(axis=1))
    far = np.hypot(*into.T) > _JOG_M
    if not far.any():
        return plain[:0]
    # Turns that are near each other are one: the two of a jog cancel each other.
    group = np.cumsum(np.roll(far, -int(far.argmax()))) - 1
    turn, plain = (np.roll(one, -int(far.argmax()), axis=0) for one in (turn, plain))
    firsts = np.flatnonzero(np.diff(group, prepend=-1))
    return np.asarray(plain[firsts][np.abs(np.bincount(group, turn)) > _TURN_RAD])


def _row(
    document: DxfDocument,
    frame: NDArray[np.float64],
    row: int,
    places: list[float],
    low: NDArray[np.float64],
    away_m: float,
    offset_m: float,
) -> None:
    """Dimensions from each place to the next, along a row of the frame (2, 2): 0 or 1."""
    along, across = frame[row], frame[1 - row]
    beside = float(low[1 - row])
    for first, last in zip(places, places[1:], strict=False):
        points = [
            first * along + (beside - away_m) * across,
            first * along + beside * across,
            last * along + beside * across,
        ]
        base, start, end = ((float(x) + offset_m, float(y)) for x, y in points)
        dimension = document.modelspace().add_linear_dim(
            base=base,
            p1=start,
            p2=end,
            angle=math.degrees(math.atan2(along[1], along[0])),
            dimstyle=_STYLE,
            dxfattribs={"layer": DIMENSIONS},
        )
        dimension.render()


def _between(values: NDArray[np.float64], low: float, high: float) -> list[float]:
    """Sorted, each a little more than the one before, and as far within the ends."""
    found: list[float] = []
    for value in sorted(float(one) for one in values):
        if value - (found[-1] if found else low) > _APART_M and high - value > _APART_M:
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
    for tag in _TAGS:
        asked = block.add_attdef(tag, insert=(0.0, 0.0), dxfattribs={"layer": layer})
        asked.dxf.prompt = tag
        asked.is_invisible = True
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
