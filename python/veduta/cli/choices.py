"""Options that take one word of several, checked before the parser sees them, as numbers are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, get_args, get_origin, get_type_hints

from pydantic import BaseModel

from veduta.cli.numbers import plain, values_after
from veduta.run.errors import InputError
from veduta.run.options import declared_options, flag


def require_choices(call: type[Any], arguments: Sequence[str]) -> None:
    """InputError for the first option of `call` whose value is none of its words."""
    options = choice_options(call)
    for place, word in enumerate(arguments):
        name, equals, joined = word.partition("=")
        name = name.replace("_", "-")
        words = options.get(name)
        if words is None:
            continue
        given = [joined] if equals else values_after(arguments[place + 1 :])[:1]
        remedy = f"Give {', '.join(words[:-1])} or {words[-1]}."
        if not given:
            raise InputError(name, "its value is missing", remedy)
        if given[0] not in words:
            raise InputError(name, f'"{given[0]}" is not among its values', remedy)


def choice_options(call: type[Any]) -> Mapping[str, Sequence[str]]:
    """The words of each such option of a verb's arguments, and of the option models in them."""
    if issubclass(call, BaseModel):
        return _of_model(call)
    found: dict[str, Sequence[str]] = {}
    for name, annotation in get_type_hints(call, include_extras=True).items():
        kind = plain(annotation)
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            found |= _of_model(kind)
        elif get_origin(kind) is Literal:
            found[flag(name)] = [str(word) for word in get_args(kind)]
    return found


def _of_model(model: type[BaseModel]) -> dict[str, Sequence[str]]:
    return {
        option.flag: [str(word) for word in option.value["enum"]]
        for option in declared_options(model)
        if "enum" in option.value
    }
