"""What the report says of how maps were begun: the first pairs, and why these."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from veduta.photos.cameras.component import component_name
from veduta.photos.mapping.initial_pair import LEAST_ANGLE_DEG, MOST_PLANAR, Start
from veduta.run.page import Table
from veduta.run.report import counted

GLOBAL_NOTE = (
    "all photos were placed at once (--mapping global), by the focal lengths that EXIF states"
)
_NOTE = (
    "The pair with the most matches of those that a homography does not explain (at most"
    f" {MOST_PLANAR:.0%} of the matches) and whose rays are {LEAST_ANGLE_DEG:.0f}° apart or more;"
    " pairs whose focal lengths are known come first."
)


def starts_notes(
    starts: Sequence[Start], components: Sequence[Sequence[int]], names: Mapping[int, str]
) -> list[str]:
    """Which two photos each map was begun with. components: the photos (image ids) of each."""
    return [
        f"the map of {component_name(number)} begins with {names[start.pair.first]} and"
        f" {names[start.pair.second]}: {_why(start)}"
        for number, start in _by_component(starts, components)
    ]


def _why(start: Start) -> str:
    pair = start.pair
    if start.chosen_by == "ahead":
        return (
            f"the camera moved ahead, and of the pairs that one may begin with there their rays are"
            f" furthest apart ({pair.angle_deg:.1f}°)"
        )
    if start.chosen_by == "engine":
        tried = (
            f"no map grew from the {counted(start.refused, 'pair')} that"
            f" {'meets' if start.refused == 1 else 'meet'} the conditions of the thesis"
            if start.refused
            else f"of {counted(start.passed_over, 'pair')} none meets the conditions of the thesis"
        )
        return f"the engine chose them, for {tried}" + (f" ({pair.fault})" if pair.fault else "")
    refused = f", from {counted(start.refused, 'better pair')} no map grew" if start.refused else ""
    known = "" if pair.known else ", the focal length assumed"
    return (
        f"{pair.matches:,} matches, of which a homography explains"
        f" {pair.planar:.0%}, and rays {pair.angle_deg:.0f}° apart{known}{refused}"
    )


def starts_table(
    starts: Sequence[Start], components: Sequence[Sequence[int]], names: Mapping[int, str]
) -> list[Table]:
    """The first pair of each component, with what the conditions ask."""
    rows: list[Sequence[float | int | str | None]] = [
        [
            component_name(number),
            names[start.pair.first],
            names[start.pair.second],
            start.pair.matches,
            round(100 * start.pair.planar, 1),
            None if (angle := start.pair.angle_deg) is None else round(angle, 1),
            "yes" if start.pair.known else "no",
            start.passed_over,
            start.refused,
            start.chosen_by,
        ]
        for number, start in _by_component(starts, components)
    ]
    columns = (
        "component", "photo", "photo", "matches", "% a homography explains", "rays apart °",
        "focal lengths known", "passed over before", "without a map before", "chosen by",
    )  # fmt: skip
    title = "What the maps were begun with"
    return [Table(title, columns, rows, note=_NOTE, for_experts=True)] if rows else []


def _by_component(
    starts: Sequence[Start], components: Sequence[Sequence[int]]
) -> list[tuple[int, Start]]:
    """Each with the number of the component that has its photos now; a component may be gone."""
    return [
        (number, start)
        for number, photos in enumerate(components)
        for start in starts
        if start.pair.first in photos or start.pair.second in photos
    ]
