"""Which elements are believed: the sure ones, and those that stand in line with sure ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes.element import SeenElement
from veduta.facade.eyes.look import Seen

Mask = NDArray[np.bool_]

LOOKS: dict[str, tuple[str, ...]] = {
    "window": ("window", "blind", "door", "shop"),
    "balcony": ("balcony",),
    "door": ("door", "shop"),
    "shop": ("shop",),
}
"""The classes of pixels that an element of a kind may have: shop panes count as windows."""


@dataclass(frozen=True)
class BeliefParameters:
    """When the network's middles and its pixels together are an element.

    sure_*: the score from which on an element needs no others. looks_*: the mean chance of its
    classes (`LOOKS`) that it has then. in_line: how far two borders of elements in one row, or in
    one column, lie apart at most, in the smaller one's sizes. rows_and_columns: kinds that need a
    sure one in their row and one in their column, others need one of both. full_row: so many
    doubtful ones in a row, each in a column with a sure one, support each other.
    Seen on 87 pictures of CMP and of streets that the network was not trained on: of windows with a
    score of 0.35 to 0.5 it is 26 of 95 that are one on the former, and 5 of 97 on the latter. So
    precision rises from 0.90 to 0.93 and 0.63 to 0.76, recall falls from 0.92 to 0.91 on the former
    and stays 0.93. (0.55 for windows: 0.94 and 0.78, but in two of 20 Parisian fronts a floor was
    lost.)
    """

    sure_window: float = 0.5
    sure_balcony: float = 0.5
    sure_door: float = 0.5
    sure_shop: float = 0.4
    looks_window: float = 0.5
    looks_shop: float = 0.4
    in_line: float = 0.2
    full_row: int = 3
    rows_and_columns: tuple[str, ...] = ("window",)


def believed(
    elements: Sequence[SeenElement], seen: Seen, parameters: BeliefParameters | None = None
) -> list[SeenElement]:
    """Those of the elements (pixels of what was looked at) that are believed, in their order."""
    p = parameters or BeliefParameters()
    kept: set[int] = set()
    for kind in LOOKS:
        places = [i for i, e in enumerate(elements) if e.kind == kind]
        some = [elements[i] for i in places]
        for i, keep in zip(places, _believed_of(kind, some, seen, p), strict=True):
            if keep:
                kept.add(i)
    return [e for i, e in enumerate(elements) if i in kept]


def _believed_of(
    kind: str, elements: Sequence[SeenElement], seen: Seen, p: BeliefParameters
) -> list[bool]:
    if not elements:
        return []
    score = {
        "window": p.sure_window,
        "balcony": p.sure_balcony,
        "door": p.sure_door,
        "shop": p.sure_shop,
    }[kind]
    looks = {"window": p.looks_window, "shop": p.looks_shop}.get(kind, 0.0)
    chance = seen.chance(*LOOKS[kind])
    across, down = chance.shape[1] / seen.width_px, chance.shape[0] / seen.height_px
    sure = np.array(
        [e.score >= score and _mean_in(e, chance, across, down) >= looks for e in elements]
    )
    if kind not in ("window", "balcony"):
        return [bool(one) for one in sure]
    rows, columns = _in_line(elements, p.in_line)
    row, column = (rows & sure).any(axis=1), (columns & sure).any(axis=1)
    if kind not in p.rows_and_columns:
        return [bool(one) for one in sure | row | column]
    # A row of doubtful ones, each under or over a sure one, is one.
    full = column & ((rows & column).sum(axis=1) >= p.full_row - 1)
    return [bool(one) for one in sure | (row & column) | full]


def _mean_in(e: SeenElement, chance: NDArray[np.float32], across: float, down: float) -> float:
    """The mean chance in the box of an element."""
    x, y = int(e.x0 * across), int(e.y0 * down)
    part = chance[y : max(y + 1, int(e.y1 * down)), x : max(x + 1, int(e.x1 * across))]
    return float(part.mean()) if part.size else 0.0


def _in_line(elements: Sequence[SeenElement], near: float) -> tuple[Mask, Mask]:
    """Which others stand in the row of each element (n, n), and which in its column (n, n)."""
    box = np.array([[e.x0, e.y0, e.x1, e.y1] for e in elements])
    apart = np.abs(box[:, None] - box[None])
    size = np.minimum((box[:, 2:] - box[:, :2])[:, None], (box[:, 2:] - box[:, :2])[None])
    others = ~np.eye(len(box), dtype=np.bool_)
    close = apart < near * np.tile(size, 2)
    return close[..., 1] & close[..., 3] & others, close[..., 0] & close[..., 2] & others
