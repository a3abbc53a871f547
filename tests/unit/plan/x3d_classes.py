"""A scene of X3D made again by the typed classes of the x3d package, which check each field."""

from __future__ import annotations

import contextlib
import io
from collections import Counter
from typing import Any
from xml.etree import ElementTree

import pytest

with contextlib.redirect_stdout(io.StringIO()):  # it greets whoever imports it
    x3d: Any = pytest.importorskip("x3d.x3d")
X3DTypeError = x3d.X3DTypeError

_WIDTH = {"2": 2, "3": 3, "4": 4}
_PLAIN = {"Float": float, "Double": float, "Time": float, "Int32": int}


def typed_scene(content: bytes) -> Counter[str]:
    """How many nodes of each kind were made; raises what the classes raise on what is wrong."""
    made: Counter[str] = Counter()
    _made(ElementTree.fromstring(content), made)
    return made


def _made(element: ElementTree.Element, made: Counter[str]) -> Any:
    kind = getattr(x3d, element.tag)
    types = {
        field[0].rstrip("_"): (field[0], field[2].__name__) for field in kind.FIELD_DECLARATIONS()
    }
    given: dict[str, Any] = {}
    for name, text in element.attrib.items():
        if name not in types:
            raise AttributeError(f"{element.tag} has no field {name}")
        own, type_name = types[name]
        given[own] = _value(type_name, text)
    node = kind(**given)
    made[element.tag] += 1
    for child in element:
        below = _made(child, made)
        if isinstance(below, (x3d.head, x3d.Scene)):
            setattr(node, child.tag, below)
        else:
            _put(node, below, types)
    return node


def _put(node: Any, child: Any, types: dict[str, tuple[str, str]]) -> None:
    """A child into the field that its class is for."""
    for field in ("children", *_container(child)):
        if field in types:
            own, type_name = types[field]
            if type_name == "MFNode":
                setattr(node, own, [*getattr(node, own), child])
            else:
                setattr(node, own, child)
            return
    raise AttributeError(f"{type(node).__name__} takes no {type(child).__name__}")


def _container(child: Any) -> list[str]:
    fields = {field[0]: field[1] for field in type(child).FIELD_DECLARATIONS()}
    return [fields["_containerField"]] if "_containerField" in fields else []


def _value(type_name: str, text: str) -> Any:
    """A value of a field from the XML encoding."""
    many, base = type_name.startswith("MF"), type_name[2:]
    if base == "Bool":
        return {"true": True, "false": False}.get(text, text)
    if base == "String":
        return [part for part in text.split('"') if part.strip()] if many else text
    if base in _PLAIN:
        values = [_PLAIN[base](part) for part in text.split()]
        return values if many else values[0]
    width = {"Color": 3, "Rotation": 4}.get(base) or _WIDTH.get(base[3:4], 0)
    if not width:
        return text
    numbers = [float(part) for part in text.split()]
    rows = [tuple(numbers[at : at + width]) for at in range(0, len(numbers), width)]
    return rows if many else rows[0]
