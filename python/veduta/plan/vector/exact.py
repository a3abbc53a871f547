"""Walls that were found on a picture of vectors, laid back onto the vectors: no pixel is left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.pieces import Piece

Segments = NDArray[np.float64]
"""(n, 2, 2): both ends of each, in pixels of the sheet."""
_PARALLEL = np.sin(np.radians(1.0))
_SLANTED = np.sin(np.radians(4.0))
_FACE_PX = 3.0
"""Faces are looked for so near to where they were found, or within a quarter of the thickness."""
_END_PX = 4.0
_SAME_PX = 0.02


def exact_axes(axes: Sequence[Axis], segments: Segments) -> list[Axis]:
    """Each axis with its faces on the lines that they were drawn by, and openings on their ends."""
    if not len(segments):
        return list(axes)
    return [_exact(axis, segments) for axis in axes]


def _exact(axis: Axis, segments: Segments) -> Axis:
    line = axis.line
    if line.bulge or line.length_px < 2.0:
        return axis
    line = _turned(line, segments)
    faces = _faces(line, segments)
    normal = _normal(line.direction)
    low, high = faces
    half = line.thickness_px / 2
    if low is not None and high is not None:
        shift, thickness = (low + high) / 2, high - low
    elif low is not None:
        shift, thickness = low + half, line.thickness_px
    elif high is not None:
        shift, thickness = high - half, line.thickness_px
    else:
        shift, thickness = 0.0, line.thickness_px
    moved = replace(
        line,
        start=line.start + shift * normal,
        end=line.end + shift * normal,
        thickness_px=thickness,
    )
    moved, before = _with_ends(moved, segments)
    openings = tuple(_on_ends(one, before, moved, segments) for one in axis.openings)
    return replace(axis, line=moved, openings=openings)


def _turned(line: Piece, segments: Segments) -> Piece:
    """A slanted wall in the direction of the longest line beside it."""
    if abs(line.direction).max() > 1 - 1e-9:
        return line
    beside = _beside(line, segments, _SLANTED, line.thickness_px / 2 + _FACE_PX)
    if not len(beside):
        return line
    runs = beside[:, 1] - beside[:, 0]
    run = runs[int(np.argmax(np.hypot(*runs.T)))]
    unit = run / np.hypot(*run)
    unit = unit if unit @ line.direction > 0 else -unit
    middle, half = (line.start + line.end) / 2, line.length_px / 2
    return replace(line, start=middle - half * unit, end=middle + half * unit)


def _faces(line: Piece, segments: Segments) -> tuple[float | None, float | None]:
    """Where both faces lie across the wall, from its centre line; None where no line is."""
    half = line.thickness_px / 2
    near = max(_FACE_PX, 0.25 * half)
    beside = _beside(line, segments, _PARALLEL, half + near)
    if not len(beside):
        return None, None
    across = ((beside.mean(axis=1) - line.start) @ _normal(line.direction)).ravel()
    lengths = _overlap(line, beside)
    found: list[float | None] = []
    for face in (-half, half):
        here = (np.abs(across - face) <= near) & (lengths > 0)
        if not here.any():
            found.append(None)
            continue
        places, weights = across[here], lengths[here]
        same = np.abs(places[:, None] - places[None]) <= _SAME_PX
        best = int(np.argmax(same @ weights - 1e-3 * np.abs(places - face)))
        found.append(float(np.average(places[same[best]], weights=weights[same[best]])))
    return found[0], found[1]


def _beside(line: Piece, segments: Segments, turn: float, reach: float) -> Segments:
    """Segments along the line that lie within `reach` of it."""
    runs = segments[:, 1] - segments[:, 0]
    sizes = np.maximum(np.hypot(*runs.T), 1e-9)
    cross = np.abs(runs[:, 0] * line.direction[1] - runs[:, 1] * line.direction[0]) / sizes
    across = np.abs((segments.mean(axis=1) - line.start) @ _normal(line.direction))
    chosen = (cross <= turn) & (across <= reach)
    chosen[chosen] = _overlap(line, segments[chosen]) > 0
    return np.asarray(segments[chosen])


def _overlap(line: Piece, segments: Segments) -> NDArray[np.float64]:
    along = np.sort((segments - line.start) @ line.direction, axis=1)
    return np.asarray(np.minimum(along[:, 1], line.length_px) - np.maximum(along[:, 0], 0.0))


def _with_ends(line: Piece, segments: Segments) -> tuple[Piece, float]:
    """Both ends on the lines that close the wall there; how far the start was moved."""
    first = _stop(line, segments, 0.0)
    last = _stop(line, segments, line.length_px)
    ends = replace(
        line,
        start=line.start + first * line.direction,
        end=line.start + last * line.direction,
    )
    return ends, first


def _on_ends(one: OnAxis, before: float, line: Piece, segments: Segments) -> OnAxis:
    first, last = one.first - before, one.last - before
    return replace(one, first=_stop(line, segments, first), last=_stop(line, segments, last))


def _stop(line: Piece, segments: Segments, along: float) -> float:
    """The end of a line beside the wall, or a line across it, next to `along`."""
    normal = _normal(line.direction)
    points = segments.reshape(-1, 2)
    across = np.abs((points - line.start) @ normal)
    places = (points - line.start) @ line.direction
    here = (across <= line.thickness_px / 2 + 0.5) & (np.abs(places - along) <= _END_PX)
    if not here.any():
        return along
    # Corners of the wall itself go before what is drawn inside it.
    away = np.abs(places[here] - along) + 0.5 * np.abs(across[here] - line.thickness_px / 2)
    return float(places[here][int(np.argmin(away))])


def _normal(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array([-direction[1], direction[0]])
