"""Words for what has no floor: one looks down into the storey below."""

from __future__ import annotations

import re

from veduta.plan.names.vocabulary import folded, meanings

WORDS = frozenset(
    {"void", "open to below", "vide", "luftraum", "vacío", "doble altura", "vuoto", "חלל",
     "吹抜", "吹抜け"}
)  # fmt: skip
"""Those of the table of words that mean it."""
_OVER = re.compile(r"(?:open|void|vide|vuoto|vazio|luftraum|vacio) (?:to|over|sur|su|sobre|uber) ")
"""And what says over which room one is."""


def says_over(label: str) -> bool:
    """Whether a label says over which room one is: `vide sur salon`."""
    return bool(_OVER.match(folded(label)))


def names_void(label: str) -> bool:
    """Whether a label says that a space is open to what lies below."""
    if says_over(label):
        return True
    return any(one.word in WORDS for one in meanings(label)[:1])
