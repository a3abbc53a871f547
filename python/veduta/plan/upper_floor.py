"""An upper floor alone: nothing leads into it from outdoors, as one comes up by stairs."""

from __future__ import annotations

from collections.abc import Sequence

from veduta.plan.document import PlanDocument, Storey
from veduta.plan.names.storeys import title_of
from veduta.plan.options import HouseOptions


def upper_floor(storeys: Sequence[Storey]) -> str | None:
    """The name of the lowest storey where that says that it lies above another; else None."""
    title = title_of(storeys[0].name)
    return storeys[0].name if title is not None and title.rank > 0 else None


def upper_floor_doubts(document: PlanDocument) -> list[str]:
    """What is to be said of a house whose lowest storey is an upper one; nothing of a flat."""
    name = upper_floor(document.storeys)
    if name is None or document.flat:
        return []
    stairs = ", and no stairs lead down from it" if document.storeys[0].stairs else ""
    return [
        f"{name!r} is an upper floor, and no drawing shows what lies below: it has no way in from"
        f" outdoors and no garden, the visit begins inside{stairs}. Give the lower floors, too."
    ]


def upper_floor_options(document: PlanDocument, options: HouseOptions) -> HouseOptions:
    """The options by which an upper floor alone is built: its roof is its own, no ground is."""
    if document.flat or upper_floor(document.storeys) is None:
        return options
    return options.model_copy(update={"surroundings": "none", "plinth": 0.0})
