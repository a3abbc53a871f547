"""Options that change nothing where a house is rebuilt: what they are about is in the document.

They are no error: who repeats the call that made the document may give them. An option counts as
given where it is not what it is by default.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from veduta.plan.document import PlanDocument, Storey
from veduta.plan.options import PlanOptions
from veduta.run.options import Options, flag


@dataclass(frozen=True)
class _Settled:
    """Options that a storey settles: which storeys do, what they have, and how to change that."""

    names: tuple[str, ...]
    by: Callable[[Storey], bool]
    state: str
    remedy: str


_FURNISHED = "set its furniture to null in the document to have it furnished anew, to [] for none"
_LIT = "set its lights to null in the document to have it lit anew, to [] for none"
_SETTLED = (
    _Settled(
        ("seed", "varied_furniture"),
        lambda storey: storey.furniture is not None,
        "is furnished already",
        _FURNISHED,
    ),
    _Settled(
        ("no_furniture",), lambda storey: bool(storey.furniture), "is furnished already", _FURNISHED
    ),
)
_WALL_LAMPS = _Settled(
    ("lights",), lambda storey: storey.lights is not None, "is lit already", _LIT
)
_NO_LAMPS = _Settled(("lights",), lambda storey: bool(storey.lights), "is lit already", _LIT)


def idle_notes(document: PlanDocument, options: PlanOptions) -> list[str]:
    """A note for each option that has no effect on some storeys of a document, or on all."""
    house = options.house
    notes = []
    for settled in (*_SETTLED, _NO_LAMPS if house.lights == "none" else _WALL_LAMPS):
        where = [storey.name for storey in document.storeys if settled.by(storey)]
        for name in settled.names if where else ():
            if _is_given(house, name):
                reason = f"which {settled.state}; {settled.remedy}"
                notes.append(f"{flag(name)} changes nothing in {', '.join(where)}, {reason}")
    if _is_given(house, "storey_height"):
        notes.append("--storey-height changes nothing: height_m of the document's storeys counts")
    return notes


def _is_given(group: Options, name: str) -> bool:
    default: object = type(group).model_fields[name].default
    return bool(getattr(group, name) != default)
