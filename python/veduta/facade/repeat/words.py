"""The fixed parts of `rules.cga`: what its rules have in common, whatever the photo shows."""

from __future__ import annotations

HEAD = """/*
 * The building of {photo} as rules: floors and columns repeat and stretch with the lot.
 *
 * On the lot of the photo they give back what was read there (cells.cga has it to the millimetre,
 * with the photo on it). A wider lot has more columns, a larger `height` more floors:
 *
 *     veduta grammar derive {rules} --lots {lot} -o again
 *     veduta grammar derive {rules} --lots {lot} -o higher --attr height=30
 *
 * What has ~ before its size stretches; {{ }}* repeats.
 */
version "2024.0"

import openings : "styles/parts/openings.cga"
import arches : "styles/parts/arches.cga"
import shops : "styles/parts/shops.cga"
import railings : "styles/parts/railings.cga"
import dormers : "styles/parts/dormers.cga"
import roofs : "styles/parts/roofs.cga"

@Group("Size") @Description("from the ground to the highest point (m)") @Range(min=3, max=200)
attr height = {height}

@Group("Size") @Description("height of the ground floor (m)")
attr groundFloor = {ground}

@Group("Size") @Description("the roof: its steep part, what is above it (m), how steep (degrees)")
attr lowerRoof = {lower}
attr upperRoof = {upper}
attr roofAngle = {angle}

@Group("Facade") @Description("how far openings lie back in the wall (m)")
attr setback = {setback}

@Group("Facade") @Description("how far balconies before one window, and long ones, project (m)")
attr shallow = {shallow}
attr deep = {deep}

@Group("Colours") @Color
attr wallColor = "{wall}"

@Group("Colours") @Color
attr roofColor = "{roof}"

@Group("Detail") @Description("0 boxes and roofs, 1 plain panels, 1.5 from afar, 2 all")
@Range(min=0, max=3)
attr LOD = 2

// Where a surface comes from: measured in the photo, inferred from what was, or invented.
@Hidden
attr provenance = "invented"
@Hidden
attr seen = "inferred"

const photoWidth = {width}
const frame = "#eeebe2"
const eaves = height - lowerRoof - upperRoof
"""
WALLS = """
// ---- building -------------------------------------------------------------------------------

// What stands on another lot than that of the photo is inferred from what stands there.
@StartRule
Lot -->
    case abs(scope.sx - photoWidth) < 0.01 : set(seen, "measured") Building
    else : set(seen, "inferred") Building

Building --> color(wallColor) [ Body ] t(0, eaves, 0) Roof

Body -->
    set(material.name, "wall")
    extrude(world.up, eaves)
    comp(f) {{ front : Front | side : Wall. | back : Wall. | top : Gutter | bottom : NIL }}

Front --> {dormers}Floors
Floors --> set(provenance, seen) split(y) {{ {rows} }}
"""
MANSARD = """
Gutter --> set(material.name, "roof") color(roofColor) Roof.
Roof --> roofs.MansardBetween(roofAngle, lowerRoof, upperRoof, roofColor, roofColor, wallColor)
"""
GABLE = """
Gutter --> set(material.name, "roof") color(roofColor) Roof.
Roof -->
    set(material.name, "roof") color(roofColor)
    roofGable(byHeight, upperRoof, 0, 0, false, 0)
    comp(f) { bottom : NIL | vertical : GableWall | all : Roof. }

GableWall --> set(material.name, "wall") color(wallColor) Wall.
"""
HIP = """
Gutter --> set(material.name, "roof") color(roofColor) Roof.
Roof -->
    set(material.name, "roof") color(roofColor)
    roofHip(byHeight, upperRoof)
    comp(f) { bottom : NIL | all : Roof. }
"""
FLAT_ROOF = """
Gutter --> set(material.name, "roof") color(roofColor) Roof.
Roof --> NIL
"""
WINDOWS = """
// ---- columns --------------------------------------------------------------------------------

// At the k-th cell: a window `a` above the floor and `b` high, with an arch of `c`; or a balcony
// from `a` on, `b` high and `c` wider than the window on each side; or a dormer of that size.
Bay(what, before, wide, after, a, b, c, unread, k) -->
    case what == "windows" :
        split(x) { ~before : Wall. | wide : Upright(a, b, c, said(unread, k)) | ~after : Wall. }
    else :
        split(x) {
            ~max(0.01, before - c) : NIL
            | wide + 2 * c : Before(what, a, b)
            | ~max(0.01, after - c) : NIL
        }

Beside(what) -->
    case what == "windows" : Wall.
    else : NIL

// The windows that the photo does not show are as those beside them.
said(unread, k) = case find(unread, " " + str(k) + " ", 0) >= 0 : "inferred" else : seen

Upright(sill, high, rise, said) -->
    split(y) { sill : Wall. | high : set(provenance, said) Window(rise) | ~1 : Wall. }

Window(rise) -->
    case rise > 0.4 * scope.sx : arches.OpeningRound("casement", setback, frame)
    case rise > 0 : arches.OpeningSegmental("casement", setback, frame, rise)
    else : openings.OpeningCasement(setback, frame)
"""
BALCONIES = """
// ---- balconies ------------------------------------------------------------------------------

LongBalcony(foot, high, beside) -->
    split(x) { beside : NIL | ~1 : Balcony(foot, high, deep) | beside : NIL }

Balcony(foot, high, out) -->
    set(provenance, seen) t(0, foot - 0.15, 0) s('1, high + 0.15, 0) Railed(out)

Railed(out) --> split(y) { 0.15 : Slab(out) | ~1 : railings.RailingIron(out) }
Slab(out) --> set(material.name, "balcony") s('1, '1, out) i("builtin/block")
"""
BEFORE = """
// ---- before the wall ------------------------------------------------------------------------

Before(what, a, b) -->
    case what == "dormers" : {dormer}
    else : {balcony}
"""
DORMERS = """
Dormer(up, high) --> t(0, up, 0) s('1, high, 0) dormers.DormerPediment(1.2, wallColor)
"""
GROUND = """
// ---- ground floor ---------------------------------------------------------------------------

GroundBay(kind, before, wide, after, sill, high) -->
    split(x) { ~before : Wall. | ~wide : GroundOpening(kind, sill, high) | ~after : Wall. }

GroundOpening(kind, sill, high) -->
    split(y) { sill : Wall. | high : Opening(kind) | ~1 : Wall. }

Opening(kind) -->
    case kind == "shop" : shops.ShopWood("#4a4640")
    case kind == "door" : openings.OpeningDoor(setback, "#4a3a2c")
    else : openings.OpeningCasement(setback, frame)
"""
