"""What the report says of doubtful pairs, and of components: their names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from veduta.photos.cameras.component import component_name
from veduta.photos.mapping.doubt import Doubt
from veduta.run.page import Table
from veduta.run.report import counted

MOST_ROWS = 200
FOLDED_NOTE = (
    "some photos contradict each other still: each shows what the other, beside it, lacks."
    " Sides of a building that look alike may be folded onto each other"
)


def components_note(sizes: Sequence[int], in_world: Sequence[bool] = ()) -> str:
    """How many photos each component has, and what is not known of them.

    in_world: whether each is laid into the world, which says how those lie to each other.
    """
    listed = ", ".join(
        f"{component_name(number)} (sparse/{number}, {count} photos)"
        for number, count in enumerate(sizes)
    )
    laid = [component_name(number) for number, is_laid in enumerate(in_world) if is_laid]
    if len(laid) == len(sizes):
        known = "By georef.json it is known how they lie to each other"
    elif len(laid) > 1:
        known = f"How they lie to each other is known of {', '.join(laid)} alone (georef.json)"
    else:
        known = "How they lie to each other is not known"
    return (
        f"the photos fall into components that share no view for certain: {listed}. {known};"
        " the points and place.json show A"
    )


def doubts_note(doubts: Sequence[Doubt]) -> str:
    """That pairs were dropped, and why that is done at all."""
    return (
        f"{counted(len(doubts), 'pair')} of photos that match were not used: they cannot show the"
        " same place, as sides of a building that look alike do"
    )


def doubts_table(doubts: Sequence[Doubt], names: Mapping[int, str]) -> list[Table]:
    """The pairs that were not mapped with, those with most features first."""
    if not doubts:
        return []
    ordered = sorted(doubts, key=lambda doubt: -doubt.verified)[:MOST_ROWS]
    rows: list[Sequence[float | int | str | None]] = [
        [names[doubt.first], names[doubt.second], doubt.verified, doubt.reason] for doubt in ordered
    ]
    more = len(doubts) - len(rows)
    note = "Red in the picture of the matches." + (
        f" {more} more with fewer features are not listed." if more else ""
    )
    columns = ("photo", "photo", "features that agree", "why it was not used")
    return [Table("Doubtful pairs", columns, rows, note=note)]
