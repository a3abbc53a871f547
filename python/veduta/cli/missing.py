"""What a verb cannot do without, asked for before the parser, which would draw a box."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, get_args, get_type_hints

import tyro

from veduta.cli.words import given_to
from veduta.run.errors import InputError
from veduta.run.options import flag

_POSITIONAL = get_args(tyro.conf.Positional[str])[1]


def require_given(call: type[Any], arguments: Sequence[str], prog: str) -> None:
    """InputError for the first argument of `call` that is needed and not given.

    A positional one is missing for sure where nothing but options is given.
    """
    if not dataclasses.is_dataclass(call):
        return
    hints = get_type_hints(call, include_extras=True)
    for field in dataclasses.fields(call):
        if not (field.default is field.default_factory is dataclasses.MISSING):
            continue
        if not hasattr(hints[field.name], "__metadata__"):
            continue
        marks = hints[field.name].__metadata__
        told = next((one for one in marks if getattr(one, "help", None)), None)
        if told is None:
            continue
        if _POSITIONAL in marks:
            given = any(not word.startswith("-") for word in arguments) or "--" in arguments
            name = str(told.metavar)
        else:
            flags = [flag(field.name), *(told.aliases or ())]
            given = any(True for _ in given_to(flags, arguments))
            name = f"{flags[-1]} {told.metavar or ''}".strip()
        if not given:
            what = str(told.help).partition(";")[0]
            remedy = f"Give it; `{prog} --help` explains all options."
            raise InputError(name, f"was not given ({what})", remedy)
