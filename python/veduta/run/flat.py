"""Options by their plain names, as on the command line: groups need not be written out."""

from __future__ import annotations

import difflib
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from veduta.run.errors import InputError
from veduta.run.options import Options

O = TypeVar("O", bound=Options)  # noqa: E741  an Options


def options_of(model: type[O], given: dict[str, Any]) -> O:
    """The options of a verb with some of them given, wherever in its groups they are.

    InputError where there is no such option, or it may not have this value.
    """
    places: dict[str, tuple[str, ...]] = {}
    _places(model, (), places)
    told: dict[str, Any] = {}
    for name, value in given.items():
        if name not in places:
            near = difflib.get_close_matches(name, places, n=1)
            hint = f"Did you mean {near[0]}?" if near else f"There are: {', '.join(places)}."
            raise InputError(name, "is no option of this verb", hint)
        into = told
        for group in places[name]:
            into = into.setdefault(group, {})
        into[name] = value
    try:
        return model.model_validate(told)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        field = str(first["loc"][-1]) if first["loc"] else "the options"
        raise InputError(field, str(first["msg"]), "Give another value.") from error


def _places(
    model: type[BaseModel], path: tuple[str, ...], found: dict[str, tuple[str, ...]]
) -> None:
    """The groups in which each option is; the first of two of one name counts."""
    for name, field in model.model_fields.items():
        kind = field.annotation
        if isinstance(kind, type) and issubclass(kind, Options):
            _places(kind, (*path, name), found)
        else:
            found.setdefault(name, path)
