"""Numbers on the command line, checked before the parser sees them.

The parser and pydantic speak of types and validators; a person is told which option it is, what is
wrong with its value, and what to write instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from veduta.cli.words import given_to, number_of, options_of
from veduta.run.errors import InputError
from veduta.run.options import DeclaredOption

Bound = float | int | None
_WORDS = {2: "two", 3: "three", 4: "four", 6: "six", 8: "eight"}


@dataclass(frozen=True)
class NumberOption:
    """An option that takes one number or several, as its field declares it."""

    flag: str
    whole: bool
    count: int = 1
    least: Bound = None
    most: Bound = None
    above: Bound = None
    below: Bound = None
    order: str = ""
    """What several numbers stand for, in their order."""

    @property
    def wanted(self) -> str:
        """What the option takes, in words."""
        kind = "whole number" if self.whole else "number"
        if self.count > 1:
            order = f": {self.order}" if self.order else ""
            return f"{_count(self.count)} {kind}s with spaces between them{order}"
        if self.least is not None and self.most is not None:
            return f"a {kind} from {_short(self.least)} to {_short(self.most)}"
        bounds = {
            "at least": self.least,
            "above": self.above,
            "at most": self.most,
            "below": self.below,
        }
        said = [f"{word} {_short(bound)}" for word, bound in bounds.items() if bound is not None]
        return " ".join([f"a {kind}", " and ".join(said)]).strip()

    def holds(self, value: float) -> bool:
        """Whether the value is within the option's range."""
        return (
            (self.least is None or value >= self.least)
            and (self.most is None or value <= self.most)
            and (self.above is None or value > self.above)
            and (self.below is None or value < self.below)
        )


def require_numbers(call: type[Any], arguments: Sequence[str]) -> None:
    """InputError for the first option of `call` whose value is no number, or none of its range."""
    options = {option.flag: option for option in number_options(call)}
    for name, words in given_to(options, arguments):
        _require(options[name], words[: options[name].count])


def number_options(call: type[Any]) -> list[NumberOption]:
    """The options with numbers of a verb's arguments, and of the option models in them."""
    declared, others = options_of(call)
    kinds = {name: kind for name, kind in others.items() if kind in (int, float)}
    return _of_models(declared) + [
        NumberOption(name, whole=kind is int) for name, kind in kinds.items()
    ]


def _of_models(declared: Sequence[DeclaredOption]) -> list[NumberOption]:
    found = []
    for option in declared:
        taken = option.value
        items = taken
        if taken.get("type") == "array":  # of a fixed length, or of any
            items = taken["prefixItems"][0] if "prefixItems" in taken else taken["items"]
        if items.get("type") not in ("integer", "number"):
            continue
        found.append(
            NumberOption(
                option.flag,
                whole=items["type"] == "integer",
                count=taken.get("minItems", 1),
                least=items.get("minimum"),
                most=items.get("maximum"),
                above=items.get("exclusiveMinimum"),
                below=items.get("exclusiveMaximum"),
                order=option.description.partition(": ")[2],
            )
        )
    return found


def _require(option: NumberOption, words: Sequence[str]) -> None:
    given = " ".join(words)
    if not words:
        raise InputError(option.flag, "its value is missing", f"Give {option.wanted}.")
    values = [number_of(word, whole=option.whole) for word in words]
    numbers = [value for value in values if value is not None]
    if len(numbers) < option.count:
        singular = "whole number" if option.whole else "number"
        what = f"a {singular}" if option.count == 1 else f"{_count(option.count)} {singular}s"
        raise InputError(option.flag, f'"{given}" is not {what}', _remedy(option, given))
    if not all(option.holds(value) for value in numbers):
        raise InputError(option.flag, f"{given} is out of range", f"Give {option.wanted}.")


def _remedy(option: NumberOption, given: str) -> str:
    """What to write; a decimal comma is the commonest slip."""
    pointed = given.replace(",", ".")
    value = number_of(pointed, whole=option.whole) if option.count == 1 else None
    if value is not None and option.holds(value):
        return f"Write {pointed}, with a point."
    return f"Give {option.wanted}."


def _short(bound: float) -> str:
    return str(int(bound)) if bound == int(bound) else str(bound)


def _count(number: int) -> str:
    return _WORDS.get(number, str(number))
