"""Values of expressions, tried in a rule file of their own."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from veduta.grammar.deriving import deriver
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.rules import check_rules, read_rules


def values_of(definitions: str, expressions: Sequence[str], folder: Path) -> list[str | None]:
    """The values as text, in order; None where a rule file with that expression does not derive."""
    found = _together(definitions, expressions, folder)
    if found is not None or len(expressions) == 1:
        return list(found) if found is not None else [None]
    return [value for one in expressions for value in values_of(definitions, [one], folder)]


def _together(
    definitions: str, expressions: Sequence[str], folder: Path
) -> Sequence[str | None] | None:
    said = " ".join(f'report("{at}", "" + ({one}))' for at, one in enumerate(expressions))
    path = folder / "values.cga"
    path.write_text(f"{definitions}\n@StartRule\nLot --> {said}\n")
    rules = read_rules(path)
    if check_rules(rules).errors:
        return None
    made = deriver(rules.files, rules.search, GrammarOptions())
    lot = plain_lot(20, 30)
    built = made.together([lot], 2.0)
    if made.fault(built, 0, lot) is not None:
        return None
    reported = {key: str(value) for key, value in built.reports(0)}
    return [reported.get(str(at)) for at in range(len(expressions))]
