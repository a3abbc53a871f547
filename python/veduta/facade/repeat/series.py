"""Rows of things: neighbours that are alike are one, and the longest run of them repeats."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Run(Generic[T]):
    """`item` stands `count` times in a row; `repeats` says whether more of it fill a longer row."""

    item: T
    count: int
    repeats: bool = False


def series(
    items: Sequence[T],
    fit: Callable[[Sequence[T]], bool],
    merged: Callable[[Sequence[T]], T],
    may_repeat: Callable[[T], bool] = lambda _: True,
) -> tuple[Run[T], ...]:
    """The runs of neighbours that are alike, each as what `merged` makes of them.

    An item joins the run before it where they `fit` into one rule. The longest run that may repeat
    does; of equally long ones that which is nearest to the middle.
    """
    groups: list[list[T]] = []
    for item in items:
        if groups and fit([*groups[-1], item]):
            groups[-1].append(item)
        else:
            groups.append([item])
    runs = [Run(merged(group), len(group)) for group in groups]
    middle = 0.5 * (len(runs) - 1)
    ranks = [
        (run.count, -abs(place - middle), place)
        for place, run in enumerate(runs)
        if may_repeat(run.item)
    ]
    if not ranks:
        return tuple(runs)
    chosen = max(ranks)[2]
    return tuple(
        Run(run.item, run.count, repeats=place == chosen) for place, run in enumerate(runs)
    )
