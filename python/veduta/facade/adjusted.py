"""What the model could not take as the document has it: the notes about it, and their count."""

from __future__ import annotations

from collections.abc import Iterable

from veduta.facade.document import Element

_LEFT_OUT, _CLIPPED = ": left out, ", ": clipped "


def left_out(element: Element, number: int, reason: str) -> str:
    """The note of an element that is not in the model; `number` is its place in the document."""
    return f"{_name(element, number)}{_LEFT_OUT}{reason}"


def clipped(element: Element, number: int, how: str) -> str:
    """The note of an element that the model has smaller than the document."""
    return f"{_name(element, number)}{_CLIPPED}{how}"


def count_adjusted(notes: Iterable[str]) -> dict[str, int]:
    """How many elements the notes of a part name as left out and as clipped."""
    told = list(notes)
    return {
        "left_out": sum(_LEFT_OUT in note for note in told),
        "clipped": sum(_CLIPPED in note for note in told),
    }


def _name(element: Element, number: int) -> str:
    return f"{element.class_} (elements[{number}])"
