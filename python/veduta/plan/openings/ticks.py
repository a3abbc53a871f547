"""Short strokes that were taken for walls, where two panels meet in a way between two walls.

A stroke across, or what panels overlap by, is as dark as a wall. Left as one it would part its
opening in two, and walls would be looked for ahead of it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.plan.openings.classify import Judged, slides
from veduta.plan.openings.evidence import Views
from veduta.plan.openings.gaps import Gap, beyond_corners, find_gaps, trimmed
from veduta.plan.openings.panels import MIDDLE
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece

LONGEST = 2.5
"""Such strokes are at most so many (thin) wall thicknesses long."""
LEAST_WIDTH = 4.0
"""What is narrower than so many is no way with panels."""
WIDEST_PANELS, LEAST_LINES = 22.0, 2
"""A wall of panels is at most so wide, and drawn with so many lines along it."""
BESIDE = 1.5
"""They reach beyond their wall's middle by so many of its thicknesses."""


def tick_pieces(found: Found, views: Views) -> set[int]:
    """Indices of pieces of wall that are where panels meet."""
    most_px = LONGEST * found.thin_px
    short = {
        place
        for place, one in enumerate(found.pieces)
        if one.length_px <= most_px and not one.bulge
    }
    if not short:
        return set()
    walls = [one for place, one in enumerate(found.pieces) if place not in short]
    ticks = set[int]()
    for ahead in find_gaps(walls, found.curved):
        gap = trimmed(ahead, found.solid)
        if gap is None or gap.width_px < LEAST_WIDTH * found.thin_px:
            continue
        within = [place for place in sorted(short) if _within(found.pieces[place], gap)]
        if _meet_in_middle([found.pieces[place] for place in within], gap):
            seen = views(gap)
            if seen.meets or slides(seen):
                ticks |= set(within)
    return ticks


def panels_beyond(found: Found, views: Views) -> list[Judged]:
    """Doors of panels from a corner on to the next wall, in line with a wall that ends there."""
    doors = []
    for gap in beyond_corners(found.pieces):
        share = gap.width_px / max(found.thin_px, gap.thickness_px)
        if not LEAST_WIDTH <= share <= WIDEST_PANELS:
            continue
        free = trimmed(gap, found.solid)
        if free is None or free.width_px < 0.8 * gap.width_px:
            continue
        seen = views(free)
        if seen.meets and seen.inner and len(seen.lines) >= LEAST_LINES:
            doors.append(Judged(free, "door", "sliding", "none", "none", 0.7, seen))
    return doors


def _within(piece: Piece, gap: Gap) -> bool:
    """Whether both ends lie in a gap, or little beside it."""
    place, beside = gap.arc.place(np.stack([piece.start, piece.end]))
    return bool(
        (place > 0.0).all()
        and (place < gap.width_px).all()
        and (np.abs(beside) <= BESIDE * gap.thickness_px).all()
    )


def _meet_in_middle(pieces: Sequence[Piece], gap: Gap) -> bool:
    """Whether there are any, and all lie where panels meet."""
    middles = [(one.start + one.end) / 2.0 for one in pieces]
    if not middles:
        return False
    share = gap.arc.place(np.array(middles))[0] / gap.width_px
    return bool((share >= MIDDLE[0]).all() and (share <= MIDDLE[1]).all())
