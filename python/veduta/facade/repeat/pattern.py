"""What repeats in a front: its columns, its floors, and what each floor has at the columns.

All sizes in metres.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from veduta.facade.repeat.series import Run

OpeningKind = Literal["window", "door", "shop"]


@dataclass(frozen=True)
class Tolerances:
    """How much neighbours may differ and still be one rule.

    across_m, up_m: sizes along and up the wall; about what one window differs from the next where
    the eyes read both of the same make. drift_share: how far an opening may stand from where even
    ones would, of its width. floor_share: heights of floors.
    """

    across_m: float = 0.3
    up_m: float = 0.3
    drift_share: float = 0.25
    floor_share: float = 0.08


@dataclass(frozen=True)
class Bay:
    """A column: so much wall before its opening, the opening, so much wall after it."""

    before_m: float
    wide_m: float
    after_m: float

    @property
    def width_m(self) -> float:
        """From its left border to its right one."""
        return self.before_m + self.wide_m + self.after_m


@dataclass(frozen=True)
class Columns:
    """The row of columns, with what is left of the wall on both sides."""

    left_m: float
    runs: tuple[Run[Bay], ...]
    right_m: float
    bays: tuple[Bay, ...]
    """The same one by one, as read."""

    @property
    def centres_m(self) -> tuple[float, ...]:
        """The middle of each opening, from the left side of the front."""
        found, at = [], self.left_m
        for bay in self.bays:
            found.append(at + bay.before_m + 0.5 * bay.wide_m)
            at += bay.width_m
        return tuple(found)


@dataclass(frozen=True)
class Balconies:
    """Balconies of a floor: one before all its windows, or one before each.

    foot_m: from the floor's foot, below zero where they hang lower. beside_m: how much wider than
    its window one is on each side; for a long one, how far it stays from the sides of the front.
    """

    kind: Literal["long", "each"]
    foot_m: float
    high_m: float
    beside_m: float


@dataclass(frozen=True)
class Floor:
    """A floor with a window at each column, begun `sill_m` above its foot and `high_m` high.

    unread: the columns whose window the photo does not show; it follows the others. rise_m: of the
    arch over each window, 0 for level heads.
    own: the floor's own columns where they are not those of the front.
    """

    height_m: float
    sill_m: float
    high_m: float
    balconies: Balconies | None = None
    unread: tuple[int, ...] = ()
    own: Columns | None = None
    rise_m: float = 0.0


@dataclass(frozen=True)
class GroundCell:
    """An opening of the ground floor with the wall around it; one without a kind is wall."""

    kind: OpeningKind | None
    bay: Bay
    sill_m: float = 0.0
    high_m: float = 0.0


@dataclass(frozen=True)
class Dormers:
    """A row of dormers at the columns, so far above the eaves, or at columns of their own."""

    up_m: float
    wide_m: float
    high_m: float
    own: Columns | None = None


@dataclass(frozen=True)
class Pattern:
    """The front, from the ground up. floor_runs: those above the ground floor."""

    columns: Columns
    ground_m: float
    ground: tuple[Run[GroundCell], ...]
    floors: tuple[Run[Floor], ...]
    dormers: Dormers | None
    notes: tuple[str, ...]
