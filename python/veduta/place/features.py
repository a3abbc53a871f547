"""Feature tables of parts that are not built surface by surface."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.place.part import NO_PARENT, Features
from veduta.place.semantics import Provenance, SemanticClass

FeatureRow = tuple[SemanticClass, Provenance, str]
"""What a feature is, where it comes from, and its name, the only one of its kind in the part."""


def feature_table(part_id: str, rows: Sequence[FeatureRow]) -> Features:
    """The table of some features without sizes, parents or places in a photo.

    Raises ValueError where two rows have one name: the stable ids derive from the names.
    """
    names = tuple(name for _, _, name in rows)
    if len(set(names)) < len(names):
        raise ValueError(f"part {part_id!r} has two features of one name")
    count = len(rows)
    nothing = np.full(count, np.nan)
    return Features(
        id=tuple(f"{part_id}/{name.replace(' ', '-')}" for name in names),
        name=names,
        class_code=np.array([semantic.code for semantic, _, _ in rows], dtype=np.uint8),
        provenance_code=np.array([source.code for _, source, _ in rows], dtype=np.uint8),
        parent=np.full(count, NO_PARENT, dtype=np.int32),
        shell=np.zeros(count, dtype=np.int32),
        width_m=nothing,
        height_m=nothing.copy(),
        photo_px=np.full((count, 4), np.nan),
        seen_height_m=nothing.copy(),
        score=nothing.copy(),
    )
