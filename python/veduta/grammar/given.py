"""What a call says beside the rules and the lots: attributes and the start rule, checked."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from pathlib import Path

from veduta import _core
from veduta.grammar.deriving import as_kind
from veduta.grammar.options import AttributeOptions, GrammarOptions
from veduta.grammar.outline import Attribute
from veduta.run.errors import InputError


def read_attributes(words: Sequence[str]) -> AttributeOptions:
    """`NAME=VALUE` as a text each; what they are is settled when the rules are known."""
    values: dict[str, Attribute] = {}
    for word in words:
        name, equals, value = word.partition("=")
        name = name.strip()
        if not equals or not name:
            raise InputError(f"--attr {word}", "is not NAME=VALUE", "Write --attr height=12.")
        if name in values:
            raise InputError(f"--attr {name}", "is given twice", "Give it once.")
        values[name] = value
    return AttributeOptions(values=values)


def check_options(rules: _core.GrammarRules, path: Path, options: GrammarOptions) -> GrammarOptions:
    """The options with attributes as the rules take them; InputError for what they do not have."""
    kinds = dict(rules.attributes)
    values: dict[str, Attribute] = {}
    for name, text in options.attributes.values.items():
        if name not in kinds:
            raise InputError(
                f"--attr {name}", f"is no attribute of {path.name}", _near(name, list(kinds))
            )
        kind = kinds[name] or _guess(text)
        value = as_kind(text, kind)
        if value is None:
            raise InputError(
                f"--attr {name}", f"is a {_named(kind)}, not {text!r}", _example(name, kind)
            )
        values[name] = value
    _check_start(rules, path, options.derive.start)
    return options.model_copy(update={"attributes": AttributeOptions(values=values)})


NO_START = "has no rule that starts without arguments"
CALL_ONE = 'Say its first rule\'s arguments, as --start "Lot(9)".'


def _check_start(rules: _core.GrammarRules, path: Path, start: str | None) -> None:
    starts = rules.starts
    if not starts:
        raise InputError(path, NO_START, CALL_ONE)
    if start is not None and start not in starts:
        fault = f"is no rule of {path.name} that can start without arguments"
        hint = f'{_near(start, starts)} One that takes arguments: --start "{start}(9)".'
        raise InputError(f"--start {start}", fault, hint)


def _guess(text: Attribute) -> str:
    """What a value is for an attribute whose own does not say it."""
    if not isinstance(text, str) or text.lower() in ("true", "false"):
        return "bool"
    return "text" if as_kind(text, "number") is None else "number"


def _near(name: str, known: list[str]) -> str:
    if not known:
        return "It has none."
    near = difflib.get_close_matches(name, known, n=1)
    return f"Did you mean `{near[0]}`?" if near else f"It has: {', '.join(known[:12])}."


def _named(kind: str) -> str:
    return {"bool": "truth value", "number": "number"}.get(kind, kind)


def _example(name: str, kind: str) -> str:
    value = {"bool": "true or false", "number": "a number, as 12.5"}.get(kind, "a text")
    return f"Give {value}."
