"""`_core.pyi` is what the extension has: its names, and the parameters of what can be called."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path
from typing import Any

import pytest

from veduta import _core

Signature = list[tuple[str, str, object]]
"""Name, kind and default of each parameter."""
NO_DEFAULT = "required"
OF_A_CARD = {"GraphicsCard", "GpuFault"}
"""What only `make gpu` builds."""


@pytest.fixture(scope="module")
def stub(repository: Path) -> dict[str, ast.stmt]:
    tree = ast.parse((repository / "python/veduta/_core.pyi").read_text("utf-8"))
    found: dict[str, ast.stmt] = {}
    for statement in tree.body:
        if isinstance(statement, ast.FunctionDef | ast.ClassDef):
            found[statement.name] = statement
    if not hasattr(_core, "GraphicsCard"):
        found = {name: one for name, one in found.items() if name not in OF_A_CARD}
    return found


def public(names: Any) -> set[str]:
    return {name for name in names if not name.startswith("_")}


def typed(function: ast.FunctionDef) -> Signature:
    given = function.args
    every = [*given.posonlyargs, *given.args]
    blanks = [None] * (len(every) - len(given.defaults))
    pairs = zip(every, [*blanks, *given.defaults], strict=True)
    found = [(arg.arg, "plain", value(default)) for arg, default in pairs]
    named = zip(given.kwonlyargs, given.kw_defaults, strict=True)
    found += [(arg.arg, "named", value(default)) for arg, default in named]
    return [row for row in found if row[0] not in ("self", "cls")]


def value(default: ast.expr | None) -> object:
    return NO_DEFAULT if default is None else ast.literal_eval(default)


def built(function: Any) -> Signature:
    found = []
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name in ("self", "cls"):
            continue
        kind = "named" if parameter.kind is inspect.Parameter.KEYWORD_ONLY else "plain"
        default = parameter.default
        empty = default is inspect.Parameter.empty
        found.append((parameter.name, kind, NO_DEFAULT if empty else default))
    return found


def test_the_same_names(stub: dict[str, ast.stmt]) -> None:
    assert public(stub) == public(vars(_core))


def test_functions_take_the_same(stub: dict[str, ast.stmt]) -> None:
    functions = {name: s for name, s in stub.items() if isinstance(s, ast.FunctionDef)}
    assert functions
    for name, statement in functions.items():
        assert (name, typed(statement)) == (name, built(getattr(_core, name)))


def test_classes_have_the_same(stub: dict[str, ast.stmt]) -> None:
    classes = {name: s for name, s in stub.items() if isinstance(s, ast.ClassDef)}
    assert classes
    for name, statement in classes.items():
        real = getattr(_core, name)
        if issubclass(real, Exception):
            bases = [base.id for base in statement.bases if isinstance(base, ast.Name)]
            assert (name, bases) == (name, [base.__name__ for base in real.__bases__])
            continue
        methods = {s.name: s for s in statement.body if isinstance(s, ast.FunctionDef)}
        columns = {
            s.target.id
            for s in statement.body
            if isinstance(s, ast.AnnAssign) and isinstance(s.target, ast.Name)
        }
        assert (name, public([*methods, *columns])) == (name, public(vars(real)))
        for method, told in methods.items():
            if method == "__new__":
                assert (name, typed(told)) == (name, built(real))
            elif callable(getattr(real, method)):
                own = (name, method)
                assert (own, typed(told)) == (own, built(getattr(real, method)))
