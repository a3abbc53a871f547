"""A flat is a flat: it has no roof and no garden of its own."""

from __future__ import annotations

import re
from collections.abc import Iterable

from veduta.plan.document import PlanDocument, Text
from veduta.plan.options import HouseOptions

SURE = 0.8
"""Score of a text from which on it is believed."""
_FLAT = re.compile(
    r"\b(?:flat(?!\s*roof)|apartment|apt|maisonette|condo(?:minium)?|wohnung|\w+zimmerwohnung"
    r"|appartement|apartamento|departamento|appartamento|bilocale|trilocale|huoneisto|lägenhet)\b"
    r"|דירה|マンション|アパート",
    re.IGNORECASE,
)
_ROOMS = re.compile(r"^\W*(?:\d\s?[hH]\s?\+\s?[kK]|\d-?\s?[zZ]immer-?\s?[wW]|[1-6]S?LDK\b)")
"""`3h+k`, `2-Zimmer-Wohnung`, `2LDK`: how flats are offered."""


def flat_named(texts: Iterable[Text]) -> str | None:
    """What a sheet says by which it shows a flat; None where it does not."""
    return next(
        (
            one.text
            for one in texts
            if one.score >= SURE and (_FLAT.search(one.text) or _ROOMS.search(one.text))
        ),
        None,
    )


def with_flat(document: PlanDocument, options: HouseOptions, *, by_text: bool) -> PlanDocument:
    """The document as one of a flat where the option says so, or (by_text) its only sheet.

    Of several storeys only the option does: a house may hold a flat. What a sheet says is a doubt.
    """
    if document.flat or options.flat:
        return document.model_copy(update={"flat": True})
    (first, *more) = document.storeys
    said = flat_named(first.texts) if by_text and not more else None
    if said is None:
        return document
    doubt = f"taken for a flat, without roof and garden of its own, as {said!r} is on the sheet."
    return with_doubt(document, doubt).model_copy(update={"flat": True})


def with_doubt(document: PlanDocument, doubt: str) -> PlanDocument:
    """The document with one more doubt, which its first storey tells."""
    (first, *more) = document.storeys
    told = first.model_copy(update={"doubts": [*first.doubts, doubt]})
    return document.model_copy(update={"storeys": [told, *more]})


def flat_options(document: PlanDocument, options: HouseOptions) -> HouseOptions:
    """The options by which a flat is built; those of a house as they are."""
    if not document.flat:
        return options
    changes = {"flat": True, "roof": "none", "surroundings": "none", "plinth": 0.0}
    return options.model_copy(update=changes)
