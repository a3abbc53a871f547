"""A house in a row: party walls to its neighbours, closed, and a roof that goes on over them.

Where the sheet says so, or `--terraced`; or where two opposite sides are blank and drawn much
thicker than the others. Which walls are party walls stands in the document (`Wall.party`).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import PlanDocument, Storey, Text, Wall
from veduta.plan.flats import SURE, with_doubt
from veduta.plan.options import HouseOptions

Kind = Literal["mid", "end"]
_THICK = "two sides across from each other are blank, and drawn much thicker than the others"
_END = re.compile(
    r"\b(?:end[\s-]*(?:of[\s-]*)?terraced?|semi[\s-]*detached|reihenend\w*|reiheneck\w*"
    r"|doppelhaush[aä]lfte|hoekwoning|twee[\s-]onder[\s-][eé]+n[\s-]kap|parhus|paritalo)\b",
    re.IGNORECASE,
)
_MID = re.compile(
    r"\b(?:(?:mid[\s-]*)?terraced?\s+(?:house|home|cottage)|mid[\s-]*terraced?|town\s?house"
    r"|row\s?house|party\s+walls?|reihen(?:mittel)?haus|rijtjes(?:huis|woning)|rijwoning"
    r"|tussenwoning|radhus|rivitalo|villetta\s+a\s+schiera|casa\s+a\s+schiera|chalet\s+adosado"
    r"|(?:casa|vivienda)\s+adosada|maison\s+mitoyenne|murs?\s+mitoyens?|brandwand)\b",
    re.IGNORECASE,
)
_WORDS: tuple[tuple[Kind, re.Pattern[str]], ...] = (("end", _END), ("mid", _MID))
_NOT_AFTER = re.compile(
    r"\b(?:roof|garden|sun|patio|pool|deck|balcony|dach|garten)[\s-]*$", re.IGNORECASE
)
"""What makes of the next word a terrace to sit on."""
_NOT_BEFORE = re.compile(
    r"^[\s-]*(?:(?:single|double|triple)[\s-]+)?"
    r"(?:garages?|car[\s-]?ports?|outbuilding|shed|store|office|studio|cinema|gym)\b",
    re.IGNORECASE,
)
"""And of the last words another thing than a house."""


@dataclass(frozen=True)
class TerraceRules:
    """What a party wall is drawn like. A terrace's long sides are blank; the thick rule is strict,
    for nothing is written: a wall of two leaves and a gap has 25 cm and more.
    """

    parallel_deg: float = 8.0
    """A wall of a side may lie so much askew to it."""
    within_m: float = 0.6
    """And so far behind its farthest."""
    least_share: float = 0.5
    """Of a side's width that its walls must have to be a party wall."""
    thicker: float = 1.4
    """Times as thick as the other outer walls, both, where nothing is written."""
    thick_m: float = 0.25
    long_share: float = 0.6
    """Of a side's width, where nothing is written: one is shorter beside a rear extension."""


RULES = TerraceRules()


@dataclass(frozen=True)
class Side:
    """A side of a storey: its way out (2,), its walls, how long they are, and which share of the
    side's width.
    """

    out: NDArray[np.float64]
    walls: tuple[str, ...]
    openings: tuple[str, ...]
    length_m: float
    share: float
    thickness_m: float


def terrace_named(texts: Iterable[Text]) -> tuple[Kind, str] | None:
    """What a sheet says by which it shows a house in a row, and which; None where it does not."""
    sure = [one.text for one in texts if one.score >= SURE]
    for kind, words in _WORDS:
        for text in sure:
            if _says(words, text):
                return kind, text
    return None


def _says(words: re.Pattern[str], text: str) -> bool:
    """Whether a text has these words, and they are of a house there."""
    return any(
        not _NOT_AFTER.search(text[: found.start()]) and not _NOT_BEFORE.match(text[found.end() :])
        for found in words.finditer(text)
    )


def with_terrace(document: PlanDocument, options: HouseOptions, *, by_text: bool) -> PlanDocument:
    """The document with its party walls, closed: by the option, or (by_text) by its sheets.

    What they say is a doubt, and so is what is closed. A document that has party walls keeps them.
    """
    if document.flat or is_terraced(document):
        return document
    storeys = document.storeys
    axis = axis_of(storeys[0])
    sides = [sides_of(storey, axis) for storey in storeys]
    rows, why = _decided(document, sides, options, by_text=by_text)
    doubts = []
    if rows:
        document = document.model_copy(
            update={
                "storeys": [
                    _with_party(storey, own, rows)
                    for storey, own in zip(storeys, sides, strict=True)
                ]
            }
        )
        doubts = _doubts(storeys, sides, rows, why)
    elif why:
        doubts = [
            f"{why}, but no side is a straight wall without windows and doors: it stands alone."
        ]
    elif options.neighbours:
        doubts = ["--neighbours: nothing says that it stands in a row, so there are none."]
    for doubt in doubts:
        document = with_doubt(document, doubt)
    return document


def _decided(
    document: PlanDocument, sides: Sequence[Sequence[Side]], options: HouseOptions, *, by_text: bool
) -> tuple[tuple[int, ...], str]:
    """The party sides, and why; no sides where none can be, no reason where nobody asks."""
    # "End terrace" may be the name of a garden's terrace that was found.
    rooms = {room.name.lower() for one in document.storeys for room in one.rooms if room.name}
    said = terrace_named(
        text
        for storey in document.storeys
        for text in storey.texts
        if text.text.strip().lower() not in rooms
    )
    if options.terraced:
        return party_rows(sides, "mid" if said is None else said[0], closed=True), "--terraced"
    if not by_text:
        return (), ""
    if said is not None:
        return party_rows(sides, said[0], closed=False), f"{said[1]!r} is on the sheet"
    rows = thick_rows(sides)
    return rows, _THICK if rows else ""


def _doubts(
    storeys: Sequence[Storey], sides: Sequence[Sequence[Side]], rows: Sequence[int], why: str
) -> list[str]:
    """What is to be said of party walls: why they are such, unless that was asked, and what is
    closed.
    """
    names = " and ".join(_name(sides[0][row].out) for row in rows)
    doubts = []
    if why != "--terraced":
        doubts.append(
            f"taken for a house in a row, with party walls at the {names} of the page, as {why}."
        )
    # Openings of two storeys may have one name.
    closed = [
        f"{name} of {storey.name}" if len(storeys) > 1 else name
        for storey, own in zip(storeys, sides, strict=True)
        for row in rows
        for name in own[row].openings
    ]
    if closed:
        doubts.append(
            f"closed in party walls at the {names} of the page: {', '.join(closed)}. If there are"
            " windows, no neighbour is there: give the plan without --terraced, and set party of"
            " the walls to neighbours in plan.json."
        )
    return doubts


def is_terraced(document: PlanDocument) -> bool:
    """Whether any of its walls is a neighbour's, too."""
    return any(wall.party for storey in document.storeys for wall in storey.walls)


def terrace_options(document: PlanDocument, options: HouseOptions) -> HouseOptions:
    """The options by which a house in a row is built; those of others as they are."""
    if not is_terraced(document):
        return options
    roof = "gable" if options.roof == "auto" else options.roof
    return options.model_copy(update={"terraced": True, "roof": roof})


def axis_of(storey: Storey) -> float:
    """The direction (rad, within a right angle) in which its outer walls run."""
    at = {one.id: np.array(one.at_m) for one in storey.junctions}
    total = 0j
    for wall in storey.walls:
        x, y = at[wall.end] - at[wall.start]
        if wall.outer and wall.bulge == 0.0:
            total += np.hypot(x, y) * np.exp(4j * np.arctan2(y, x))
    return float(np.angle(total) / 4.0) if abs(total) > 0.0 else 0.0


def sides_of(storey: Storey, axis_rad: float, rules: TerraceRules = RULES) -> list[Side]:
    """Its four sides, the first towards the axis, then counter-clockwise."""
    at = {one.id: np.array(one.at_m) for one in storey.junctions}
    outer = [wall for wall in storey.walls if wall.outer and wall.bulge == 0.0]
    ends = np.array([at[name] for wall in outer for name in (wall.start, wall.end)]).reshape(-1, 2)
    found = []
    for turn in range(4):
        angle = axis_rad + turn * np.pi / 2.0
        out = np.array([np.cos(angle), np.sin(angle)])
        if not outer:
            found.append(Side(out, (), (), 0.0, 0.0, 0.0))
            continue
        far = float((ends @ out).max())
        width = float(np.ptp(ends @ np.array([-out[1], out[0]])))
        own = [wall for wall in outer if _is_of(wall, at, out, far, rules)]
        long_m = [float(np.linalg.norm(at[wall.end] - at[wall.start])) for wall in own]
        names = {wall.id for wall in own}
        thick = sum(wall.thickness_m * long for wall, long in zip(own, long_m, strict=True))
        thickness = thick / max(sum(long_m), 1e-9)
        openings = tuple(one.id for one in storey.openings if one.wall in names)
        length = sum(long_m)
        share = length / max(width, 1e-9)
        found.append(Side(out, tuple(sorted(names)), openings, length, share, thickness))
    return found


def _is_of(
    wall: Wall,
    at: dict[str, NDArray[np.float64]],
    out: NDArray[np.float64],
    far: float,
    rules: TerraceRules,
) -> bool:
    """Whether an outer wall runs along the side whose walls lie `far` out."""
    way = at[wall.end] - at[wall.start]
    length = float(np.linalg.norm(way))
    if length < 1e-6 or abs(way @ out) > length * np.sin(np.deg2rad(rules.parallel_deg)):
        return False
    return bool(far - 0.5 * (at[wall.start] + at[wall.end]) @ out <= rules.within_m)


def party_rows(
    sides: Sequence[Sequence[Side]], kind: Kind, *, closed: bool, rules: TerraceRules = RULES
) -> tuple[int, ...]:
    """The sides that are party walls: two across from each other, of an end one.

    sides: of each storey. closed: sides with windows count, too, those with fewest first; else they
    are none.
    """
    count = [sum(len(storey[row].openings) for storey in sides) for row in range(4)]
    fit = [
        sides[0][row].share >= rules.least_share and (closed or count[row] == 0) for row in range(4)
    ]
    found: list[tuple[int, ...]] = [(row,) for row in range(4) if fit[row]]
    pairs: list[tuple[int, ...]] = [(row, row + 2) for row in range(2) if fit[row] and fit[row + 2]]
    if kind == "mid" and (pairs or closed):
        found = pairs

    def order(own: tuple[int, ...]) -> tuple[float, float]:
        return sum(count[row] for row in own), -sum(sides[0][row].length_m for row in own)

    return min(found, key=order, default=())


def thick_rows(sides: Sequence[Sequence[Side]], rules: TerraceRules = RULES) -> tuple[int, ...]:
    """Two sides across from each other that are whole and drawn much thicker on the lowest storey,
    and blank on all; else none. sides: of each storey.
    """
    lowest = sides[0]
    for row in range(2):
        pair = [lowest[row], lowest[row + 2]]
        others = [lowest[row + 1].thickness_m, lowest[(row + 3) % 4].thickness_m]
        usual = max(others)
        blank = not any(storey[own].openings for storey in sides for own in (row, row + 2))
        if (
            blank
            and usual > 0.0
            and all(
                side.share >= rules.long_share
                and side.thickness_m >= max(rules.thick_m, rules.thicker * usual)
                for side in pair
            )
        ):
            return (row, row + 2)
    return ()


def _with_party(storey: Storey, sides: Sequence[Side], rows: Sequence[int]) -> Storey:
    """The storey with walls of these sides marked, and their openings closed, which is noted."""
    names = {name for row in rows for name in sides[row].walls}
    gone = {name for row in rows for name in sides[row].openings}
    walls = [wall.model_copy(update={"party": wall.id in names}) for wall in storey.walls]
    openings = [one for one in storey.openings if one.id not in gone]
    rooms = [
        room.model_copy(update={"openings": [one for one in room.openings if one not in gone]})
        for room in storey.rooms
    ]
    notes = [*storey.notes]
    if gone:
        notes.append(f"closed, as they are in party walls: {', '.join(sorted(gone))}")
    changes = {"walls": walls, "openings": openings, "rooms": rooms, "notes": notes}
    return storey.model_copy(update=changes)


def _name(out: NDArray[np.float64]) -> str:
    """Where on the page a side is."""
    words = ("right", "top", "left", "bottom")
    return words[round(float(np.arctan2(out[1], out[0])) / (np.pi / 2.0)) % 4]
