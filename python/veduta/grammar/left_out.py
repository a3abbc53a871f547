"""Surfaces that came out too thin to show: which rule made them, and where it stands."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import PurePath

_WHY = "too thin, or their lines cross"
_NOTE = re.compile(rf"(\d+) surfaces of (\S+) were left out: {_WHY}")
MOST_TOLD = 10


def left_out_notes(rules: Iterable[str]) -> list[str]:
    """For one building, by the rule of each surface that is left out."""
    counts = Counter(rules)
    return [
        f"{count} surfaces of {rule} were left out: {_WHY}"
        for rule, count in sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    ]


def is_left_out(note: str) -> bool:
    """Whether a note is one of `left_out_notes`."""
    return _NOTE.fullmatch(note) is not None


def told_of_all(
    notes: Iterable[Iterable[str]], dropped: int, files: Sequence[tuple[str, str]]
) -> list[str]:
    """For the terminal: each rule with the line that defines it, of all buildings together.

    notes: of each building that has a file of its own. dropped: surfaces of all buildings; where
    they have no files nothing says which rules made them. files: names and texts of the rules.
    """
    counts: Counter[str] = Counter()
    for of_lot in notes:
        for note in of_lot:
            if (found := _NOTE.fullmatch(note)) is not None:
                counts[found[2]] += int(found[1])
    if not counts:
        return [f"{dropped} surfaces were left out: {_WHY}"] if dropped else []
    places = _places(files)
    return [
        f"{count} surfaces of {rule}{places.get(rule, '')} were left out: {_WHY}"
        for rule, count in counts.most_common(MOST_TOLD)
    ]


def _places(files: Sequence[tuple[str, str]]) -> Mapping[str, str]:
    """Where each rule is defined, of several files the first."""
    found: dict[str, str] = {}
    for name, text in files:
        for number, line in enumerate(text.splitlines(), start=1):
            rule = re.match(r"\s*([A-Za-z_][\w.]*)\s*(?:\([^)]*\))?\s*(?:-->|-->\s|$)", line)
            if rule is not None and "-->" in line:
                found.setdefault(rule[1], f" ({PurePath(name).name}:{number})")
    return found
