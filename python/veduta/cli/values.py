"""Values that the models of options refuse by rules of their own, checked before the parser.

The parser would show pydantic's message with its types; what the rule says is enough.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import BaseModel, ValidationError

from veduta.cli.words import given_to, models_of, number_of
from veduta.run.errors import InputError
from veduta.run.options import DeclaredOption, declared_options


def require_values(call: type[Any], arguments: Sequence[str]) -> None:
    """InputError for the first option of `call` whose value breaks a rule of its model."""
    for model in models_of(call):
        options = {option.flag: option for option in declared_options(model)}
        for flag, words in given_to(options, arguments):
            if words:
                _require(model, options[flag], words)


def _require(model: type[BaseModel], option: DeclaredOption, words: Sequence[str]) -> None:
    fault = _fault(model, {option.name: _value(option, words)})
    if fault is not None:
        raise InputError(option.flag, fault, f"It is {option.description}.")


def _value(option: DeclaredOption, words: Sequence[str]) -> Any:
    """As the parser would read it: several numbers, or a word."""
    count = option.value.get("minItems", 1) if option.value.get("type") == "array" else 0
    if not count:
        return words[0]
    return tuple(number_of(word, whole=False) for word in words[:count])


def _fault(model: type[BaseModel], values: Mapping[str, Any]) -> str | None:
    """What a rule of the model says of a value; None where it keeps all of them."""
    try:
        model.model_validate(values)
    except ValidationError as error:
        for one in error.errors():
            # Other options may be needed, and ranges are `numbers`' to tell.
            if one["type"] == "value_error" and one["loc"][:1] == tuple(values):
                return str(one.get("ctx", {}).get("error", one["msg"]))
    return None
