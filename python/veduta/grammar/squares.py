"""The lots of a call by squares of a map: what a process works on at a time."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.block import Block
from veduta.grammar.lot import Lot, anchors_of
from veduta.grammar.neighbours import Beside, neighbours_of
from veduta.grammar.quadtree import squares

FEW = 64
"""Lots that a block may always have; so many get a file each."""
MOST_BLOCKS = 48
"""So many blocks a town has, unless that makes them too large."""
MOST_LOTS = 4096
"""Of a block: it bounds what a process needs, and what a killed run loses."""


@dataclass(frozen=True, eq=False)
class Square:
    """The lots of a block by their rows among all; `name` is its path in OUT.

    origin_m: where its tiles count from.
    """

    name: str
    rows: NDArray[np.int64]
    origin_m: tuple[float, float, float]


@dataclass(frozen=True)
class Squares:
    """All squares of a call, and the lots that they are of.

    beside: which lots stand beside which, where the rules ask about them.
    """

    lots: Sequence[Lot]
    every: Sequence[Square]
    beside: Beside | None = None

    def block(self, square: Square) -> Block:
        """The block with its lots."""
        rows = square.rows.tolist()
        lots = tuple(self.lots[row] for row in rows)
        if self.beside is None:
            return Block(square.name, lots, square.origin_m)
        known = dict(zip(rows, lots, strict=True))
        near = {}
        for row, lot in known.items():
            others = self.beside[row]
            if others:
                near[lot.id] = tuple(known.get(other) or self.lots[other] for other in others)
        return Block(square.name, lots, square.origin_m, near)


def squares_of(lots: Sequence[Lot], *, ask_beside: bool, most: int = MOST_LOTS) -> Squares:
    """The lots in squares of `most` or fewer; with what stands beside them if rules ask."""
    if not lots:
        return Squares(lots, ())
    anchors = anchors_of(lots)
    size = min(max(FEW, -(-len(lots) // MOST_BLOCKS)), most)
    found = [
        Square(f"parts/{number:02d}", rows, block_origin(anchors[rows]))
        for number, rows in enumerate(squares(anchors[:, :2], size))
    ]
    return Squares(lots, found, neighbours_of(lots) if ask_beside else None)


def block_origin(anchors_m: NDArray[np.float64]) -> tuple[float, float, float]:
    """Where the tiles of some lots count from: a whole metre near their middle, on their ground."""
    low, high = anchors_m.min(axis=0), anchors_m.max(axis=0)
    x, y, _ = np.floor((low + high) / 2).tolist()
    return (x, y, float(np.floor(low[2])))


def told(block: Block) -> str:
    """The digest of all that is known of the lots of a block, and of those beside them."""
    lots = {lot.id: lot for near in block.beside.values() for lot in near}
    lots |= {lot.id: lot for lot in block.lots}
    own = [lot.id for lot in block.lots]
    beside = [[name, *(lot.id for lot in near)] for name, near in block.beside.items()]
    content = [block.name, own, beside, [_lot_told(lot) for lot in lots.values()]]
    return hashlib.sha256(json.dumps(content).encode()).hexdigest()


def _lot_told(lot: Lot) -> list[Any]:
    return [
        *(lot.id, lot.name, lot.anchor_m, lot.attributes),
        [ring.tolist() for ring in lot.rings_m],
        [edit.core for edit in lot.edits],
    ]
