"""Plans in the form that the scorers compare: found ones and true ones, in metres of the truth.

A document's storey lies in metres of the scale that it assumes, on a cleaned sheet. It is taken
back through the pixels of the scan to the truth's plan frame, so that a wrong scale is a wrong
scale and not wrong walls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely import make_valid
from shapely.affinity import affine_transform
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Storey as FoundStorey
from veduta.synthetic.plans import bodies, curves
from veduta.synthetic.plans.house import Opening, Wall
from veduta.synthetic.plans.house import Storey as TrueStorey
from veduta.synthetic.plans.truth_file import SheetTruth

Affine = NDArray[np.float64]
SINGLE_LINE_M = 0.15
"""Walls drawn as one line have no thickness to find: both sides get this one."""


@dataclass(frozen=True)
class Gap:
    """An opening as a stretch (2, 2) of its wall's centre line."""

    kind: str
    type: str
    ends_m: NDArray[np.float64]
    wall_thickness_m: float


@dataclass(frozen=True)
class Space:
    """A room: its free floor and what it is for."""

    use: str
    area: BaseGeometry


@dataclass(frozen=True)
class Layout:
    """A storey as it is compared; `solid` is the walls less their openings."""

    solid: BaseGeometry
    whole: BaseGeometry
    gaps: tuple[Gap, ...]
    spaces: tuple[Space, ...]
    metres_per_px: float


def true_layout(truth: SheetTruth) -> Layout:
    """The truth of a synthetic sheet."""
    storey = truth.storey
    rooms = tuple(Space(room.use, Polygon(room.outline_m)) for room in storey.rooms)
    return _layout(storey, rooms, truth.metres_per_px, truth.walls_drawn == "single-line")


def found_layout(storey: FoundStorey, px_from_m: Affine, single_line: bool) -> Layout:
    """What was found on a sheet, in metres of the truth, whose affine to the scan is given."""
    walls, openings = _walls_of(storey), _openings_of(storey)
    copied = TrueStorey(0, walls, openings, ())
    to_truth = np.linalg.inv(px_from_m) @ scan_from_found(storey)
    scale = float(abs(np.linalg.det(to_truth[:2, :2])) ** 0.5)
    spaces = tuple(
        Space(room.use, make_valid(Polygon(room.outline_m, room.holes_m)))
        for room in storey.rooms
        if not room.outdoors and len(room.outline_m) >= 3
    )
    clean = np.asarray(storey.sheet.clean_from_scan, float)
    size = storey.scale.metres_per_px * float(abs(np.linalg.det(clean[:2, :2])) ** 0.5)
    if single_line:  # of the truth's metres, whatever the document takes for one
        copied = _thin(copied, SINGLE_LINE_M / scale)
    return _moved(_layout(copied, spaces, size, False), to_truth)


def scan_from_found(storey: FoundStorey) -> Affine:
    """The affine (3, 3) from the document's plan frame to pixels of the file."""
    sheet = storey.sheet
    scale = 1.0 / sheet.metres_per_px
    clean_from_m = np.array(
        [[scale, 0.0, sheet.origin_px[0]], [0.0, -scale, sheet.origin_px[1]], [0.0, 0.0, 1.0]]
    )
    return np.asarray(np.linalg.inv(np.asarray(sheet.clean_from_scan, float)) @ clean_from_m)


def _thin(storey: TrueStorey, thickness_m: float) -> TrueStorey:
    return replace(
        storey, walls=tuple(replace(wall, thickness_m=thickness_m) for wall in storey.walls)
    )


def _layout(
    storey: TrueStorey, spaces: Sequence[Space], metres_per_px: float, single_line: bool
) -> Layout:
    if single_line:
        storey = _thin(storey, SINGLE_LINE_M)
    walls = {wall.id: wall for wall in storey.walls}
    gaps = tuple(_gap(walls[opening.wall], opening) for opening in storey.openings)
    whole = bodies.whole_walls(storey.walls)
    return Layout(bodies.solid_walls(storey), whole, gaps, tuple(spaces), metres_per_px)


def _gap(wall: Wall, opening: Opening) -> Gap:
    size = curves.wall_length(wall)
    shares = np.array([opening.along_m, opening.along_m + opening.width_m]) / size
    ends = curves.at(wall.start_m, wall.end_m, wall.bulge, shares)
    return Gap(opening.kind, opening.type, ends, wall.thickness_m)


def _walls_of(storey: FoundStorey) -> tuple[Wall, ...]:
    """The document's walls in the form of the synthetic ones, whose geometry is the oracle."""
    at = {junction.id: junction.at_m for junction in storey.junctions}
    return tuple(
        Wall(wall.id, at[wall.start], at[wall.end], wall.bulge, wall.thickness_m, None, None)
        for wall in storey.walls
        if at[wall.start] != at[wall.end] and wall.thickness_m > 0
    )


def _openings_of(storey: FoundStorey) -> tuple[Opening, ...]:
    kept = {wall.id for wall in _walls_of(storey)}
    return tuple(
        Opening(
            opening.id,
            opening.wall,
            "gap" if opening.kind == "door" and opening.type == "plain" else opening.kind,
            opening.type,  # type: ignore[arg-type]
            opening.along_m,
            opening.width_m,
        )
        for opening in storey.openings
        if opening.wall in kept and opening.width_m > 0
    )


def _moved(layout: Layout, affine: Affine) -> Layout:
    """The layout under an affine; areas of mirror images turn over by themselves."""
    row = [*affine[0, :2], *affine[1, :2], affine[0, 2], affine[1, 2]]
    scale = float(abs(np.linalg.det(affine[:2, :2])) ** 0.5)
    return Layout(
        affine_transform(layout.solid, row),
        affine_transform(layout.whole, row),
        tuple(
            replace(
                gap,
                ends_m=gap.ends_m @ affine[:2, :2].T + affine[:2, 2],
                wall_thickness_m=gap.wall_thickness_m * scale,
            )
            for gap in layout.gaps
        ),
        tuple(replace(space, area=affine_transform(space.area, row)) for space in layout.spaces),
        layout.metres_per_px,
    )
