"""The one lot that `sample` and `tree` look at: named in a file of lots, or a plain rectangle."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from veduta.grammar.demo import DEMO_LOTS, demo_lots
from veduta.grammar.derivation import Derivation, Rules, derive
from veduta.grammar.deriving import Deriver, attributes_of, known_besides, seed_of
from veduta.grammar.edits import Edit, fault_told
from veduta.grammar.levels import FULL, Levels
from veduta.grammar.lot import Lot
from veduta.grammar.lots import near_id, read_lots, require_lots
from veduta.grammar.neighbours import neighbours_of
from veduta.grammar.options import GrammarOptions, LotOptions
from veduta.run.errors import InputError

WIDTH_M, DEPTH_M = 14.0, 12.0
PLAIN_ID = "lot"


def plain_lot(width_m: float = WIDTH_M, depth_m: float = DEPTH_M) -> Lot:
    """A rectangle with its first edge, the front, along x."""
    corners = [[0.0, 0.0], [width_m, 0.0], [width_m, depth_m], [0.0, depth_m]]
    return Lot(PLAIN_ID, f"{width_m:g} x {depth_m:g} m", (np.array(corners),), (0.0, 0.0, 0.0))


def find_lot(
    path: Path | None, lot_id: str | None, options: LotOptions | None = None, seed: int = 0
) -> tuple[Lot, tuple[Lot, ...]]:
    """The lot of this id, or the first of the file; and those that stand beside it.

    Where there is no file: the lot of this id in the synthetic street of `derive` with this seed,
    or the plain one.
    """
    require_lots(path, options)
    if path is None and lot_id in (None, PLAIN_ID):
        return plain_lot(), ()
    named = "the synthetic street" if path is None else str(path)
    found = demo_lots(DEMO_LOTS, seed) if path is None else read_lots(path, options)
    with contextlib.closing(found):
        lots = found.lots
        row = 0 if lot_id is None else _row_of(lot_id, lots)
        if row is None:
            hint = near_id(str(lot_id), lots, "It has")
            raise InputError(f"--lot {lot_id}", f"is no lot of {named}", hint)
        return lots[row], tuple(lots[other] for other in neighbours_of(lots)[row])


def _row_of(lot_id: str, lots: Sequence[Lot]) -> int | None:
    """The first lot of this id or name."""
    return next((row for row, lot in enumerate(lots) if lot_id in (lot.id, lot.name)), None)


def derive_lot(
    rules: Rules,
    lot: Lot,
    options: GrammarOptions,
    seed: int,
    edits: tuple[Edit, ...] = (),
    beside: tuple[Lot, ...] = (),
) -> Derivation:
    """The building that `veduta grammar derive` makes of this lot with this seed.

    beside: the lots that stand beside it.
    """
    given = attributes_of(lot, rules.attributes, options)
    if isinstance(given, str):
        raise InputError(lot.name, given, "Correct it, or set it with --attr.")
    options = options.with_seed(seed)
    near = {lot.id: beside} if rules.core.asks_beside else {}
    by = Deriver(rules.core, rules.library, Levels(marked=False), options, near)
    around, rows = by.surroundings([lot], FULL)
    made = derive(
        rules,
        lot.rings_m,
        seed=seed_of(lot, seed),
        start=options.derive.start,
        attributes=given,
        edits=edits,
        surroundings=(around, rows[0]) if around and rows else None,
        besides=known_besides(lot),
        limits=options.limits,
    )
    fault = fault_told(edits, made.edit_faults)
    if fault is not None:
        raise InputError(lot.name, fault, "The others are done.")
    return made
