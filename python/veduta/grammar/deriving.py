"""Lots handed to the engine: with their attributes, seeds and edits, and the assets they want."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from veduta import _core
from veduta.grammar.assets.library import Library
from veduta.grammar.edge_values import EdgeList, edge_lists
from veduta.grammar.edits import fault_told
from veduta.grammar.levels import FULL, Levels, levels_of
from veduta.grammar.lot import Lot
from veduta.grammar.lot_names import measured, property_of
from veduta.grammar.on_earth import OnEarth
from veduta.grammar.options import GrammarOptions
from veduta.grammar.outline import Attribute
from veduta.grammar.project import SearchPath
from veduta.grammar.project_files import project_files

Vector = tuple[float, float, float]
Given = dict[str, Attribute | EdgeList]
Made = TypeVar("Made", _core.DerivedLots, _core.Surroundings)


@dataclass(frozen=True)
class Deriver:
    """Compiled rules with their assets, and how they are to be derived.

    beside: the lots that stand beside each, by its id, where the rules ask about them. earth: where
    the lots lie, where the rules ask that.
    """

    rules: _core.GrammarRules
    library: Library
    levels: Levels
    options: GrammarOptions
    beside: Mapping[str, Sequence[Lot]] = field(default_factory=dict)
    earth: OnEarth | None = None

    def together(self, lots: Sequence[Lot], level: float) -> _core.DerivedLots:
        """The lots at a level of detail, on the engine's side.

        They are derived again where one wants an asset whose name only the derivation shows. What
        stands beside them is there at the same level.
        """
        around, rows = self.surroundings(lots, level)
        return self._complete(
            lambda: _core.derive_lots(
                self.rules,
                [rings_of(lot) for lot in lots],
                self._seeds(lots),
                start=self.options.derive.start,
                attributes=self._given(lots, level),
                edits=[[edit.core for edit in lot.edits] for lot in lots],
                around=around,
                beside=rows,
                limits=self.options.limits.core,
            )
        )

    def surroundings(
        self, lots: Sequence[Lot], level: float
    ) -> tuple[_core.Surroundings | None, list[list[tuple[int, Vector]]] | None]:
        """What stands beside lots: all of it, and per lot the rows there with their offsets (m).

        A lot puts the same in the way of all others, whatever lots it is derived with.
        """
        if not any(self.beside.get(lot.id) for lot in lots):
            return None, None
        kinds = dict(self.rules.attributes)
        seen = {one.id: one for lot in lots for one in self.beside.get(lot.id, ())}
        sound = [
            one
            for one in seen.values()
            if not isinstance(attributes_of(one, kinds, self.options), str)
        ]
        row_of = {one.id: row for row, one in enumerate(sound)}
        rows = [
            [
                (row_of[one.id], _between(lot, one))
                for one in self.beside.get(lot.id, ())
                if one.id in row_of
            ]
            for lot in lots
        ]
        around = self._complete(
            lambda: _core.derive_surroundings(
                self.rules,
                [rings_of(lot) for lot in sound],
                self._seeds(sound),
                start=self.options.derive.start,
                attributes=self._given(sound, level),
                edits=[[edit.core for edit in lot.edits] for lot in sound],
                limits=self.options.limits.core,
            )
        )
        return around, rows

    def fault(self, derived: _core.DerivedLots, row: int, lot: Lot) -> str | None:
        """Why a lot gives no building; None where it may."""
        told = derived.fault(row)
        if told is None:
            return fault_told(lot.edits, derived.edit_faults(row))
        return told

    def _complete(self, make: Callable[[], Made]) -> Made:
        """What `make` gives, again where lots want assets whose names only the derivation shows."""
        while True:
            made = make()
            if not self._add_missing(made):
                return made

    def _add_missing(self, made: _core.DerivedLots | _core.Surroundings) -> bool:
        """Make the assets known that are wanted; whether there is a new one."""
        wanted = {made.missing_asset(row) for row in range(len(made))}
        names = {name for name in wanted if name is not None}
        for name in sorted(names):
            self.library.add_to(self.rules, name)
        return bool(names)

    def _seeds(self, lots: Sequence[Lot]) -> list[int]:
        return [seed_of(lot, self.options.derive.seed) for lot in lots]

    def _given(self, lots: Sequence[Lot], level: float) -> list[Given]:
        """The attributes of lots that have sound ones, and what is known besides of each.

        Edits name shapes of the tree with all that there is: lots with edits have that level only.
        """
        kinds = dict(self.rules.attributes)
        found: list[Given] = []
        for lot in lots:
            given = attributes_of(lot, kinds, self.options)
            if not isinstance(given, str):
                own = self.levels.given(given, FULL if lot.edits else level)
                found.append({**own, **known_besides(lot, self.earth)})
        return found


@functools.lru_cache(maxsize=1)
def _compiled(
    files: tuple[tuple[str, str], ...], style: str | None, start: str | None, search: SearchPath
) -> tuple[_core.GrammarRules, Library]:
    """Compiled once in each process, with the assets and files that the rules name."""
    rules = _core.GrammarRules(list(files), style, start)
    return rules, with_files(rules, search)


def with_files(rules: _core.GrammarRules, search: SearchPath) -> Library:
    """Give the rules the assets and files that they name; the library has those found later."""
    library = Library(search)
    library.add_written_to(rules)
    project_files(search, rules).add_to(rules)
    return library


def deriver(
    files: tuple[tuple[str, str], ...],
    search: SearchPath,
    options: GrammarOptions,
    beside: Mapping[str, Sequence[Lot]] | None = None,
    earth: OnEarth | None = None,
) -> Deriver:
    """What derives by these files; `search` says where what they name lies.

    beside: the lots that stand beside each, by its id, where the rules ask about them. earth: where
    they lie, where the rules ask that.
    """
    rules, library = _compiled(files, options.derive.style, options.derive.start, search)
    levels = levels_of(rules, options.attributes.values)
    return Deriver(rules, library, levels, options, beside or {}, earth)


def known_besides(lot: Lot, earth: OnEarth | None = None) -> dict[str, EdgeList]:
    """What the engine is given of a lot besides: attributes of edges, and where it is."""
    found: dict[str, EdgeList] = {**edge_lists(lot.attributes)}
    return found if earth is None else {**found, **earth.about(lot)}


def attributes_of(
    lot: Lot, kinds: dict[str, str], options: GrammarOptions
) -> dict[str, Attribute] | str:
    """The attributes that the rules have: of the call before those of the lot; or the fault."""
    found: dict[str, Attribute] = {}
    for name in kinds:
        value = property_of(name, lot.attributes, options.names.values)
        if value is None or name in options.attributes.values:
            continue
        taken = as_kind(value, kinds[name])
        if taken is None:
            return f"its property {name} is {value!r}, but the rules want a {kinds[name]}"
        found[name] = taken
    return found | options.attributes.values


def as_kind(value: Attribute, kind: str) -> Attribute | None:
    """The value as an attribute of this kind takes it; None where it cannot."""
    if kind == "number" and isinstance(value, str):
        try:
            number = float(value)
        except ValueError:
            return measured(value)
        return number if abs(number) < 1e300 else None
    if kind == "number":
        return None if isinstance(value, bool) else value
    if kind == "bool":
        words: dict[Attribute, bool] = {"true": True, "false": False, True: True, False: False}
        return words.get(value.lower() if isinstance(value, str) else value)
    if kind == "text" and not isinstance(value, str):
        return f"{value:g}" if isinstance(value, float) else str(value).lower()
    return value


def seed_of(lot: Lot, seed: int) -> int:
    """What is random in a lot depends on its name and the seed, and on no other lot."""
    digest = hashlib.sha256(f"{seed}/{lot.id}".encode()).digest()
    return int.from_bytes(digest[:8], "little")


def rings_of(lot: Lot) -> list[list[tuple[float, float, float]]]:
    """The rings as the engine takes them (m)."""
    return [[(x, y, 0.0) for x, y in ring.tolist()] for ring in lot.rings_m]


def _between(lot: Lot, other: Lot) -> Vector:
    """How far the frame of another lot lies from a lot's own (m)."""
    (x, y, z), (to_x, to_y, to_z) = lot.anchor_m, other.anchor_m
    return (to_x - x, to_y - y, to_z - z)
