"""How far openings lie back and balconies jut out, in the words of the rule file."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.facade.cells import metres
from veduta.facade.layout import Opening
from veduta.facade.measured_depths import projection, recess
from veduta.facade.plan import DEEPEST_SHARE, Plan
from veduta.facade.rule_head import DEEP_M, SHALLOW_M, WIDE_M

MEASURED = 'set(depthFrom, "measured") '
INVENTED = 'set(depthFrom, "invented") '
# How far one looks into a passage (m): to the gate or the dark.
PASSAGE_M = 3.0


@dataclass(frozen=True)
class Depth:
    """words: of the rule file. before: what is set before the call. m: the length (m)."""

    words: str
    m: float
    before: str = ""

    @property
    def is_usual(self) -> bool:
        """Whether it is the length that an attribute of the rule file has."""
        return not self.words[:1].isdigit()


def depth_of_opening(opening: Opening, plan: Plan, usual: str, share: float) -> Depth:
    """The opening's own depth where it was measured, else what is usual.

    usual: in words; share: of the setback. What is set into an opening has none of its own.
    """
    own = recess(opening.element, plan.depths) if share == 1.0 else None
    if opening.element.passage and share == 1.0 and (own is None or not own.is_measured):
        deep = min(PASSAGE_M, DEEPEST_SHARE * plan.depth_m)
        return Depth(metres(deep), deep, INVENTED)
    if own is None or (not own.is_measured and opening.element.class_ == "window"):
        return Depth(usual, share * plan.setback_m)
    deep = min(own.m, DEEPEST_SHARE * plan.depth_m)
    return Depth(metres(deep), deep, MEASURED if own.is_measured else "")


def depth_of_balcony(balcony: Opening, plan: Plan) -> Depth:
    """How far it juts out: measured, as the others of the front, or by its width."""
    own = projection(balcony.element, plan.depths)
    if own is None:
        return Depth("usual", DEEP_M if balcony.rectangle.width >= WIDE_M else SHALLOW_M)
    return Depth(metres(own.m), own.m, MEASURED if own.is_measured else "")
