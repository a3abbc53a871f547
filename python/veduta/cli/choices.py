"""Options that take one word of several, checked before the parser sees them, as numbers are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, get_args, get_origin

from veduta.cli.words import given_to, options_of
from veduta.run.errors import InputError


def require_choices(call: type[Any], arguments: Sequence[str]) -> None:
    """InputError for the first option of `call` whose value is none of its words."""
    options = choice_options(call)
    for name, given in given_to(options, arguments):
        words = options[name]
        remedy = f"Give {', '.join(words[:-1])} or {words[-1]}."
        if not given:
            raise InputError(name, "its value is missing", remedy)
        if given[0] not in words:
            raise InputError(name, f'"{given[0]}" is not among its values', remedy)


def choice_options(call: type[Any]) -> Mapping[str, Sequence[str]]:
    """The words of each such option of a verb's arguments, and of the option models in them."""
    declared, others = options_of(call)
    found = {
        option.flag: [str(word) for word in option.value["enum"]]
        for option in declared
        if "enum" in option.value
    }
    for name, kind in others.items():
        if get_origin(kind) is Literal:
            found[name] = [str(word) for word in get_args(kind)]
    return found
