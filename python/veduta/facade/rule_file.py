"""The rule file of a building: `rules.cga`, which the model is derived from and which people edit.

Attributes first, then the rules of this building (its floors, shop fronts and roof), then those
that its parts need, from `parts/*.cga`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from veduta import _core
from veduta.facade.cells import Cell, metres, splits
from veduta.facade.chimneys import FOOT_M
from veduta.facade.document import Element
from veduta.facade.dormers import CHEEK_M, LID_M, LINTEL_M, SILL_M
from veduta.facade.layout import SLAB_M, Opening
from veduta.facade.plan import Band, Plan
from veduta.facade.rectangles import Rectangle
from veduta.facade.textures import FacadeTextures
from veduta.place.material import Colour
from veduta.place.semantics import Provenance

RULES = "rules.cga"
PHOTO_TEXTURE, WALL_TEXTURE = "textures/front.jpg", "textures/wall.jpg"
PARTS = Path(__file__).parent / "parts"
# How far a balcony juts out (m): one before a single window, and one that people stand on.
SHALLOW_M, DEEP_M = 0.30, 0.60
# From this width on, a balcony serves more than one window (m).
WIDE_M = 2.2
RAILING_M = 0.04
# The frame of a window (m).
FRAME_M = 0.06
# What lies in the shade of the wall is this much darker than the wall.
REVEAL_SHADE = 0.9


@dataclass(frozen=True)
class Seen:
    """What the photo shows of a surface; `seen_height_m` where a rule made it reach further down."""

    element: Element
    seen_height_m: float | None = None


@dataclass(frozen=True)
class RuleFile:
    """The text, and what of the surfaces that it names was found in the photo."""

    text: str
    seen: dict[str, Seen]


class _Writer:
    """The rules of one building, as they are written."""

    def __init__(
        self, plan: Plan, textures: FacadeTextures, roof_said: Provenance, photo: str
    ) -> None:
        self.plan = plan
        self.textures = textures
        self.colours = textures.colours
        self.roof_said = roof_said
        self.photo = photo
        self.seen: dict[str, Seen] = {}
        self.counts: Counter[str] = Counter()
        self.parts: set[str] = set()
        self.rules: list[str] = []

    def name(self, opening: Opening, kind: str) -> str:
        """The name of the surface of an element, with the next number of its kind."""
        self.counts[kind] += 1
        name = f"{kind} {self.counts[kind]}"
        self.seen[name] = Seen(opening.element, opening.seen_height_m)
        return name

    def text(self) -> str:
        plan = self.plan
        floors = [self._floor(band) for band in plan.bands]
        lines = " | ".join(f"{attribute} : {rule}" for attribute, rule in floors)
        balconies = "".join(self._balcony(balcony) for balcony in plan.balconies)
        self.rules.insert(
            0,
            _FRONT.format(balconies="[ Balconies ]") + f"Balconies --> {balconies}\n\n"
            if balconies
            else _FRONT.format(balconies=""),
        )
        self.rules.insert(1, _FRONT_WALL.format(floors=lines))
        slope = self._slope()
        chimneys = self._chimneys()
        inside = "[ Body ]" + (" [ t(0, eaves, 0) Roof ]" if plan.mansard else "") + chimneys
        body = _BODY.format(inside=inside, top="NIL" if plan.mansard else "FlatRoof")
        flat = "" if plan.mansard else _FLAT_ROOF
        parts = "\n".join(_part(name) for name in _ORDER if name in self.parts)
        return "\n".join([self._head(), body, flat, *self.rules, slope, parts])

    def _floor(self, band: Band) -> tuple[str, str]:
        """The attribute and the rule of one floor; the rule is added."""
        attribute = "groundFloor" if band.floor == 0 else f"floor{band.floor}"
        rule = attribute[0].upper() + attribute[1:]
        region = Rectangle(0.0, band.foot_m, self.plan.width_m, band.top_m)
        # In the order of the layout, so that the numbers are those of before: shops, doors, windows.
        cells = [Cell(o.rectangle, self.opening(o, "setback")) for o in band.openings]
        self.rules.append(f"{rule} --> {splits(cells, region, 'Wall.')}\n")
        return attribute, rule

    def opening(self, opening: Opening, deep: str) -> str:
        """The call that builds an opening; a shop front with doors gets a rule of its own."""
        kind = opening.element.class_
        name = self.name(opening, kind)
        said = provenance(opening)
        if opening.children:
            self._shop(opening, name, said)
            return _rule_name(name)
        if kind == "window":
            self.parts |= {"window", "panel", "reveal"}
            return f'Window("{name}", "{said}", {deep})'
        self.parts |= {"opening", "panel", "reveal"}
        return f'Opening("{kind}", "{name}", "{said}", {deep})'

    def _shop(self, shop: Opening, name: str, said: Provenance) -> None:
        rule = _rule_name(name)
        inside = [Cell(o.rectangle, self.opening(o, "setback / 2")) for o in shop.children]
        cut = splits(inside, shop.rectangle, "Panel.")
        self.rules.append(_SHOP.format(rule=rule, name=name, said=said, cut=cut))

    def _balcony(self, balcony: Opening) -> str:
        self.parts |= {"balcony"}
        name, place = self.name(balcony, "balcony"), balcony.rectangle
        said = balcony.element.provenance
        sizes = (place.x0, place.z0, place.width, place.height)
        return f'Balcony("{name}", "{said}", {", ".join(map(metres, sizes))})\n'

    def _slope(self) -> str:
        """The front slope with its dormers."""
        mansard = self.plan.mansard
        if mansard is None:
            return ""
        self.parts |= {"mansard"}
        cells = []
        for number, dormer in enumerate(self.plan.dormers, start=1):
            self.parts |= {"dormer", "window", "panel", "reveal"}
            window = self.name(dormer.window, "window")
            said = provenance(dormer.window)
            call = f'Dormer("dormer {number}", "{window}", "{said}")'
            cells.append(Cell(dormer.front, call))
        region = Rectangle(0.0, mansard.eaves_m, mansard.width_m, mansard.break_m)
        cut = splits(cells, region, "Roof.", "up({})")
        return _FRONT_SLOPE.format(said=self.roof_said, cut=cut)

    def _chimneys(self) -> str:
        calls = ""
        for number, chimney in enumerate(self.plan.chimneys, start=1):
            self.parts |= {"chimney"}
            name, place = f"chimney {number}", chimney.front
            self.seen[name] = Seen(chimney.element)
            sizes = (place.x0, place.z0, place.width, place.height, chimney.near_m, chimney.far_m)
            calls += f' [ Chimney("{name}", {", ".join(map(metres, sizes))}) ]'
        return calls

    def _head(self) -> str:
        """What the file is, and all attributes that its rules use."""
        plan, colours = self.plan, self.colours
        floors = "".join(
            f"attr {'groundFloor' if band.floor == 0 else f'floor{band.floor}'}"
            f" = {metres(band.top_m - band.foot_m)}\n"
            for band in plan.bands
        )
        names = ["groundFloor" if band.floor == 0 else f"floor{band.floor}" for band in plan.bands]
        reveal = tuple(REVEAL_SHADE * channel for channel in colours.wall)
        text = _HEAD.format(
            photo=self.photo,
            width=metres(plan.width_m),
            depth=metres(plan.depth_m),
            floors=floors,
            eaves=" + ".join(names),
            photo_width=f"{self.textures.width_m:.7g}",
            photo_height=f"{self.textures.height_m:.7g}",
            photo_left=f"{self.textures.left_m:.6f}",
            photo_foot=f"{self.textures.foot_m:.6f}",
            front=PHOTO_TEXTURE,
            wall=WALL_TEXTURE,
            wall_colour=_hex(colours.wall),
            roof_colour=_hex(colours.roof),
        )
        if "reveal" in self.parts or "balcony" in self.parts:
            text += f'attr revealColor = "{_hex((reveal[0], reveal[1], reveal[2]))}"\n'
        if "reveal" in self.parts:
            text += f"// How far openings lie back in the wall.\nattr setback = {metres(plan.setback_m)}\n"
        if "window" in self.parts:
            text += f"attr frame = {metres(FRAME_M)}\n"
        if plan.mansard is not None:
            text += _ROOF_HEAD.format(
                lower=metres(plan.mansard.lower_m),
                upper=metres(plan.mansard.upper_m),
                angle=f"{plan.mansard.slope_deg:.9g}",
            )
        if "dormer" in self.parts:
            text += _DORMER_HEAD
        if "balcony" in self.parts:
            text += _BALCONY_HEAD.format(colour=_hex(colours.balcony)) + (
                _BEHIND if plan.mansard is not None else _NOT_BEHIND
            )
        if "chimney" in self.parts:
            text += _CHIMNEY_HEAD.format(colour=_hex(colours.chimney))
        return text


def write_rules(
    plan: Plan, textures: FacadeTextures, roof_said: Provenance, photo: str
) -> RuleFile:
    """The rule file of a plan; `photo` is the name of the photo, for the people who read it."""
    writer = _Writer(plan, textures, roof_said, photo)
    text = writer.text()
    return RuleFile(_core.grammar_format(RULES, text), writer.seen)


def provenance(opening: Opening) -> Provenance:
    """That of the element; a size that a rule has added to is inferred, not measured."""
    said = Provenance(opening.element.provenance)
    extended = opening.seen_height_m is not None
    return Provenance.INFERRED if extended and said is Provenance.MEASURED else said


@cache
def _part(name: str) -> str:
    return (PARTS / f"{name}.cga").read_text(encoding="utf-8")


def _rule_name(name: str) -> str:
    """`Shop1` of `shop 1`."""
    return name.title().replace(" ", "")


def _hex(colour: Colour) -> str:
    return "#" + "".join(f"{round(255 * channel):02x}" for channel in colour)


_ORDER: Sequence[str] = (
    "window", "opening", "panel", "reveal", "balcony", "mansard", "dormer", "chimney"
)  # fmt: skip

_HEAD = """/*
 * The building of {photo}, as it was found in the photo. All sizes are metres.
 *
 * Change what you like, and derive it again:
 *
 *     veduta grammar derive rules.cga --lots lot.geojson -o again
 *
 * What has a size of its own keeps it; what has ~ before it takes what is left.
 */
version "2024.0"

attr width = {width}
attr depth = {depth}
{floors}const eaves = {eaves}

// The front as the photo shows it, and without what stands before the wall; both from the ground up.
const photo = "{front}"
const wallPhoto = "{wall}"
const photoWidth = {photo_width}
const photoHeight = {photo_height}
const photoLeft = {photo_left}
const photoFoot = {photo_foot}

attr wallColor = "{wall_colour}"
attr roofColor = "{roof_colour}"

// What a surface is called, which solid beside the body it closes, and where it comes from:
// measured in the photo, inferred from what was measured, or invented.
@Hidden
attr surface = ""
@Hidden
attr solid = ""
@Hidden
attr provenance = "invented"

"""
_ROOF_HEAD = """
// The roof is steep up to an edge, and flat above it.
attr lowerRoof = {lower}
attr upperRoof = {upper}
attr roofAngle = {angle}
const sides = ["front", "right", "back", "left"]
"""
_DORMER_HEAD = f"""
// Around the window of a dormer: beside, below and above it, and the lid over it.
attr cheek = {metres(CHEEK_M)}
attr sill = {metres(SILL_M)}
attr lintel = {metres(LINTEL_M)}
attr lid = {metres(LID_M)}
"""
_BALCONY_HEAD = f"""
// Balconies before one window are shallow, wide ones deep.
attr shallow = {metres(SHALLOW_M)}
attr deep = {metres(DEEP_M)}
attr wideBalcony = {metres(WIDE_M)}
attr railing = {metres(RAILING_M)}
attr slab = {metres(SLAB_M)}
attr railingColor = "{{colour}}"
"""
_BEHIND = """
// How far the roof lies back at this height.
behind(y) =
    case y <= eaves : 0
    else : (min(y + slab - eaves, lowerRoof)) / tan(roofAngle)
"""
_NOT_BEHIND = "const behind(y) = 0\n"
_CHIMNEY_HEAD = f"""
attr chimneyColor = "{{colour}}"
// How far a chimney reaches into the roof.
attr chimneyFoot = {metres(FOOT_M)}
"""
_BODY = """
// ---- building -------------------------------------------------------------------------------

// The lot's first edge lies along the street.
@StartRule
Lot --> t(0, 0, scope.sz - depth) primitiveQuad(width, depth) Building

Building --> {inside}

Body -->
    set(material.name, "wall") color(wallColor)
    setupProjection(0, scope.xy, photoWidth, photoHeight, photoLeft, photoFoot)
    extrude(world.up, eaves)
    comp(f) {{ front : Front | right : Blind("right wall") | back : Blind("back wall") | left : Blind("left wall") | bottom : Ground | top : {top} }}

Blind(name) --> set(surface, name) Wall.
Ground --> set(material.name, "ground") set(surface, "footprint") Ground.
"""
_FLAT_ROOF = """
FlatRoof --> set(material.name, "roof") set(surface, "flat roof") color(roofColor) Roof.
"""
_FRONT = """
// ---- front ----------------------------------------------------------------------------------

Front --> set(surface, "front wall") set(provenance, "measured") {balconies} FrontWall

"""
_FRONT_WALL = """
FrontWall -->
    color(1) texture(wallPhoto) projectUV(0)
    split(y) {{ {floors} }}
"""
_FRONT_SLOPE = """
FrontSlope -->
    set(surface, "front lower slope") set(provenance, "{said}")
    color(1) texture(wallPhoto) projectUV(0)
    {cut}
"""
_SHOP = """
{rule} -->
    case setback > 0 : [ Reveal("{name}", setback) ] t(0, 0, -setback) {rule}Front
    else : {rule}Front

{rule}Front -->
    set(material.name, "shop") set(surface, "{name}") set(provenance, "{said}")
    {cut}
"""
