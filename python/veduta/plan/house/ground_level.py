"""Which storey of a house lies at the level of the ground around it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from veduta.plan.document import Storey

_BELOW = frozenset({
    "basement", "subbasement", "cellar", "lower ground", "keller", "kellergeschoss",
    "untergeschoss", "ug", "souterrain", "sous-sol", "cave", "kellari", "kellarikerros", "porão",
    "porao", "subsolo", "sótano", "sotano",
})  # fmt: skip
"""What storeys below the ground are called in the languages that drawings are read in."""
_NAMED_BELOW = re.compile(rf"\b({'|'.join(sorted(_BELOW))})\b", re.IGNORECASE)


def ground_storey(storeys: Sequence[Storey]) -> int:
    """The row of the storey at ground level; storeys from the lowest up.

    It is the lowest one, but for basements: a storey that is named so is none, and where floors lie
    below 0 it is the one whose floor lies nearest to 0. Of basements alone it is the highest.
    """
    rows = [row for row, storey in enumerate(storeys) if not _NAMED_BELOW.search(storey.name)]
    if not rows:
        return len(storeys) - 1
    if storeys[rows[0]].elevation_m >= 0.0:
        return rows[0]
    return min(rows, key=lambda row: abs(storeys[row].elevation_m))
