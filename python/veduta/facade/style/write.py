"""A structure as files that `veduta grammar derive` takes: the style with its attributes set."""

from __future__ import annotations

import json

from veduta import _core
from veduta.facade.style.grammar import DEPTH_M, StyleGrammar
from veduta.facade.style.infer import StyleFound
from veduta.facade.style.posterior import Scored
from veduta.facade.style.prior import Value
from veduta.facade.style.state import SCALE
from veduta.facade.style.told import style_sheet
from veduta.grammar.edits import Edit, edits_text
from veduta.grammar.sheet import encoded

RULES, LOT, EDITS = "rules.cga", "lot.geojson", "edits.txt"
SPACE = "space.png"
LOT_NAME = "front"
_HEAD = """/*
 * The front of {photo} as {name}: the style's rules with the attributes that the photo speaks for.
 * What its rules choose by chance stands in {edits}.
 *
 *     veduta grammar derive {rules} --lots {lot} --edits {edits} -o again
 *
 * The lot is in metres of the style; one of the document's is {scale:.3f} of these.
 */
version "2024.0"

import style : "styles/{name}.cga"

"""


def style_files(found: StyleFound, photo: str) -> dict[str, bytes]:
    """Rules, lot, edits and the picture of the space, by their names."""
    grammar, best = found.chosen.posterior.grammar, found.chosen.best
    edits = [
        Edit((0, *path), None, choices=taken.alternatives)
        for path, taken in sorted(best.state.choices.items())
    ]
    return {
        RULES: style_rules(grammar, best, photo).encode(),
        LOT: _lot(grammar.width_m * best.state.scale).encode(),
        EDITS: edits_text({LOT_NAME: edits}).encode(),
        SPACE: encoded(style_sheet(found), ".png"),
    }


def style_rules(grammar: StyleGrammar, best: Scored, photo: str) -> str:
    """The rule file; its attributes have the names of the style's, and so their place."""
    head = _HEAD.format(
        photo=photo.replace("*/", "* /"),
        name=grammar.name,
        scale=best.state.scale,
        rules=RULES,
        lot=LOT,
        edits=EDITS,
    )
    attributes = "".join(
        f"attr {name} = {_word(value)}\n"
        for name, value in best.state.attributes.items()
        if name != SCALE
    )
    return _core.grammar_format(RULES, f"{head}{attributes}\n@StartRule\nLot --> style.Lot\n")


def _word(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.4g}" if isinstance(value, float) else f'"{value}"'


def _lot(width_m: float) -> str:
    ring = [[0.0, 0.0], [width_m, 0.0], [width_m, DEPTH_M], [0.0, DEPTH_M], [0.0, 0.0]]
    feature = {
        "type": "Feature",
        "id": LOT_NAME,
        "properties": {"name": LOT_NAME},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    return json.dumps({"type": "FeatureCollection", "features": [feature]}, indent=1) + "\n"
