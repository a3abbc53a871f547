"""Reading a verb's arguments with tyro: flat names, and help that a person can read."""

from __future__ import annotations

import inspect
import os
import types
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import tyro

from veduta.cli.choices import require_choices
from veduta.cli.missing import require_given
from veduta.cli.numbers import require_numbers
from veduta.cli.values import require_values
from veduta.run.options import Options

T = TypeVar("T")
_METAVARS = {int: "INT", float: "FLOAT", str: "STR", Path: "PATH"}

os.environ.setdefault("PYDANTIC_ERRORS_INCLUDE_URL", "0")  # a wrong number needs no manual


def parse(
    call: type[T],
    prog: str,
    arguments: list[str],
    *,
    description: str = "",
    config: Sequence[Any] = (tyro.conf.OmitArgPrefixes, tyro.conf.FlagCreatePairsOff),
) -> T:
    """The arguments as a `call`; bad use exits with 2 and a hint.

    description: stands at the top of the help, in place of the call's docstring.
    """
    if not {"-h", "--help"} & set(arguments):
        require_given(call, arguments, prog)
        require_numbers(call, arguments)
        require_choices(call, arguments)
        require_values(call, arguments)
    registry = tyro.constructors.ConstructorRegistry()
    registry.primitive_rule(_optional)
    registry.struct_rule(_model)
    with registry:
        return tyro.cli(
            call,
            args=arguments,
            prog=prog,
            description=description or inspect.cleandoc(call.__doc__ or ""),
            config=config,
        )


def _model(
    info: tyro.constructors.StructTypeInfo,
) -> tyro.constructors.StructConstructorSpec | None:
    """The fields of an options model; what is on by itself says with which word it is off."""
    if not (isinstance(info.type, type) and issubclass(info.type, Options)):
        return None
    hints = get_type_hints(info.type, include_extras=True)
    fields = []
    for name, known in info.type.model_fields.items():
        kind, given = hints[name], getattr(info.default, name, None)
        default = known.get_default(call_default_factory=True) if given is None else given
        if kind is bool and default is True:
            hint = f"(on unless --no-{name.replace('_', '-')})"
            kind = Annotated[bool, tyro.conf.arg(help_behavior_hint=hint)]
        missing = known.is_required() and given is None
        fields.append(
            tyro.constructors.StructFieldSpec(
                name=name,
                type=kind,
                default=tyro.MISSING if missing else default,
                helptext=known.description,
            )
        )
    return tyro.constructors.StructConstructorSpec(instantiate=info.type, fields=tuple(fields))


def _bare(kind: Any) -> Any:
    """The type without its annotations; pydantic checks those."""
    return get_args(kind)[0] if get_origin(kind) is Annotated else kind


def _one_of(words: tuple[Any, ...]) -> tyro.constructors.PrimitiveConstructorSpec[Any] | None:
    """One of some words, or nothing where none is given."""
    if not all(isinstance(word, str) for word in words):
        return None
    return tyro.constructors.PrimitiveConstructorSpec(
        nargs=1,
        metavar="{" + ",".join(words) + "}",
        instance_from_str=lambda given: given[0],
        is_instance=lambda value: value is None or value in words,
        str_from_instance=lambda value: ["none" if value is None else str(value)],
        choices=words,
    )


def _optional(
    info: tyro.constructors.PrimitiveTypeInfo,
) -> tyro.constructors.PrimitiveConstructorSpec[Any] | None:
    """An option that need not be given shows what it takes, and not that it takes None."""
    if get_origin(info.type) not in (Union, types.UnionType):
        return None
    kinds = [_bare(kind) for kind in get_args(info.type) if kind is not type(None)]
    if len(kinds) != 1:
        return None
    if get_origin(kinds[0]) is Literal:
        return _one_of(get_args(kinds[0]))
    several = get_origin(kinds[0]) is tuple
    parts = get_args(kinds[0]) if several else kinds
    if not all(part in _METAVARS for part in parts):
        return None

    def read(words: list[str]) -> Any:
        values = [part(word) for part, word in zip(parts, words, strict=True)]
        return tuple(values) if several else values[0]

    return tyro.constructors.PrimitiveConstructorSpec(
        nargs=len(parts),
        metavar=" ".join(_METAVARS[part] for part in parts),
        instance_from_str=read,
        is_instance=lambda value: value is None or isinstance(value, (*_METAVARS, tuple)),
        str_from_instance=lambda value: (
            ["none"] if value is None else [str(part) for part in (value if several else [value])]
        ),
    )
