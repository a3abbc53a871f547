"""What an edited document says of itself: its notes, its doubts, and where its scale comes from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.document import FacadeDocument
from veduta.facade.plausible import STOREY_DOUBTS
from veduta.facade.scale import ASSUMED_STOREY

_METRES = "pixels and metres differed, and the pixels decided: "
_RULES = "rules and derivation made anew from what was edited"
_EXTENTS = "extents: the wall's are not the borders of facade; labels.png has them as they stand"
_SHOWN_NAMES = 5
# How far, in pixels, the painted wall may end beside the facade.
_BESIDE_PX = 0.5


@dataclass(frozen=True)
class Edits:
    """What differs from the document as it was found; `metres` names what had others."""

    metres: tuple[str, ...] = ()
    rules: bool = False
    floors: bool = False
    scale: bool = False


def told(document: FacadeDocument, edits: Edits) -> FacadeDocument:
    """The document with what it says of itself brought up to date.

    Where nothing was edited since it was written, it comes back as it is. Notes of earlier edits
    make place for those of this one; a scale that somebody wrote is "edited"; and who edits the
    floors, or says that they are not doubtful, has settled a doubt about them.
    """
    settled = edits.floors or not document.storeys_doubtful
    if edits == Edits() and not (settled and set(STOREY_DOUBTS) & set(document.notes)):
        return document
    notes = [note for note in document.notes if not note.startswith((_METRES, _RULES, _EXTENTS))]
    update: dict[str, object] = {}
    if edits.scale:
        update["scale"] = document.scale.model_copy(update={"basis": "edited"})
        notes = [note for note in notes if note != ASSUMED_STOREY]
    if settled:
        update["storeys_doubtful"] = False
        notes = [note for note in notes if note not in STOREY_DOUBTS]
    if edits.metres:
        notes.append(_METRES + _listed(list(dict.fromkeys(edits.metres))))
    if edits.rules:
        notes.append(_RULES)
    if not _is_painted_to_its_borders(document):
        notes.append(_EXTENTS)
    return document.model_copy(update=update | {"notes": notes})


def _listed(names: Sequence[str]) -> str:
    more = len(names) - _SHOWN_NAMES
    shown = ", ".join(names[:_SHOWN_NAMES])
    return f"{shown} and {more} more" if more > 0 else shown


def _is_painted_to_its_borders(document: FacadeDocument) -> bool:
    """Whether the extents of class wall end where the facade does; True where there are none."""
    walls = [extent.polygon_px for extent in document.extents if extent.class_ == "wall"]
    points = [point for polygon in walls for point in polygon]
    if not points:
        return True
    box = document.facade
    borders = (box.x_px, box.x_px + box.width_px), (box.y_px, box.y_px + box.height_px)
    return all(
        abs(found - border) <= _BESIDE_PX
        for along, (low, high) in zip(zip(*points, strict=True), borders, strict=True)
        for found, border in ((min(along), low), (max(along), high))
    )
