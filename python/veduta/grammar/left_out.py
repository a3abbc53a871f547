"""Surfaces that came out too thin to show: which rule made them, and where it stands."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath

_WHY = "too thin, or their lines cross"
MOST_TOLD = 10


@dataclass(frozen=True)
class LeftOut:
    """Surfaces of one rule that are left out of a building, or of all buildings."""

    rule: str
    count: int

    def told(self, place: str = "") -> str:
        """For people. place: where the rule is defined, such as ` (shop.cga:5)`."""
        return f"{self.count} surfaces of {self.rule}{place} were left out: {_WHY}"


def left_out_by_rule(rules: Iterable[str]) -> tuple[LeftOut, ...]:
    """For one building, by the rule of each surface that is left out, most first."""
    counts = Counter(rules)
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    return tuple(LeftOut(rule, count) for rule, count in ordered)


def told_of_all(
    buildings: Iterable[Mapping[str, int]],
    dropped: Mapping[str, int],
    files: Sequence[tuple[str, str]],
) -> list[str]:
    """For the terminal: each rule with the line that defines it, of all buildings together.

    buildings: of each that has a file of its own, how many surfaces of a rule are left out.
    dropped: the same of the tiles, which count where no building has a file. files: names and texts
    of the rules. Of many rules the first ones are named, and the others are counted.
    """
    counts: Counter[str] = Counter()
    for of_lot in buildings:
        counts.update(of_lot)
    counts = counts or Counter(dropped)
    places = _places(files)
    ordered = counts.most_common()
    told = [LeftOut(rule, count).told(places.get(rule, "")) for rule, count in ordered[:MOST_TOLD]]
    if len(ordered) > MOST_TOLD:
        more = sum(count for _, count in ordered[MOST_TOLD:])
        told.append(f"{more} surfaces of {len(ordered) - MOST_TOLD} more rules were left out")
    return told


def _places(files: Sequence[tuple[str, str]]) -> Mapping[str, str]:
    """Where each rule is defined, of several files the first."""
    found: dict[str, str] = {}
    for name, text in files:
        for number, line in enumerate(text.splitlines(), start=1):
            rule = re.match(r"\s*([A-Za-z_][\w.]*)\s*(?:\([^)]*\))?\s*(?:-->|-->\s|$)", line)
            if rule is not None and "-->" in line:
                found.setdefault(rule[1], f" ({PurePath(name).name}:{number})")
    return found
