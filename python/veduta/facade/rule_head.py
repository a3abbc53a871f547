"""The head of a building's rule file: what it is, and all attributes that its rules use."""

from __future__ import annotations

from collections.abc import Set

from veduta.facade.cells import metres
from veduta.facade.chimneys import FOOT_M
from veduta.facade.dormers import CHEEK_M, LID_M, LINTEL_M, SILL_M
from veduta.facade.layout import SLAB_M
from veduta.facade.plan import Band, Plan
from veduta.facade.textures import Colours, FacadeTextures
from veduta.place.material import Colour

CELLS, RULES, LOT = "cells.cga", "rules.cga", "lot.geojson"
PHOTO_TEXTURE, WALL_TEXTURE = "textures/front.jpg", "textures/wall.jpg"
SIDE_TEXTURE = "textures/side.jpg"
# How far a balcony juts out (m): one before a single window, and one that people stand on.
SHALLOW_M, DEEP_M = 0.30, 0.60
# From this width on, a balcony serves more than one window (m).
WIDE_M = 2.2
RAILING_M = 0.04
# The frame of a window (m).
FRAME_M = 0.06
# What lies in the shade of the wall is this much darker than the wall.
REVEAL_SHADE = 0.9


def floor_attribute(band: Band) -> str:
    """The attribute that has the height of a floor."""
    return "groundFloor" if band.floor == 0 else f"floor{band.floor}"


def floor_foot(band: Band) -> str:
    """The constant that has the height of a floor's foot over the ground."""
    return "0" if band.floor == 0 else f"foot{band.floor}"


def rule_head(plan: Plan, textures: FacadeTextures, photo: str, parts: Set[str]) -> str:
    """The comment and the attributes; `parts` are those of `parts/*.cga` that the file has."""
    text = _HEAD.format(
        photo=photo.replace("*/", "* /"),
        lot=LOT,
        rules=CELLS,
        imports=_imports(parts),
        width=metres(plan.width_m),
        depth=metres(plan.depth_m),
        floors="".join(
            f"attr {floor_attribute(band)} = {metres(band.top_m - band.foot_m)}\n"
            for band in plan.bands
        ),
        feet=_feet(plan),
        front=PHOTO_TEXTURE,
        wall=WALL_TEXTURE,
        side=SIDE_TEXTURE,
        photo_width=f"{textures.width_m:.7g}",
        photo_height=f"{textures.height_m:.7g}",
        photo_left=_small(textures.left_m),
        photo_foot=_small(textures.foot_m),
    )
    text += _colours(textures.colours, parts)
    text += _library(plan, textures.colours, parts)
    if "reveal" in parts:
        text += _RECESS.format(setback=metres(plan.setback_m))
    if "window" in parts:
        text += _WINDOW
    if plan.mansard is not None:
        text += _ROOF.format(
            lower=metres(plan.mansard.lower_m),
            upper=metres(plan.mansard.upper_m),
            angle=f"{plan.mansard.slope_deg:.9g}",
        )
    if plan.gable is not None:
        text += (
            f"\n// The roof, from the eaves up.\nattr gableHeight = {metres(plan.gable.height_m)}\n"
        )
    if "dormer" in parts:
        text += _DORMER
    if "balcony" in parts:
        text += _BALCONY + (_ON_THE_WALL if plan.mansard is None else _ON_THE_ROOF)
    if "chimney" in parts:
        edge = "eaves" if plan.mansard is None else "eaves + lowerRoof"
        text += _CHIMNEY.format(edge=edge)
    return text


IMPORTS = {
    "library_railing": "railings",
    "library_door": "doors",
    "library_dormer": "dormers",
    "library_cornice": "mouldings",
    "library_shutter": "shutters",
    "library_balustrade": "railings",
}
"""What the parts that take things of the asset library import, of `styles/parts`."""


def _imports(parts: Set[str]) -> str:
    names = dict.fromkeys(name for part, name in IMPORTS.items() if part in parts)
    return "".join(f'import {name} : "styles/parts/{name}.cga"\n' for name in names)


def _library(plan: Plan, colours: Colours, parts: Set[str]) -> str:
    """The attributes of what may come from the asset library."""
    if not any(part.startswith("library") for part in parts):
        return ""
    text = _LIBRARY.format(library=str(plan.library).lower())
    if "library_railing" in parts:
        text += f'attr railingKind = "{colours.railing_kind}"\n'
    return text


def _feet(plan: Plan) -> str:
    """The constants that have the heights of the feet of the floors, and of the eaves."""
    names = [*map(floor_foot, plan.bands[1:]), "eaves"]
    text, before = "", ""
    for band, name in zip(plan.bands, names, strict=True):
        text += f"const {name} = {before}{floor_attribute(band)}\n"
        before = f"{name} + "
    return text


def _colours(colours: Colours, parts: Set[str]) -> str:
    red, green, blue = (REVEAL_SHADE * channel for channel in colours.wall)
    named = {"wallColor": colours.wall, "roofColor": colours.roof}
    if parts & {"reveal", "balcony"}:
        named["revealColor"] = (red, green, blue)
    if "balcony" in parts:
        named["railingColor"] = colours.balcony
    if "chimney" in parts:
        named["chimneyColor"] = colours.chimney
    if "library_door" in parts:
        named["doorColor"] = colours.door
    if "library_dormer" in parts:
        named["dormerColor"] = colours.wall
    return "".join(f'attr {name} = "{hex_colour(colour)}"\n' for name, colour in named.items())


def hex_colour(colour: Colour) -> str:
    """An sRGB colour (0 to 1) as rule files have it."""
    return "#" + "".join(f"{round(255 * channel):02x}" for channel in colour)


def _small(value_m: float) -> str:
    """A length of less than a pixel."""
    return f"{round(value_m, 6) + 0.0:.6g}"


_HEAD = """/*
 * The building of {photo}, as it was found in the photo. All sizes are metres.
 *
 * Change what you like, and derive it again in this folder:
 *
 *     veduta grammar derive {rules} --lots {lot} -o again
 *
 * What has a size of its own keeps it; what has ~ before it takes what is left.
 */
version "2024.0"
{imports}
attr width = {width}
attr depth = {depth}
{floors}
// Where floors and roof begin, over the ground.
{feet}
// What a surface is called, which solid beside the body it closes, and where it comes from:
// measured in the photo, inferred from what was measured, or invented.
@Hidden
attr surface = ""
@Hidden
attr solid = ""
@Hidden
attr provenance = "invented"
// Where the depth of a recess or a balcony comes from: inferred, or measured in a depth map.
@Hidden
attr depthFrom = "inferred"

// The front as the photo shows it, and without what stands before the wall. Both begin so far left
// of the front and below it. The third is the wall alone, as it is at each height.
const photo = "{front}"
const wallPhoto = "{wall}"
const sidePhoto = "{side}"
const photoWidth = {photo_width}
const photoHeight = {photo_height}
const photoLeft = {photo_left}
const photoFoot = {photo_foot}

// Of what the photo does not show.
"""
_LIBRARY = """
// Railings, door leaves, dormers, cornices and chimneys: things of the asset library, or what the
// photo shows of them on plain boxes.
attr library = {library}
@Range(min=0, max=3)
attr LOD = 2
"""
_RECESS = """
// How far openings lie back in the wall.
attr setback = {setback}
"""
_WINDOW = f"""
// The frame of a window.
attr frame = {metres(FRAME_M)}
"""
_ROOF = """
// The roof is steep up to an edge, and flat above it.
attr lowerRoof = {lower}
attr upperRoof = {upper}
attr roofAngle = {angle}
const sides = ["front", "right", "back", "left"]
"""
_DORMER = f"""
// Around the window of a dormer: beside, below and above it, and the lid over it.
attr cheek = {metres(CHEEK_M)}
attr sill = {metres(SILL_M)}
attr lintel = {metres(LINTEL_M)}
attr lid = {metres(LID_M)}
"""
_BALCONY = f"""
// Balconies before one window are shallow, wide ones deep.
attr shallow = {metres(SHALLOW_M)}
attr deep = {metres(DEEP_M)}
attr wideBalcony = {metres(WIDE_M)}
attr railing = {metres(RAILING_M)}
attr slab = {metres(SLAB_M)}
"""
_ON_THE_ROOF = """
// How far the roof lies back at this height.
behind(y) = case y <= eaves : 0 else : min(y + slab - eaves, lowerRoof) / tan(roofAngle)
"""
_ON_THE_WALL = "behind(y) = 0\n"
_CHIMNEY = f"""
// Chimneys stand on this edge of the roof, and reach so far down into it.
const roofEdge = {{edge}}
attr chimneyFoot = {metres(FOOT_M)}
"""
