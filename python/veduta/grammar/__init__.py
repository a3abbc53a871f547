"""The verb `veduta grammar`: a rule file and building lots become buildings.

For programs: `parse` reads rules, `derive` gives a derivation with its whole tree of shapes,
`rederive` does one shape of it anew, `log_prior` is its prior probability. The command's own steps
are in the modules beside; its recipe is `pipeline`.
"""

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
