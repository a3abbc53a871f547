"""The verb `veduta grammar`: a rule file and building lots become buildings.

For programs: `parse` reads rules, `derive` gives a derivation with its whole tree of shapes,
`rederive` does one shape of it anew, `log_prior` is its prior probability. The command's own steps
are in the modules beside; its recipe is `pipeline`.
What is here is brought when it is first asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.grammar.derivation import (
        Choice,
        Derivation,
        Polygons,
        Rules,
        Shape,
        StaleShapeError,
        derive,
        log_prior,
        parse,
        rederive,
    )
    from veduta.grammar.edits import Edit, edits_text, read_edits
    from veduta.grammar.options import LimitOptions

__all__ = [
    "Choice",
    "Derivation",
    "Edit",
    "LimitOptions",
    "Polygons",
    "Rules",
    "Shape",
    "StaleShapeError",
    "derive",
    "edits_text",
    "log_prior",
    "parse",
    "read_edits",
    "rederive",
]

_LATE = {
    "Choice": "derivation",
    "Derivation": "derivation",
    "Edit": "edits",
    "LimitOptions": "options",
    "Polygons": "derivation",
    "Rules": "derivation",
    "Shape": "derivation",
    "StaleShapeError": "derivation",
    "derive": "derivation",
    "edits_text": "edits",
    "log_prior": "derivation",
    "parse": "derivation",
    "read_edits": "edits",
    "rederive": "derivation",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
