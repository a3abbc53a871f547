"""The levels of detail of a building, and what rule files say of them.

A rule file that has the attribute `LOD` (the convention of CityEngine) is derived several times:
with 2, all that there is, with 1.5, all of it with few faces, and with 0, little more than the
volume; for CityJSON with 1, windows as plain surfaces. A file without it has one level, and its
lots stand as prisms in the distance.
"""

from __future__ import annotations

from dataclasses import dataclass

from veduta import _core
from veduta.grammar.outline import Attribute

ATTRIBUTE = "LOD"
FULL, PLAIN, PANELS, VOLUME = 2.0, 1.5, 1.0, 0.0
ERROR_M = {FULL: 0.0, PLAIN: 0.5, VOLUME: 4.0}
"""How far a level is from the truth: the depth of what rules leave out of a window or a railing; of
a balcony or a cornice with its shadow."""
BOXES_ERROR_M = 25.0
"""Of buildings as boxes: a roof, or a wing that is not there."""

PRISM = """
attr height = 9
attr walls = "#d8d0c2"
attr roofs = "#7d7f83"
Lot --> extrude(world.up, height) comp(f) { top : Roof | bottom : NIL | all : Wall }
Wall --> set(material.name, "wall") color(walls)
Roof --> set(material.name, "roof") color(roofs)
"""
PRISM_NAME = "prism.cga"


@dataclass(frozen=True)
class Levels:
    """The levels that a rule file has; `marked` where it has the attribute."""

    marked: bool

    @property
    def plain(self) -> bool:
        """Whether there is a level between all and the volume."""
        return self.marked

    def given(self, attributes: dict[str, Attribute], level: float) -> dict[str, Attribute]:
        """The attributes of a lot at a level."""
        return attributes | {ATTRIBUTE: level} if self.marked else attributes


def levels_of(rules: _core.GrammarRules, given: dict[str, Attribute]) -> Levels:
    """The levels of a rule file; one that the call fixes is the only one."""
    kinds = dict(rules.attributes)
    return Levels(kinds.get(ATTRIBUTE) == "number" and ATTRIBUTE not in given)


def prism_attributes(
    height_m: float,
    walls: tuple[float, float, float] | None,
    roofs: tuple[float, float, float] | None,
) -> dict[str, Attribute]:
    """What makes a prism of a lot look like its building."""
    found: dict[str, Attribute] = {"height": max(height_m, 0.1)}
    for name, colour in (("walls", walls), ("roofs", roofs)):
        if colour is not None:
            found[name] = "#" + "".join(f"{round(255 * channel):02x}" for channel in colour)
    return found
