"""The classes of the pixels, and the sets of classes that a label may leave open.

A picture seldom says one class of every pixel: the CMP set calls sky, roofs, trees and cars all
"background", and a box around a window says nothing of what is outside of it. A label is
therefore a set of classes; in training the classes of the set shall get all of the probability.
"""

from __future__ import annotations

CLASSES = (
    *("window", "wall", "balcony", "door", "shop", "roof", "sky", "ground"),
    *("tree", "hedge", "vehicle", "person", "fence", "wire"),
    *("cornice", "sill", "ornament", "pillar", "blind", "other"),
)
KINDS = ("window", "balcony", "door", "shop")
"""The classes whose single elements get boxes."""

WALL = ("wall", "cornice", "sill", "ornament", "pillar")
BEFORE = ("tree", "hedge", "vehicle", "person", "fence", "wire", "other")
OPENINGS = ("window", "balcony", "door", "shop", "blind")
NOT_OPENINGS = tuple(name for name in CLASSES if name not in OPENINGS)

# A label picture holds places in this table.
SETS: tuple[tuple[str, ...], ...] = (
    CLASSES,  # 0: says nothing
    *((name,) for name in CLASSES),  # 1..20: one class
    WALL,
    ("window", "blind"),
    ("window", "shop", "blind"),
    ("window", "shop", "blind", *WALL),
    ("door", "window", "shop", *WALL),
    NOT_OPENINGS,
    ("roof", "wall", "cornice", "sky", "tree", "wire", "other"),  # beside and above a house
    ("ground", "wall", *BEFORE),  # at its foot
    ("tree", "hedge"),
    ("roof", "wall", "cornice", "tree", "wire", "ground", *BEFORE),  # a background that is no sky
    ("balcony", "fence", "wall"),
    ("wall", "roof", "other", "window", "ground", *BEFORE),
    ("shop", "wall", "ornament", "cornice"),
    ("roof", "sky", "tree", "wire", "other"),  # right above a house
)


def place(*names: str) -> int:
    """The place of a set in the table, whatever its order."""
    wanted = set(names)
    for index, each in enumerate(SETS):
        if set(each) == wanted:
            return index
    raise ValueError(f"no such set: {names}")
