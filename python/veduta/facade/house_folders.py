"""Several houses of one photo: which one is the photo's own, and where the others lie and stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from pydantic import JsonValue

from veduta.facade.document import FacadeDocument, House
from veduta.facade.load import DOCUMENT
from veduta.place.part import Part

BESIDE = "beside"
"""In an item's summary: the other houses of the photo."""
HOUSES_DOUBTED = "houses: the photo may show several"
"""How the note begins that says so."""
Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Beside:
    """Another house of a photo: its folder in that of the first, its box in its own frame (m).

    offset_m: how far right of the first one's frame its own begins.
    """

    folder: str
    low: Vector
    high: Vector
    offset_m: float


def house_folder(number: int) -> str:
    """The folder of a house, by its number from the left."""
    return f"house-{number}"


def main_house(documents: Sequence[FacadeDocument]) -> int:
    """The place of the widest house: its files lie in the photo's own folder."""
    widths = [document.facade.width_px for document in documents]
    return widths.index(max(widths))


def with_numbers(documents: Sequence[FacadeDocument]) -> list[FacadeDocument]:
    """The documents, each with its number, and a note where the others are."""
    total = len(documents)
    if total < 2:
        return list(documents)
    main = main_house(documents)
    found = []
    for place, document in enumerate(documents):
        others = [house_folder(k + 1) for k in range(total) if k not in (place, main)]
        if place != main:
            others.insert(0, "the folder above")
        note = f"house {place + 1} of {total} in the photo, from the left; the others: "
        update = {
            "house": House(number=place + 1, of=total),
            "notes": [*document.notes, note + ", ".join(others)],
        }
        found.append(document.model_copy(update=update))
    return found


def beside_told(
    main: FacadeDocument,
    others: Sequence[tuple[str, FacadeDocument, Part]],
    told: Sequence[Mapping[str, JsonValue]] = (),
) -> dict[str, JsonValue]:
    """What the summary of a photo says of its other houses; nothing where there are none.

    told: the numbers of each, as a summary has those of the main one.
    """
    if not others:
        return {}
    rows: list[JsonValue] = []
    numbers = told or [{} for _ in others]
    for (folder, document, part), found in zip(others, numbers, strict=True):
        low, high = part.bounds_m
        rows.append(
            {
                **found,
                "folder": folder,
                "storeys": document.storeys,
                "offset_m": offset_between(main, document),
                "bounds_min": list(low),
                "bounds_max": list(high),
            }
        )
    return {BESIDE: rows}


def houses_doubt(document: FacadeDocument) -> dict[str, JsonValue]:
    """What the summary says where the photo may show several houses that are not parted."""
    said = next((note for note in document.notes if note.startswith(HOUSES_DOUBTED)), None)
    return {} if said is None else {"houses": said}


def beside_of(summary: Mapping[str, JsonValue]) -> tuple[Beside, ...]:
    """The same, read back."""
    rows = cast(list[dict[str, JsonValue]], summary.get(BESIDE) or [])
    return tuple(
        Beside(
            str(row["folder"]),
            _vector(row["bounds_min"]),
            _vector(row["bounds_max"]),
            cast(float, row["offset_m"]),
        )
        for row in rows
    )


def beside_kept(
    former: Mapping[str, JsonValue], main: FacadeDocument, folder: Path
) -> dict[str, JsonValue]:
    """What a summary keeps of the one before: a rebuild of the main house leaves the others.

    They stand wall to wall with it still, where its place, width or scale were edited. folder: that
    of the photo in OUT, in which the others' documents lie.
    """
    rows = cast(list[dict[str, JsonValue]], former.get(BESIDE) or [])
    kept: list[JsonValue] = []
    for row in rows:
        other = _document(folder / str(row["folder"]) / DOCUMENT)
        kept.append(row if other is None else {**row, "offset_m": offset_between(main, other)})
    return {BESIDE: kept} if kept else {}


def offset_between(main: FacadeDocument, other: FacadeDocument) -> float:
    """How far right of the frame of one house that of another begins (m).

    Pixels between the two count by the other's scale, as its own do; so houses that touch in the
    photo touch, whatever their scales are.
    """
    one, two = main.facade, other.facade
    if two.x_px + 0.5 * two.width_px >= one.x_px + 0.5 * one.width_px:
        gap_px = two.x_px - one.x_px - one.width_px
        return one.width_m + gap_px * other.scale.metres_per_px
    gap_px = one.x_px - two.x_px - two.width_px
    return -two.width_m - gap_px * other.scale.metres_per_px


def _document(path: Path) -> FacadeDocument | None:
    """The document; None where it is gone or broken, which its own rebuild tells."""
    try:
        return FacadeDocument.model_validate_json(path.read_bytes())
    except (OSError, ValueError):
        return None


def beside_line(summary: Mapping[str, JsonValue]) -> str:
    """How many more houses the photo has, in a line; empty where none."""
    rows = cast(list[dict[str, JsonValue]], summary.get(BESIDE) or [])
    if not rows:
        return ""
    more = "1 more house" if len(rows) == 1 else f"{len(rows)} more houses"
    return f"{more} of the photo: {', '.join(str(row['folder']) for row in rows)}"


def beside_found(summary: Mapping[str, JsonValue]) -> list[tuple[str, Mapping[str, JsonValue]]]:
    """The folder of each further house with its numbers; those of an older run have none."""
    rows = cast(list[dict[str, JsonValue]], summary.get(BESIDE) or [])
    return [(str(row["folder"]), row) for row in rows if "windows" in row]


def _vector(value: JsonValue) -> Vector:
    x, y, z = cast(list[float], value)
    return (x, y, z)
