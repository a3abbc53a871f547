"""A building lot, and many of them of which only few are in memory."""

from __future__ import annotations

import itertools
from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import overload

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.edits import Edit
from veduta.grammar.outline import Attribute
from veduta.grammar.spool import Record, Spool


@dataclass(frozen=True)
class Lot:
    """A building lot.

    rings_m: (n, 2) each, about `anchor_m`; the outline first, counter-clockwise seen from above,
    its first edge along the street; holes run clockwise. anchor_m: x, y, z from the origin of all
    lots. attributes: what the file says of it. edits: what is otherwise at single shapes.
    """

    id: str
    name: str
    rings_m: tuple[NDArray[np.float64], ...]
    anchor_m: tuple[float, float, float]
    attributes: dict[str, Attribute] = field(default_factory=dict)
    edits: tuple[Edit, ...] = ()


class SpooledLots(Sequence[Lot]):
    """Lots on the disk, by their row; what is asked of all of them at once is in memory.

    anchors_m: (n, 3) of the lots. boxes_m: (n, 4) their outlines' lowest x and y and highest x and
    y, from the origin of all lots.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._spool = Spool(folder)
        self._anchors = array("d")
        self._boxes = array("d")
        self._edits: Mapping[str, tuple[Edit, ...]] = {}

    def append(self, lot: Lot) -> None:
        """Add a lot without edits; not after one was read."""
        x, y, _ = lot.anchor_m
        east, north = lot.rings_m[0].T.tolist()
        self._spool.append(_record(lot))
        self._anchors.extend(lot.anchor_m)
        self._boxes.extend((min(east) + x, min(north) + y, max(east) + x, max(north) + y))

    def lift(self, from_m: float, to_m: float) -> None:
        """Have heights that counted from one height count from another."""
        self.anchors_m[:, 2] = self.anchors_m[:, 2] + from_m - to_m

    def flush(self) -> None:
        """Have all lots where they are read from; OSError where there is no room."""
        self._spool.flush()

    def edit(self, edits: Mapping[str, tuple[Edit, ...]]) -> None:
        """Give lots edits, by their id."""
        self._edits = edits

    @property
    def anchors_m(self) -> NDArray[np.float64]:
        """(n, 3)."""
        return np.frombuffer(self._anchors).reshape(-1, 3)

    @property
    def boxes_m(self) -> NDArray[np.float64]:
        """(n, 4)."""
        return np.frombuffer(self._boxes).reshape(-1, 4)

    def __len__(self) -> int:
        return len(self._spool)

    @overload
    def __getitem__(self, row: int) -> Lot: ...
    @overload
    def __getitem__(self, row: slice) -> tuple[Lot, ...]: ...
    def __getitem__(self, row: int | slice) -> Lot | tuple[Lot, ...]:
        if isinstance(row, slice):
            return tuple(self[one] for one in range(*row.indices(len(self))))
        if not -len(self) <= row < len(self):
            raise IndexError(row)
        return self._lot(row % len(self), self._spool[row % len(self)])

    def __iter__(self) -> Iterator[Lot]:
        return itertools.starmap(self._lot, enumerate(self._spool))

    def ids(self) -> Iterator[str]:
        """The ids in the order of the lots."""
        return (record[0] for record in self._spool)

    def close(self) -> None:
        """Give the room on the disk back; no lot can be read any more."""
        self._spool.close()

    def _lot(self, row: int, record: Record) -> Lot:
        lot_id, name, attributes, rings = record
        x, y, z = self._anchors[3 * row : 3 * row + 3]
        edits = self._edits.get(lot_id, ())
        return Lot(lot_id, name, rings_of_bytes(rings, 2), (x, y, z), attributes, edits)


def anchors_of(lots: Sequence[Lot]) -> NDArray[np.float64]:
    """(n, 3) where the lots lie, from the origin of all."""
    if isinstance(lots, SpooledLots):
        return lots.anchors_m
    return np.array([lot.anchor_m for lot in lots], dtype=np.float64).reshape(-1, 3)


def boxes_of(lots: Sequence[Lot]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower and upper corners (n, 2) of the outlines."""
    if isinstance(lots, SpooledLots):
        return lots.boxes_m[:, :2], lots.boxes_m[:, 2:]
    anchors = anchors_of(lots)[:, :2]
    low = np.array([lot.rings_m[0].min(axis=0) for lot in lots]) + anchors
    high = np.array([lot.rings_m[0].max(axis=0) for lot in lots]) + anchors
    return low, high


def ids_of(lots: Sequence[Lot]) -> Iterator[str]:
    """The ids in the order of the lots."""
    return lots.ids() if isinstance(lots, SpooledLots) else (lot.id for lot in lots)


def edited(lots: Sequence[Lot], edits: Mapping[str, tuple[Edit, ...]]) -> Sequence[Lot]:
    """The lots with their edits, by the lots' ids."""
    if isinstance(lots, SpooledLots):
        lots.edit(edits)
        return lots
    return tuple(replace(lot, edits=edits.get(lot.id, ())) for lot in lots)


def bytes_of_rings(rings: Sequence[NDArray[np.float64]]) -> tuple[bytes, ...]:
    """Rings of (n, d) as a spool keeps them."""
    return tuple(ring.tobytes() for ring in rings)


def rings_of_bytes(rings: Sequence[bytes], dimensions: int) -> tuple[NDArray[np.float64], ...]:
    """Rings of (n, dimensions) from a spool; they cannot be written to."""
    return tuple(np.frombuffer(ring).reshape(-1, dimensions) for ring in rings)


def _record(lot: Lot) -> Record:
    return (lot.id, lot.name, lot.attributes, bytes_of_rings(lot.rings_m))
