"""Rules tried on one lot, as deriving takes them: faults that no file shows by itself."""

from __future__ import annotations

from collections.abc import Sequence

from veduta import _core
from veduta.grammar.block import NOTHING
from veduta.grammar.deriving import Deriver, attributes_of, with_files
from veduta.grammar.given import CALL_ONE, NO_START, check_options
from veduta.grammar.levels import FULL, levels_of
from veduta.grammar.lot import Lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.otherwise import otherwise
from veduta.grammar.rules import RuleFiles, begins_nothing, compile_rules
from veduta.grammar.textures import texture_faults
from veduta.run.errors import InputError

Told = tuple[str, ...]


def tried(
    rules: RuleFiles, options: GrammarOptions, lot: Lot, beside: Sequence[Lot] = ()
) -> tuple[Told, Told]:
    """Why nothing can be derived on the lot, and what is built otherwise than the rules say.

    rules: without faults. options: those of a call whose start rule takes no arguments, not yet
    checked. beside: the lots that stand beside it.
    """
    faults = texture_faults(text for _, text in rules.files)
    if faults:
        return tuple(faults), ()
    try:
        compiled = compile_rules(rules, options.derive.style, options.derive.start)
        if options.derive.start is None and begins_nothing(rules, compiled):
            # A library for others to import: nothing is wrong with it, and nothing begins.
            note = f"{NO_START}, so nothing was derived: its rules are checked alone. {CALL_ONE}"
            return (), (note, *otherwise(rules, compiled))
        options = check_options(compiled, rules.path, options)
    except InputError as error:
        return (str(error),), ()
    fault, missing = _derived(rules, compiled, options, lot, beside)
    told = tuple(dict.fromkeys([*otherwise(rules, compiled), *missing]))
    return (() if fault is None else (fault,)), told


def _derived(
    rules: RuleFiles,
    compiled: _core.GrammarRules,
    options: GrammarOptions,
    lot: Lot,
    beside: Sequence[Lot],
) -> tuple[str | None, list[str]]:
    """Why the lot gives no building, and what is missing of assets with computed names."""
    given = attributes_of(lot, dict(compiled.attributes), options)
    if isinstance(given, str):
        return f"{lot.name}: {given}", []
    library = with_files(compiled, rules.search)
    near = {lot.id: beside} if compiled.asks_beside else {}
    levels = levels_of(compiled, options.attributes.values)
    by = Deriver(compiled, library, levels, options, near)
    made = by.together([lot], FULL)
    fault = by.fault(made, 0, lot)
    if fault is None and made.extent(0) is None:
        fault = NOTHING
    missing = [f"{why} A box stands for it." for why in library.computed_missing(compiled)]
    return (None if fault is None else f"{fault} (tried on the lot {lot.name})"), missing
