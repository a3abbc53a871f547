"""Leaves of doors and their traces: quarter circles, chords, and leaves that fold.

This is what AV3D does not have: a trace is sampled for all hinges, sides and sizes at once, so
that an arc that is broken, dashed or drawn open by 60 degrees counts, too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.strip import Sheet, sample

ARC_STEPS = 28
LEAST_RADIUS, MOST_RADIUS = 0.8, 1.08
"""Of a leaf, in widths of its gap ..."""
FEWEST_RADII, RADIUS_STEP_PX = 9, 1.5
"""... in so many steps, or such: the thin pen of a large sheet lies between broader ones."""
SLACK = (-0.5, -0.25, 0.0, 0.25, 0.5)
"""Where across the wall the leaf may hang, in thicknesses."""

CROWDED = 0.6
"""What is drawn beside a trace speaks against it by so much."""

CHORD_STEPS = 40
BARE_ANGLES, BEYOND_STEPS = 11, 8
BARE_THICK = 0.75
"""Leaves are drawn thinner than their walls by this factor, at least."""

FOLD_RUNS = (0.3, 0.38, 0.45, 0.55)
"""Each folded leaf reaches so much of its length along the wall."""

FOLD_SIZES = np.array([0.9, 0.95, 1.0, 1.05])
FOLD_STEPS = 12


@dataclass(frozen=True)
class Arc:
    """A door leaf's trace: how well it is drawn, at which end it hangs, to which side it opens.

    `side` +1 is right of who goes from the gap's start to its end, as seen on the page.
    `radius_share` is the leaf's length in widths of the gap; `hinge` (2,) and `tip` (2,) are the
    pixels of its ends when it stands open at a right angle.
    """

    score: float
    hinge_at_start: bool
    side: int
    radius_share: float
    hinge: NDArray[np.float64]
    tip: NDArray[np.float64]


@dataclass(frozen=True)
class Fold:
    """Leaves that fold: how well they are drawn, from which end, to which side.

    `both`: half of them fold to either end.
    """

    score: float
    hinge_at_start: bool
    side: int
    both: bool = False


@dataclass(frozen=True)
class _Frame:
    """A hinge, the way to the other end of the gap, and the way to which the leaf opens."""

    hinge: NDArray[np.float64]
    closed: NDArray[np.float64]
    opened: NDArray[np.float64]
    at_start: bool
    side: int


def _frames(gap: Gap) -> list[_Frame]:
    way = (gap.end - gap.start) / max(gap.width_px, 1e-9)
    normal = np.array([-way[1], way[0]])
    return [
        _Frame(
            gap.start if at_start else gap.end,
            way if at_start else -way,
            side * normal,
            at_start,
            side,
        )
        for at_start in (True, False)
        for side in (1, -1)
    ]


def find_arcs(gap: Gap, sheet: Sheet) -> tuple[Arc, ...]:
    """The best arc for each hinge and side, of a leaf as wide as the gap or half of it."""
    found = [_arc(gap, sheet, frame, share) for share in (1.0, 0.5) for frame in _frames(gap)]
    return tuple(sorted(found, key=lambda arc: -arc.score))


def find_chords(gap: Gap, sheet: Sheet) -> tuple[Arc, ...]:
    """Open leaves whose way is drawn as a straight line from their tip to the other end."""
    found = [_chord(gap, sheet, frame) for frame in _frames(gap)]
    return tuple(sorted(found, key=lambda one: -one.score))


def find_bare(gap: Gap, sheet: Sheet) -> tuple[Arc, ...]:
    """Open leaves that are drawn as one line alone, at 40 to 90 degrees, and end there."""
    found = [_bare(gap, sheet, frame) for frame in _frames(gap)]
    return tuple(sorted(found, key=lambda one: -one.score))


def find_folds(gap: Gap, sheet: Sheet) -> tuple[Fold, ...]:
    """The best zigzag for each hinge and side, of two or four leaves, and a pair of each side."""
    frames = _frames(gap)
    found = [_fold(gap, sheet, frame) for frame in frames]
    for side in (1, -1):
        halves = [_zigzag(gap, sheet, one, 2, 2) for one in frames if one.side == side]
        found.append(Fold(min(halves), True, side, both=True))
    return tuple(sorted(found, key=lambda one: -one.score))


def leaf_thickness(arc: Arc, sheet: Sheet) -> float:
    """How thick the leaf of an arc is drawn, in pixels: a line, or a slab with two lines."""
    run = arc.tip - arc.hinge
    size = float(np.hypot(*run))
    way = run / max(size, 1e-9)
    normal = np.array([-way[1], way[0]])
    along = np.linspace(0.25, 0.8, max(5, round(0.5 * size)))
    reach = np.arange(-0.14 * size, 0.14 * size + 0.01, 0.5)
    points = arc.hinge + (along * size)[None, :, None] * way + reach[:, None, None] * normal
    dark = sample(sheet.faint, points).mean(axis=1) >= 0.7
    rows = np.flatnonzero(dark)
    return float(reach[rows[-1]] - reach[rows[0]]) if len(rows) else 0.0


def _arc(gap: Gap, sheet: Sheet, frame: _Frame, share: float) -> Arc:
    angles = np.radians(np.linspace(4, 86, ARC_STEPS))
    radii = radii_px(gap.width_px * share)
    hinges = frame.hinge + np.array(SLACK)[:, None] * gap.thickness_px * frame.opened
    turn = np.cos(angles)[:, None] * frame.closed + np.sin(angles)[:, None] * frame.opened
    points = hinges[:, None, None] + radii[None, :, None, None] * turn[None, None]
    # A line is some pixels wide; both of its neighbours are looked at, so that half a pixel
    # of radius does not matter, and the free space inside and outside is asked for.
    width = max(3.0, 0.1 * gap.width_px * share)
    drawn, crowded = _traced(sheet, points, width * turn)
    # Leaves are drawn open by 60 to 90 degrees: the trace is asked for over the first 60.
    first = ARC_STEPS * 2 // 3
    whole, part = drawn.mean(axis=2), drawn[:, :, :first].mean(axis=2)
    score = np.maximum(whole, 0.9 * part) - CROWDED * crowded.mean(axis=2)
    slack, radius = np.unravel_index(int(np.argmax(score)), score.shape)
    hinge = np.asarray(hinges[slack])
    tip = np.asarray(hinge + radii[radius] * frame.opened)
    best = float(max(0.0, score.max()))
    return Arc(best, frame.at_start, frame.side, share, hinge, tip)


def _chord(gap: Gap, sheet: Sheet, frame: _Frame) -> Arc:
    """Both the leaf and the line from its tip must be drawn."""
    sizes = radii_px(gap.width_px)
    hinges = frame.hinge + np.array(SLACK)[:, None] * gap.thickness_px * frame.opened
    leaf, chord = frame.opened, frame.closed - frame.opened
    share = np.linspace(0.08, 0.92, CHORD_STEPS)[:, None]
    width = max(3.0, 0.1 * gap.width_px)
    scores = []
    for at, way in ((share * leaf, frame.closed), (leaf + share * chord, frame.closed + leaf)):
        points = hinges[:, None, None] + sizes[None, :, None, None] * at[None, None]
        drawn, crowded = _traced(sheet, points, np.asarray(width * way / np.hypot(*way)))
        scores.append(drawn.mean(axis=2) - CROWDED * crowded.mean(axis=2))
    score = np.minimum(*scores)
    slack, size = np.unravel_index(int(np.argmax(score)), score.shape)
    hinge = np.asarray(hinges[slack])
    best = float(max(0.0, score.max()))
    tip = np.asarray(hinge + sizes[size] * leaf)
    return Arc(best, frame.at_start, frame.side, 1.0, hinge, tip)


def _bare(gap: Gap, sheet: Sheet, frame: _Frame) -> Arc:
    """A line from the hinge that is as long as the gap is wide: a wall would go on."""
    angles = np.radians(np.linspace(40.0, 90.0, BARE_ANGLES))
    sizes = radii_px(gap.width_px)
    hinges = frame.hinge + np.array(SLACK)[:, None] * gap.thickness_px * frame.opened
    way = np.cos(angles)[:, None] * frame.closed + np.sin(angles)[:, None] * frame.opened
    normal = np.cos(angles)[:, None] * frame.opened - np.sin(angles)[:, None] * frame.closed
    width = max(3.0, 0.1 * gap.width_px)
    shares = (np.linspace(0.12, 0.92, CHORD_STEPS), np.linspace(1.15, 1.4, BEYOND_STEPS))
    # (slack, sizes, angles, steps, 2)
    on, beyond = (
        hinges[:, None, None, None] + sizes[None, :, None, None, None]
        * (share[:, None] * way[:, None])[None, None]
        for share in shares
    )  # fmt: skip
    drawn, crowded = _traced(sheet, on, width * normal[:, None])
    further = sheet.marked(beyond).mean(axis=3)
    score = drawn.mean(axis=3) - CROWDED * crowded.mean(axis=3) - further
    slack, size, angle = np.unravel_index(int(np.argmax(score)), score.shape)
    hinge = np.asarray(hinges[slack])
    tip = np.asarray(hinge + sizes[size] * way[angle])
    best = Arc(float(max(0.0, score.max())), frame.at_start, frame.side, 1.0, hinge, tip)
    # Along a wall there is no leaf: it is as thick as the gap's own.
    thick = leaf_thickness(best, sheet) > BARE_THICK * gap.thickness_px
    return replace(best, score=0.0) if thick else best


def _fold(gap: Gap, sheet: Sheet, frame: _Frame) -> Fold:
    best = max(_zigzag(gap, sheet, frame, leaves) for leaves in (2, 4))
    return Fold(best, frame.at_start, frame.side)


def _zigzag(gap: Gap, sheet: Sheet, frame: _Frame, leaves: int, parts: int = 1) -> float:
    """How well so many folded leaves are drawn, however far they are open.

    They close one of so many parts of the gap.
    """
    hinges = frame.hinge + np.array(SLACK)[:, None] * gap.thickness_px * frame.opened
    wide_px = gap.width_px / parts
    sizes = wide_px / leaves * FOLD_SIZES
    runs = np.array(FOLD_RUNS)[:, None, None, None]
    index = np.arange(leaves)[:, None, None]
    share = np.linspace(0.1, 0.9, FOLD_STEPS)[:, None]
    up = np.where(index % 2 == 0, share, 1 - share)
    rise = np.sqrt(1 - runs**2)
    # (runs, leaves, steps, 2): points of the zigzag with leaves of length 1, and their normals.
    at = (index + share) * runs * frame.closed + up * rise * frame.opened
    turn = np.where(index % 2 == 0, 1.0, -1.0)
    normal = runs * frame.opened - turn * rise * frame.closed
    # (slack, sizes, runs, leaves, steps, 2)
    points = hinges[:, None, None, None, None] + sizes[:, None, None, None, None] * at
    width = max(2.5, 0.16 * wide_px / leaves)
    on, beside = _traced(sheet, points, width * np.broadcast_to(normal, at.shape))
    # All leaves of a zigzag are drawn: one alone is a line of something else.
    score = on.mean(axis=-1).min(axis=-1) - CROWDED * beside.mean(axis=(-1, -2))
    return float(max(0.0, score.max()))


def radii_px(width_px: float) -> NDArray[np.float64]:
    """How long leaves may be that close a gap of that width."""
    steps = int(np.ceil((MOST_RADIUS - LEAST_RADIUS) * width_px / RADIUS_STEP_PX)) + 1
    count = int(np.clip(steps, FEWEST_RADII, 4 * FEWEST_RADII))
    return np.linspace(LEAST_RADIUS, MOST_RADIUS, count) * width_px


def _traced(
    sheet: Sheet, points: NDArray[np.float64], beside: NDArray[np.float64]
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Where a line is drawn at points, and where there is ink beside it, on either side."""
    on = sheet.marked(points)
    one, other = sheet.marked(points - beside), sheet.marked(points + beside)
    return on & ~(one & other), one | other
