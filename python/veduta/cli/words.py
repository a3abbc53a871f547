"""The words of a command line: which options a verb takes, and what is given to them."""

from __future__ import annotations

import math
import re
import types
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from pydantic import BaseModel

from veduta.run.options import DeclaredOption, declared_options, flag


def options_of(call: type[Any]) -> tuple[list[DeclaredOption], Mapping[str, Any]]:
    """The options of the models in a verb's arguments, and the types of its others by flag."""
    declared = [option for model in models_of(call) for option in declared_options(model)]
    if issubclass(call, BaseModel):
        return declared, {}
    kinds = {name: _plain(kind) for name, kind in get_type_hints(call, include_extras=True).items()}
    others = {flag(name): kind for name, kind in kinds.items() if not _is_model(kind)}
    return declared, others


def models_of(call: type[Any]) -> list[type[BaseModel]]:
    """The models of options in a verb's arguments, or the verb's arguments themselves."""
    if issubclass(call, BaseModel):
        return [call]
    kinds = [_plain(kind) for kind in get_type_hints(call, include_extras=True).values()]
    return [kind for kind in kinds if _is_model(kind)]


def _is_model(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, BaseModel)


def given_to(flags: Collection[str], arguments: Sequence[str]) -> Iterator[tuple[str, list[str]]]:
    """Each of the options that is given, with the words up to the next option."""
    for place, word in enumerate(arguments):
        name, equals, joined = word.partition("=")
        name = name.replace("_", "-")
        if name in flags:
            yield name, [joined] if equals else _values_after(arguments[place + 1 :])


def number_of(word: str, *, whole: bool) -> float | None:
    """The number that the parser would read, None where it is none or not finite."""
    if "_" in word:  # Python reads 1_9 as 19; who types it means something else
        return None
    try:
        value = int(word) if whole else float(word)
        return value if math.isfinite(value) else None
    except (ValueError, OverflowError):
        return None


def _plain(annotation: Any) -> Any:
    """The type without annotations, and without the None of an option that need not be given."""
    kind = get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation
    if get_origin(kind) not in (Union, types.UnionType):
        return kind
    kinds = [_plain(part) for part in get_args(kind) if part is not type(None)]
    return kinds[0] if len(kinds) == 1 else kind


def _values_after(words: Sequence[str]) -> list[str]:
    """The words up to the next option; a negative number is a value."""
    found = []
    for word in words:
        if re.match(r"-[^\d.]", word) and number_of(word, whole=False) is None:
            break
        found.append(word)
    return found
