"""What the learned eyes say of the picture as a whole: is it a front, where, and what hides it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence
from veduta.facade.eyes import Seen, SeenElement
from veduta.facade.presence import REMEDY
from veduta.facade.sides import Sides
from veduta.run.errors import NotFoundError

FRONT = (
    "window",
    "wall",
    "balcony",
    "door",
    "shop",
    "cornice",
    "sill",
    "ornament",
    "pillar",
    "blind",
)
WALL = ("wall", "cornice", "sill", "ornament", "pillar")
BEFORE = ("tree", "hedge", "vehicle", "person", "fence", "wire")


@dataclass(frozen=True)
class FrontParameters:
    """When a picture is none of a front, and where the front ends.

    `openings`: the fewest windows, doors and shops. `sure`: the least sum of their scores.
    `believed`: the least share of them among all that the eyes mark (of 87 fronts all but three
    have 0.5 and more; these three and a skyline 0.09 to 0.23).
    `front`: the least share of the picture that is front. `lost`: the share of the windows from
    which on sides that cut them off are not believed. `street`: the share of what is not hidden
    that is ground, from which a row is the street's. `deep`: the least share of the picture's rows
    of a street that does not reach its lower border; `lids`, `lids_share`: so many of the openings
    at most, and as a share, lie below where it begins: set by hand on one photo whose pavement has
    a lid. On 60 photos of `facades/street-cc0-boxes` that the eyes were trained on none of the
    three decides anything (all between 0.01 and 1, 0 and 4, 0.1 and 0.4 are alike, and no true
    opening is lost), for their streets reach the lower border. `hides`: the share of the front from
    which on it is told what stands before it.
    """

    openings: int = 2
    sure: float = 1.3
    believed: float = 0.3
    front: float = 0.2
    lost: float = 0.12
    street: float = 0.5
    deep: float = 0.04
    lids: int = 1
    lids_share: float = 0.2
    hides: float = 0.02


def require_front(
    seen: Seen,
    found: Sequence[SeenElement],
    elements: Sequence[SeenElement],
    parameters: FrontParameters,
) -> None:
    """Raise NotFoundError where next to no opening, or next to no wall, is seen.

    found: all that the eyes mark; elements: those of them that are believed.
    """
    openings = [e for e in elements if e.kind != "balcony"]
    marked = sum(e.kind != "balcony" for e in found)
    if len(openings) < parameters.openings or sum(e.score for e in openings) < parameters.sure:
        seen_here = "no window or door" if not openings else "hardly a window or door"
        raise NotFoundError("a facade", f"{seen_here} is seen in the picture", REMEDY)
    if len(openings) < parameters.believed * marked:
        reason = (
            f"{marked} places look a little like windows or doors, and only {len(openings)} of"
            " them surely are"
        )
        raise NotFoundError("a facade", reason, REMEDY)
    share = float((seen.chance(*FRONT) > 0.5).mean())
    if share < parameters.front:
        raise NotFoundError(
            "a facade",
            f"only {100 * share:.0f} % of the picture is wall, windows, doors or shops",
            REMEDY,
        )


def sides_of(
    plain: Sides,
    evidence: Evidence,
    seen: Seen,
    elements: Sequence[SeenElement],
    parameters: FrontParameters,
) -> Sides:
    """The sides by colour and roof line, unless they cut off windows; and where the street begins.

    `elements` are in pixels of the analysis, from the picture's left border.
    """
    windows = [e for e in elements if e.kind == "window"]
    cut = sum(e.x0 + e.x1 < 2 * plain.left or e.x0 + e.x1 > 2 * plain.right for e in windows)
    sides = plain
    if cut > parameters.lost * len(windows):
        sides = Sides(0, evidence.width, plain.bottom, ())
    size = evidence.width, evidence.height
    hidden = seen.chance_at(size, *BEFORE)[:, sides.left : sides.right]
    ground = seen.chance_at(size, "ground")[:, sides.left : sides.right]
    street = ground.mean(1) > parameters.street * np.maximum(1.0 - hidden.mean(1), 0.2)
    openings = [e for e in elements if e.kind != "balcony"]
    bottom = _street_begins(street, openings, parameters)
    # A lid or a grating in the street is no window of the front.
    lowest = max((e.y1 for e in openings if e.y0 < bottom), default=0.0)
    if bottom < evidence.height and bottom >= lowest - 0.02 * evidence.height:
        share = 100 * bottom / evidence.height
        reason = f"ground: the street begins {share:.0f} % down the picture, and was not read"
        kept = tuple(r for r in sides.reasons if not r.startswith("ground:"))
        sides = replace(sides, bottom=bottom, reasons=(*kept, reason))
    elif sides.bottom < lowest:
        sides = replace(sides, bottom=min(evidence.height, round(lowest)))
    return sides


def _street_begins(
    street: NDArray[np.bool_], openings: Sequence[SeenElement], parameters: FrontParameters
) -> int:
    """The row at which the street begins; the number of rows where none is seen.

    It is where the run of its rows begins that reaches the lower border; or an earlier one that is
    deep and has hardly an opening below it: the eyes often take the pavement's far part for ground
    and the rest of it for a wall.
    """
    borders = np.flatnonzero(np.diff(np.concatenate([[False], street, [False]])))
    for first, end in borders.reshape(-1, 2).tolist():
        below = sum(e.y0 >= first for e in openings)
        cut = sum(e.y0 < first and e.y1 > end for e in openings)
        few = below <= min(parameters.lids, parameters.lids_share * len(openings))
        is_deep = end - first >= parameters.deep * len(street)
        if end == len(street) or (is_deep and few and not cut):
            return int(first)
    return len(street)


def hidden_notes(seen: Seen, parameters: FrontParameters) -> list[str]:
    """What stands before the front, with its share of the picture."""
    most = np.array(seen.names)[seen.classes.argmax(0)]
    shares = {name: float((most == name).mean()) for name in BEFORE}
    told = [
        f"{name} {100 * share:.0f} %"
        for name, share in sorted(shares.items(), key=lambda item: -item[1])
        if share >= parameters.hides
    ]
    return [f"before the front: {', '.join(told)} of the picture"] if told else []
