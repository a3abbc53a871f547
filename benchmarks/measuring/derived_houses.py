"""Houses that the grammar derives, for streets of synthetic drives."""

from __future__ import annotations

from functools import lru_cache

from veduta import grammar
from veduta.grammar.derivation import Rules
from veduta.grammar.outline import Attribute
from veduta.synthetic.drives import MadeHouse
from veduta.synthetic.seeds import stream

STYLES: tuple[tuple[str, dict[str, Attribute]], ...] = (
    ("haussmann", {}),
    # Upper floors overhang a ground floor that lies back behind columns.
    ("modern-slab", {"columns": True, "facade": "balconies", "storeys": 5.0}),
    ("victorian", {}),
    ("empire", {}),
)
DEPTH_M = 12.0


def derived_house(seed: int) -> MadeHouse:
    """A house of one of the styles, 9 to 18 m wide; the same for the same seed."""
    random = stream(seed, "derived house of a drive")
    style, attributes = STYLES[int(random.integers(len(STYLES)))]
    width = float(random.uniform(9.0, 18.0))
    lot = [(0.0, 0.0), (width, 0.0), (width, DEPTH_M), (0.0, DEPTH_M)]
    derived = grammar.derive(_rules(style), [lot], seed=seed, attributes=attributes)
    return MadeHouse(derived.part(f"house-{seed}"), width, DEPTH_M)


@lru_cache
def _rules(style: str) -> Rules:
    return grammar.parse(style)
