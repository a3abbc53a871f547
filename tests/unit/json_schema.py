"""Checks a document against a JSON Schema (draft 2020-12), as far as our schemas use the language.

A word that is not known is an error, so that no rule of a schema goes unheard.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

SCHEMAS = Path(__file__).parent / "tile_schemas"
_TOLD = {"$schema", "$id", "$defs", "title", "description", "default"}
_WITH_IF = {"then", "else"}
_TYPES: dict[str, Callable[[Any], bool]] = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "null": lambda value: value is None,
    "string": lambda value: isinstance(value, str),
    "boolean": lambda value: isinstance(value, bool),
    "integer": lambda value: isinstance(value, int) and not isinstance(value, bool),
    "number": lambda value: isinstance(value, int | float) and not isinstance(value, bool),
}


def schema(name: str) -> dict[str, Any]:
    """Return one of our schemas by the name of its file, less `.schema.json`."""
    found: dict[str, Any] = json.loads((SCHEMAS / f"{name}.schema.json").read_text("utf-8"))
    return found


def faults(value: Any, rules: dict[str, Any]) -> list[str]:
    """All that is wrong with a document: where, and what."""
    return list(_faults(value, rules, rules, "$"))


def _faults(value: Any, rules: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    for word, rule in rules.items():
        if word in _TOLD or word in _WITH_IF:
            continue
        if word in _CHECKS:
            if not _CHECKS[word](value, rule):
                yield f"{at}: {word} {json.dumps(rule)[:80]}"
        elif word in _PARTS:
            yield from _PARTS[word](value, rule, rules, whole, at)
        else:
            raise ValueError(f"the schema has the word {word!r}, which is not known here")


_CHECKS: dict[str, Callable[[Any, Any], bool]] = {
    "type": lambda value, rule: _TYPES[rule](value),
    "const": lambda value, rule: type(value) is type(rule) and value == rule,
    "enum": lambda value, rule: value in rule,
    "minimum": lambda value, rule: not _TYPES["number"](value) or value >= rule,
    "maximum": lambda value, rule: not _TYPES["number"](value) or value <= rule,
    "exclusiveMinimum": lambda value, rule: not _TYPES["number"](value) or value > rule,
    "exclusiveMaximum": lambda value, rule: not _TYPES["number"](value) or value < rule,
    "maxLength": lambda value, rule: not isinstance(value, str) or len(value) <= rule,
    "maxProperties": lambda value, rule: not isinstance(value, dict) or len(value) <= rule,
    "minLength": lambda value, rule: not isinstance(value, str) or len(value) >= rule,
    "pattern": lambda value, rule: not isinstance(value, str) or bool(re.search(rule, value)),
    "minItems": lambda value, rule: not isinstance(value, list) or len(value) >= rule,
    "maxItems": lambda value, rule: not isinstance(value, list) or len(value) <= rule,
    "uniqueItems": lambda value, _: (
        not isinstance(value, list)
        or len({json.dumps(one, sort_keys=True) for one in value}) == len(value)
    ),
    "minProperties": lambda value, rule: not isinstance(value, dict) or len(value) >= rule,
    "required": lambda value, rule: not isinstance(value, dict) or set(rule) <= set(value),
    "dependentRequired": lambda value, rule: (
        not isinstance(value, dict)
        or all(set(others) <= set(value) for name, others in rule.items() if name in value)
    ),
}


def _ref(value: Any, rule: str, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    found: Any = whole
    for step in rule.removeprefix("#/").split("/"):
        found = found[step]
    yield from _faults(value, found, whole, at)


def _properties(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    if isinstance(value, dict):
        for name in set(rule) & set(value):
            yield from _faults(value[name], rule[name], whole, f"{at}.{name}")


def _additional(value: Any, rule: Any, rules: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    if isinstance(value, dict):
        for name in set(value) - set(rules.get("properties", {})):
            if rule is False:
                yield f"{at}.{name}: is no member"
            else:
                yield from _faults(value[name], rule, whole, f"{at}.{name}")


def _names(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    for name in value if isinstance(value, dict) else ():
        yield from _faults(name, rule, whole, f"{at} {name!r}")


def _items(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    for number, one in enumerate(value if isinstance(value, list) else ()):
        yield from _faults(one, rule, whole, f"{at}[{number}]")


def _first_items(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    for number, (one, own) in enumerate(
        zip(value if isinstance(value, list) else (), rule, strict=False)
    ):
        yield from _faults(one, own, whole, f"{at}[{number}]")


def _patterns(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    for name, one in value.items() if isinstance(value, dict) else ():
        for pattern, own in rule.items():
            if re.search(pattern, name):
                yield from _faults(one, own, whole, f"{at}.{name}")


def _all(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    for one in rule:
        yield from _faults(value, one, whole, at)


def _any(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    if not any(_holds(value, one, whole) for one in rule):
        yield f"{at}: none of {json.dumps(rule)[:120]}"


def _not(value: Any, rule: Any, _: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    if _holds(value, rule, whole):
        yield f"{at}: not {json.dumps(rule)[:120]}"


def _if(value: Any, rule: Any, rules: Any, whole: dict[str, Any], at: str) -> Iterator[str]:
    branch = "then" if _holds(value, rule, whole) else "else"
    yield from _faults(value, rules.get(branch, {}), whole, at)


def _holds(value: Any, rule: Any, whole: dict[str, Any]) -> bool:
    return next(_faults(value, rule, whole, ""), None) is None


_PARTS: dict[str, Callable[..., Iterator[str]]] = {
    "$ref": _ref,
    "properties": _properties,
    "additionalProperties": _additional,
    "propertyNames": _names,
    "items": _items,
    "prefixItems": _first_items,
    "patternProperties": _patterns,
    "allOf": _all,
    "anyOf": _any,
    "not": _not,
    "if": _if,
}
