"""The rule file of a building as it was read: `cells.cga`, which the model is derived from.

Attributes first, then the rules of this building (its floors, shop fronts and roof), then those
that its parts need, from `parts/*.cga`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from veduta import _core
from veduta.facade.cells import LEAST_M, Cell, metres, splits
from veduta.facade.depth_words import depth_of_balcony, depth_of_opening
from veduta.facade.document import Element
from veduta.facade.dormers import LID_M, LID_SIDE_M, Dormer
from veduta.facade.layout import Opening
from veduta.facade.mouldings import PlannedMoulding
from veduta.facade.plan import Band, Plan
from veduta.facade.planned_gable import PlannedGable
from veduta.facade.rectangles import Rectangle
from veduta.facade.rule_head import (
    CELLS,
    floor_attribute,
    floor_foot,
    hex_colour,
    rule_head,
)
from veduta.facade.shape import Cut, cuts_of
from veduta.facade.shutters import PlannedShutter
from veduta.facade.textures import FacadeTextures
from veduta.place.semantics import Provenance

PARTS = Path(__file__).parent / "parts"
Size = tuple[float, float]
_NO_SIZE: Size = (np.nan, np.nan)


@dataclass(frozen=True)
class Known:
    """What the plan knows of a surface: its size, and the element of the photo that it shows.

    seen_height_m: how much of it was seen, where a rule made it reach further down.
    """

    size_m: Size
    element: Element | None = None
    seen_height_m: float | None = None


@dataclass(frozen=True)
class RuleFile:
    """The text, and what is known of the surfaces that it names."""

    text: str
    known: dict[str, Known]


def write_rules(
    plan: Plan, textures: FacadeTextures, roof_said: Provenance, photo: str
) -> RuleFile:
    """The rule file of a plan; `photo` is the name of the photo, for the people who read it."""
    writer = _Writer(plan, textures)
    front = writer.front()
    slope = writer.slope(roof_said)
    building = writer.building()
    head = rule_head(plan, textures, photo, writer.parts)
    writer.parts |= {part for word, part in _COLUMNS.items() if word in "".join([*front, slope])}
    parts = [_part(name) for name in _ORDER if name in writer.parts]
    text = "\n".join([head, building, *front, slope, *parts])
    return RuleFile(_core.grammar_format(CELLS, text), writer.known)


def provenance(opening: Opening) -> Provenance:
    """That of the element; a size that a rule has added to is inferred, not measured."""
    said = Provenance(opening.element.provenance)
    extended = opening.seen_height_m is not None
    return Provenance.INFERRED if extended and said is Provenance.MEASURED else said


class _Writer:
    """The rules of one building, as they are written."""

    def __init__(self, plan: Plan, textures: FacadeTextures) -> None:
        self.plan, self.textures = plan, textures
        self.known: dict[str, Known] = {"front wall": Known((plan.width_m, plan.eaves_m))}
        self.counts: Counter[str] = Counter()
        self.parts: set[str] = set()

    def building(self) -> str:
        """From the lot to the sides of the building."""
        plan = self.plan
        is_roofed = plan.mansard is not None or plan.gable is not None
        roof = " [ t(0, eaves, 0) Roof ]" if is_roofed else ""
        top = "NIL" if is_roofed else "FlatRoof"
        text = _BODY.format(inside=f"[ Body ]{roof}{self._chimneys()}", top=top)
        return text if is_roofed else text + _FLAT_ROOF

    def front(self) -> list[str]:
        """The front, its floors, shop fronts and balconies."""
        rules: list[str] = []
        floors = " | ".join(self._floor(band, rules) for band in self.plan.bands)
        calls = "\n".join(map(self._balcony, self.plan.balconies))
        ledges = "\n".join(self._ledges())
        walls = "texture(wallPhoto) projectUV(0) Floors"
        mouldings = "\n".join(map(self._moulding, self.plan.mouldings))
        shutters = "\n".join(map(self._shutter, self.plan.shutters))
        apart = {
            "Balconies": calls, "Ledges": ledges, "Mouldings": mouldings, "Shutters": shutters
        }  # fmt: skip
        before = "".join(f" {name}" for name, text in apart.items() if text)
        front = _FRONT.format(floors=floors, inside=f"[ {walls} ]{before}" if before else walls)
        rules += [f"Ledges -->\n{ledges}\n"] if ledges else []
        rules += [f"Mouldings -->\n{mouldings}\n"] if mouldings else []
        rules += [f"Shutters -->\n{shutters}\n"] if shutters else []
        return [front, f"Balconies -->\n{calls}\n" if calls else "", *rules]

    def slope(self, said: Provenance) -> str:
        """The front slope of the roof, with its dormers."""
        if self.plan.gable is not None:
            return self._gable(self.plan.gable)
        mansard = self.plan.mansard
        if mansard is None:
            return ""
        self.parts |= {"mansard"}
        for side in ("front", "right", "back", "left"):
            self.known |= {f"{side} {which} slope": Known(_NO_SIZE) for which in ("lower", "upper")}
        cells = [self._dormer(*each) for each in enumerate(self.plan.dormers, start=1)]
        region = Rectangle(0.0, mansard.eaves_m, mansard.width_m, mansard.break_m)
        return _FRONT_SLOPE.format(said=said, cut=splits(cells, region, "Roof.", "up({})"))

    def _gable(self, gable: PlannedGable) -> str:
        """The gable in the front's plane, with its openings; nothing for a hipped roof."""
        names = [f"slope {number}" for number in range(1, 5)]
        self.known |= {name: Known(_NO_SIZE) for name in (*names, "front gable", "back gable")}
        self.parts |= {gable.kind}
        if gable.kind == "hip":
            return ""
        region = Rectangle(0.0, gable.eaves_m, gable.width_m, gable.top_m)
        rules: list[str] = []
        cells = [self._opening(o, "setback", 1.0, rules, "Wall.") for o in gable.openings]
        return "\n".join([_FRONT_GABLE.format(cut=splits(cells, region, "Wall.")), *rules])

    def _name(self, opening: Opening) -> str:
        """The name of the surface of an element, with the next number of its kind."""
        kind, place = opening.element.class_, opening.rectangle
        self.counts[kind] += 1
        name = f"{kind} {self.counts[kind]}"
        size = (place.width, place.height)
        self.known[name] = Known(size, opening.element, opening.seen_height_m)
        return name

    def _floor(self, band: Band, rules: list[str]) -> str:
        """The cell of one floor in the front's split; its rule is added to the others."""
        attribute = floor_attribute(band)
        rule = attribute[0].upper() + attribute[1:]
        region = Rectangle(0.0, band.foot_m, self.plan.width_m, band.top_m)
        cells = [
            self._opening(opening, "setback", 1.0, rules, "Wall.") for opening in band.openings
        ]
        rules.append(f"{rule} --> {splits(cells, region, 'Wall.')}\n")
        return f"{attribute} : {rule}"

    def _opening(
        self, opening: Opening, deep: str, share: float, rules: list[str], around: str
    ) -> Cell:
        """The call that builds an opening; a shop front with doors gets a rule of its own.

        deep: how far it lies back, a share of the setback. around: what it is cut out of.
        """
        kind, place = opening.element.class_, opening.rectangle
        name, said = self._name(opening), provenance(opening)
        own = depth_of_opening(opening, self.plan, deep, share)
        self._reveal(name, place, own.m)
        if opening.children:
            inside = [
                self._opening(o, "setback / 2", 0.5, rules, "Panel.") for o in opening.children
            ]
            cut, rule = splits(inside, place, "Panel."), name.title().replace(" ", "")
            rules.append(_SHOP.format(rule=rule, name=name, said=said, cut=cut, deep=own.words))
            return Cell(place, own.before + rule)
        self.parts |= {"panel"}
        cuts = cuts_of(opening.element, place)
        if kind == "window" and cuts:
            self.parts |= {"window", "shaped"}
            call = f'{own.before}Shaped("{name}", "{said}", {own.words})'
            return Cell(place, _cut_out(cuts, call, around))
        if kind == "window":
            self.parts |= {"window"}
            call = f'{own.before}Window("{name}", "{said}", {own.words})'
            is_column = share == 1.0 and own.is_usual
            column = f'Column({{}}, {{}}, {{}}, "{name}", "{said}")' if is_column else ""
            return Cell(place, call, column)
        if kind == "door" and not cuts and not opening.element.passage:
            self.parts |= {"library_door"}
            return Cell(place, f'{own.before}Door("{name}", "{said}", {own.words})')
        self.parts |= {"opening"}
        call = f'{own.before}Opening("{kind}", "{name}", "{said}", {own.words})'
        return Cell(place, _cut_out(cuts, call, around))

    def _reveal(self, name: str, place: Rectangle, deep_m: float) -> None:
        self.parts |= {"reveal"}
        self.known[f"reveal of {name}"] = Known((deep_m, place.height))

    def _balustrade(self, name: str, balustrade: Opening) -> str:
        """The call of a rail on the edge of the roof."""
        self.parts |= {"library_balustrade"}
        place = balustrade.rectangle
        stuff, colour = self.textures.colours.balustrade(balustrade.number)
        x, w, h = map(metres, (place.x0, place.width, place.height))
        said = balustrade.element.provenance
        kind = f'"{name}", "{said}", "{stuff}", "{hex_colour(colour)}"'
        # Below the eaves there is wall behind it: it stands before that.
        out = "0" if place.z0 + 0.5 * place.height > self.plan.eaves_m else "0.25"
        return f"[ Balustrade({kind}, {x}, {self._height(place.z0)}, {w}, {h}, {out}) ]"

    def _balcony(self, balcony: Opening) -> str:
        name, place = self._name(balcony), balcony.rectangle
        if balcony.element.balustrade and self.plan.library:
            return self._balustrade(name, balcony)
        self.parts |= {"balcony", "library_railing"}
        out = depth_of_balcony(balcony, self.plan)
        self.known[f"floor and sides of {name}"] = Known((place.width, out.m))
        x, w, h = map(metres, (place.x0, place.width, place.height))
        said = balcony.element.provenance
        sizes = f'"{name}", "{said}", {x}, {self._height(place.z0)}, {w}, {h}'
        call = f"Balcony({sizes})" if out.is_usual else f"{out.before}Jutting({sizes}, {out.words})"
        own = self.textures.colours.own_railing(balcony.number)
        if own is None:
            return call
        kind, colour = own
        stuff = f'set(railingKind, "{kind}") set(railingColor, "{hex_colour(colour)}")'
        return f"[ {stuff} {call} ]"

    def _ledges(self) -> list[str]:
        calls = []
        for number, ledge in enumerate(self.plan.ledges, start=1):
            self.parts |= {"ledge"}
            name, high = f"cornice {number}", ledge.top_m - ledge.foot_m
            self.known[name] = Known((self.plan.width_m, high))
            self.known[f"sides of {name}"] = Known((self.plan.width_m, ledge.out_m))
            sizes = f"{self._height(ledge.foot_m)}, {metres(high)}, {metres(ledge.out_m)}"
            calls.append(f'Ledge("{name}", {sizes})')
        return calls

    def _moulding(self, planned: PlannedMoulding) -> str:
        """The call of a cornice or a course."""
        self.parts |= {"library_cornice"}
        place, told, name = planned.place, planned.moulding, f"moulding {planned.number + 1}"
        self.known[name] = Known((place.width, place.height))
        x, w, h = map(metres, (place.x0, place.width, place.height))
        stone = hex_colour(self.textures.colours.mouldings[planned.number])
        kind = f'"{name}", "{told.provenance}", "{told.kind}", "{stone}"'
        return f"[ Cornice({kind}, {x}, {self._height(place.z0)}, {w}, {h}) ]"

    def _shutter(self, planned: PlannedShutter) -> str:
        """The call of a shutter: on the wall, or before the frame of its window."""
        self.parts |= {"library_shutter"}
        place, told, name = planned.place, planned.shutter, f"shutter {planned.number + 1}"
        self.known[name] = Known((place.width, place.height))
        x, w, h = map(metres, (place.x0, place.width, place.height))
        paint = hex_colour(self.textures.colours.shutters[planned.number])
        out = "0" if told.kind == "open" else "-setback"
        kind = f'"{name}", "{told.provenance}", "{paint}"'
        return f"[ Shutter({kind}, {x}, {self._height(place.z0)}, {w}, {h}, {out}) ]"

    def _height(self, z_m: float) -> str:
        """A height over the ground, told from the foot of its floor or from the eaves."""
        levels = [(band.foot_m, floor_foot(band)) for band in self.plan.bands]
        levels.append((self.plan.eaves_m, "eaves"))
        foot_m, name = [level for level in levels if level[0] <= z_m + LEAST_M][-1]
        return metres(z_m) if name == "0" else f"{name} + {metres(z_m - foot_m)}"

    def _dormer(self, number: int, dormer: Dormer) -> Cell:
        self.parts |= {"dormer", "library_dormer", "window", "panel", "reveal"}
        name, window = f"dormer {number}", self._name(dormer.window)
        self._reveal(window, dormer.window.rectangle, self.plan.setback_m)
        self.known[name] = Known((dormer.front.width, dormer.front.height))
        self.known[f"lid of {name}"] = Known((dormer.front.width + 2 * LID_SIDE_M, LID_M))
        call = f'Dormer("{name}", "{window}", "{provenance(dormer.window)}")'
        column = (
            f'SlopeColumn({{}}, {{}}, {{}}, "{name}", "{window}", "{provenance(dormer.window)}")'
        )
        return Cell(dormer.front, call, column)

    def _chimneys(self) -> str:
        calls = ""
        for number, chimney in enumerate(self.plan.chimneys, start=1):
            self.parts |= {"chimney", "library_chimney"}
            name, place = f"chimney {number}", chimney.front
            self.known[name] = Known((place.width, place.height), chimney.element)
            self.known[f"sides and back of {name}"] = Known(_NO_SIZE)
            high = place.z1 - self._roof_edge_m()
            sizes = (place.x0, place.width, high, chimney.near_m, chimney.far_m)
            calls += f' [ Chimney("{name}", {", ".join(map(metres, sizes))}) ]'
        return calls

    def _roof_edge_m(self) -> float:
        mansard = self.plan.mansard
        return self.plan.eaves_m if mansard is None else mansard.break_m


def _cut_out(cuts: Sequence[Cut], call: str, rest: str) -> str:
    """The call within what the cuts leave; what they take off is `rest`."""
    text = (
        call if not cuts else f"rotateScope(0, 0, {-sum(cut.turn_deg for cut in cuts):.9g}) {call}"
    )
    for cut in reversed(cuts):
        inside = f"{metres(cut.keep_m)} : {text} | ~1 : {rest}"
        text = f"rotateScope(0, 0, {cut.turn_deg:.9g}) split(x) {{ {inside} }}"
    return text


@cache
def _part(name: str) -> str:
    return (PARTS / f"{name}.cga").read_text(encoding="utf-8")


_ORDER: Sequence[str] = (
    "window", "shaped", "column", "opening", "panel", "reveal", "balcony", "ledge", "mansard",
    "gable", "hip", "dormer", "slope_column", "chimney", "library_railing", "library_door",
    "library_dormer", "library_chimney", "library_cornice", "library_shutter",
    "library_balustrade",
)  # fmt: skip
_COLUMNS = {" Column(": "column", " SlopeColumn(": "slope_column"}

_BODY = """
// ---- building -------------------------------------------------------------------------------

// The lot's first edge lies along the street.
@StartRule
Lot --> t(0, 0, scope.sz - depth) s(width, 0, depth) primitiveQuad() Building

Building --> {inside}

Body -->
    set(material.name, "wall") color(wallColor)
    setupProjection(0, scope.xy, photoWidth, photoHeight, photoLeft, photoFoot)
    extrude(world.up, eaves)
    comp(f) {{ front : Front | right : Blind("right wall") | back : Blind("back wall")
        | left : Blind("left wall") | bottom : Ground | top : {top} }}

// The front's wall goes on around the corners, without its openings.
Blind(name) -->
    set(surface, name) color(1) texture(sidePhoto)
    setupProjection(0, scope.xy, '1, photoHeight, 0, photoFoot) projectUV(0)
    Wall.
Ground --> set(material.name, "ground") set(surface, "footprint") Ground.
"""
_FLAT_ROOF = """
FlatRoof --> set(material.name, "roof") set(surface, "flat roof") color(roofColor) Roof.
"""
_FRONT = """
// ---- front ----------------------------------------------------------------------------------

Front -->
    set(surface, "front wall") set(provenance, "measured") color(1)
    {inside}

Floors --> split(y) {{ {floors} }}
"""
_FRONT_SLOPE = """
FrontSlope -->
    set(surface, "front lower slope") set(provenance, "{said}")
    color(1) texture(wallPhoto) projectUV(0)
    {cut}
"""
_FRONT_GABLE = """
FrontGable -->
    setupProjection(0, scope.xy, photoWidth, photoHeight, photoLeft, photoFoot - eaves)
    set(material.name, "wall") set(surface, "front gable") set(provenance, "measured")
    color(1) texture(wallPhoto) projectUV(0)
    {cut}
"""
_SHOP = """
{rule} -->
    case {deep} > 0 : [ Reveal("{name}", {deep}) ] t(0, 0, -{deep}) {rule}Front
    else : {rule}Front

{rule}Front -->
    set(material.name, "shop") set(surface, "{name}") set(provenance, "{said}")
    {cut}
"""
