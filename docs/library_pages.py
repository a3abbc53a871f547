"""The pages of the library, from its signatures and docstrings, and the table of formats."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

import veduta
from veduta.place.place import PlacedPart
from veduta.place.registry import formats

_CLASSES: tuple[tuple[type[Any], Sequence[str]], ...] = (
    (veduta.Place, ("add", "load", "save", "write", "merge", "bounds_m")),
    (veduta.Standing, ()),
    (veduta.ModelFile, ()),
    (PlacedPart, ("content", "triangles")),
    (veduta.Mesh, ("simple",)),
    (veduta.Part, ()),
    (veduta.Cloud, ()),
    (veduta.SemanticClass, ()),
    (veduta.Provenance, ()),
)
_RULES = ("parse", "derive", "rederive", "log_prior")


def functions_text() -> str:
    """The functions of `veduta`."""
    found = [getattr(veduta, name) for name in veduta.__all__ if name != "__version__"]
    functions = [one for one in found if inspect.isfunction(one)]
    return "\n".join(_function("veduta", one) for one in functions)


def rules_text() -> str:
    """The functions of `veduta.grammar`."""
    return "\n".join(_function("veduta.grammar", getattr(veduta.grammar, name)) for name in _RULES)


def classes_text() -> str:
    """The classes of `veduta`, with what one calls on them."""
    made = []
    for kind, names in _CLASSES:
        made.append(f"### {kind.__name__}\n\n{_prose(kind)}\n")
        rows = [_member(kind, name) for name in names]
        made.append("".join(f"- {row}\n" for row in rows))
    return "\n".join(part for part in made if part)


def formats_rows() -> list[tuple[str, str, str, str, str]]:
    """Ending, name, what it is, what it leaves out, whether it is read too."""
    return [
        (
            f"`{suffix}`",
            f"`{one.name}`",
            one.title,
            ", ".join(one.left_out),
            "yes" if one.read else "",
        )
        for suffix, one in formats().items()
    ]


def _function(module: str, function: Callable[..., Any]) -> str:
    head = f"### {module}.{function.__name__}"
    return f"{head}\n\n```python\n{_call(function)}\n```\n\n{_prose(function)}\n"


def _call(function: Callable[..., Any]) -> str:
    """The signature over as many lines as it has arguments, where one is too long."""
    told = inspect.signature(function)
    whole = f"{function.__name__}{told}".replace("'", "")
    if len(whole) <= 100:
        return whole
    inner = ",\n".join(f"    {one}".replace("'", "") for one in _parameters(told))
    return f"{function.__name__}(\n{inner},\n) -> {told.return_annotation}".replace("'", "")


def _parameters(told: inspect.Signature) -> list[str]:
    made, starred = [], False
    for one in told.parameters.values():
        if one.kind is one.KEYWORD_ONLY and not starred:
            made.append("*")
            starred = True
        made.append(str(one))
    return made


def _member(kind: type[Any], name: str) -> str:
    found = inspect.getattr_static(kind, name)
    if isinstance(found, property):
        return f"`{name}`: {_first(found)}"
    own = found.__func__ if isinstance(found, staticmethod) else found
    told = inspect.signature(own)
    kept = [one for one in told.parameters.values() if one.name != "self"]
    call = f"{name}({', '.join(str(one) for one in kept)})".replace("'", "")
    return f"`{call}`: {_first(own)}"


def _first(found: Any) -> str:
    """The first paragraph of a docstring, on one line."""
    return " ".join((inspect.getdoc(found) or "").split("\n\n")[0].split())


def _prose(found: Any) -> str:
    """A docstring as paragraphs, each on one line."""
    paragraphs = (inspect.getdoc(found) or "").split("\n\n")
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs)
