"""What `report.json` and `report.html` say of a plan and its house."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.encode import jpeg_bytes
from veduta.plan.document import PlanDocument, Storey, Tiling, WallColour
from veduta.plan.doubts import DOUBTFUL
from veduta.plan.house.finishes import hex_of
from veduta.plan.pages import drawing_label
from veduta.plan.sheets import sheet_name
from veduta.plan.writing import TOUR_PICTURE, Result
from veduta.run.options import Options
from veduta.run.page import Bars, Page, Picture, Table, render
from veduta.run.report import Report, StepRecord, counted

FILES = (
    ("plan.json", "everything that was found, in metres; edit it and rebuild"),
    ("tiles-1.png", "the first texture of tiles by a photo of a room, and so on"),
    ("overlay.png", "what was found, over the cleaned drawing, with the ids of the openings"),
    ("plan.svg", "the plan as a drawing"),
    ("plan.dxf", "the plan for CAD software, a layer for walls, doors, windows, rooms, furniture"),
    (
        "house.ifc",
        "the house for BIM software (IFC4): walls, doors, windows, spaces, furniture, lamps",
    ),
    ("house.city.json", "the house as CityJSON 2.0: shell, storeys, rooms, stairs, furniture"),
    ("house.glb", "the house as glTF 2.0, an animation for each leaf of a door and for the tour"),
    ("house.x3d", "the house as X3D 4.0: doors that open, lamps that switch on, views of rooms"),
    ("tileset.json", "the house as 3D Tiles 1.1, its tiles in `tiles/`"),
    ("ground.glb", "the ground around it: lawn, paths, a drive to the garage"),
    ("garden.glb", "what grows there"),
    ("panorama.glb", "what is seen around it, where a panorama was given"),
    ("panorama.jpg", "its picture, for a rebuild; or panorama-north.jpg and so on"),
    ("place.json", "the house as a place with its tour, for `veduta view`"),
    ("tour.png", "the plan with the way of the tour"),
    ("sheet-1.png", "the cleaned drawing of the first storey, and so on"),
)
THUMBNAIL_PX = 1200
_BASIS = {
    "evidence": "by what is written and drawn on the sheet",
    "given": "as given",
    "assumed": "assumed: nothing on the sheet says it",
    "edited": "as edited",
}


def measures(document: PlanDocument) -> dict[str, Any]:
    """The plan in numbers."""
    storeys = document.storeys
    openings = [opening for storey in storeys for opening in storey.openings]
    rooms = [room for storey in storeys for room in storey.rooms]
    inner = [room for room in rooms if not (room.outdoors or room.open_below)]
    doubtful = Counter(opening.kind for opening in openings if opening.score < DOUBTFUL)
    return {
        "storeys": len(storeys),
        "walls": sum(len(storey.walls) for storey in storeys),
        "rooms": len(rooms),
        "doors": sum(opening.kind == "door" for opening in openings),
        "windows": sum(opening.kind == "window" for opening in openings),
        "gaps": sum(opening.kind == "gap" for opening in openings),
        "stairs": sum(len(storey.stairs) for storey in storeys),
        "painted_rooms": sum(room.wall_colour is not None for room in rooms),
        "tilings": sum(len(room.tilings) for room in rooms),
        "furniture": sum(len(storey.furniture or ()) for storey in storeys),
        "doubtful_openings": doubtful.total(),
        "doubtful_doors": doubtful["door"],
        "doubtful_windows": doubtful["window"],
        "doubtful_gaps": doubtful["gap"],
        "mended_rooms": sum(room.mended for room in rooms),
        "area_m2": round(sum(room.area_m2 for room in inner), 2),
        "scale_basis": [storey.scale.basis for storey in storeys],
        "scale_sigma": [storey.scale.sigma for storey in storeys],
    }


def summary_line(found: dict[str, Any]) -> str:
    """What was found, in a line."""
    parts = [
        counted(found["storeys"], "storey"),
        counted(found["rooms"], "room"),
        f"{found['area_m2']:.1f} m²",
        _openings_found(found, "door"),
        _openings_found(found, "window"),
        *([_openings_found(found, "gap")] if found["gaps"] else []),
    ]
    scale = "; the scale is assumed" if "assumed" in found["scale_basis"] else ""
    return ", ".join(parts) + scale


def _openings_found(found: dict[str, Any], kind: str) -> str:
    doubtful = found[f"doubtful_{kind}s"]
    return counted(found[f"{kind}s"], kind) + (f" ({doubtful} doubtful)" if doubtful else "")


def plan_report(
    result: Result,
    subject: str,
    options: Options,
    steps: list[StepRecord],
    notes: Sequence[str],
    doubts: Sequence[str] = (),
) -> tuple[Report, bytes]:
    """The report of a plan that became a house, and its page."""
    document, part = result.document, result.house.part
    # Of a house of one storey doubts are without its name: they would be said twice.
    storey_notes = [
        f"{s.name}: {note}" for s in document.storeys for note in s.notes if note not in doubts
    ]
    tour_notes = () if result.tour is None else result.tour.notes
    said = dict.fromkeys(
        [*doubts, *notes, *document.notes, *storey_notes, *part.notes, *tour_notes]
    )
    found = measures(document)
    report = Report(
        verb="plan",
        subject=subject,
        state="done",
        options=options.model_dump(mode="json"),
        steps=steps,
        measures=found | result.site.measures(),
        notes=list(said),
    )
    page = Page(
        title=subject,
        summary=summary_line(found),
        facts=_facts(result, found),
        doubts=doubts,
        pictures=_pictures(result),
        tables=[
            *(_rooms(storey) for storey in document.storeys),
            *(table for storey in document.storeys for table in _finishes(storey)),
            *(_openings(storey) for storey in document.storeys),
            *(table for storey in document.storeys for table in _furniture(storey)),
            *(table for storey in document.storeys for table in _evidence(storey)),
            _provenance(result),
        ],
        bars=[Bars("Time per step", "s", [(step.name, step.seconds) for step in steps])],
        files=FILES,
    )
    return report, render(report, page)


def _facts(result: Result, found: dict[str, Any]) -> list[tuple[str, str]]:
    facts = [
        ("rooms", str(found["rooms"])),
        ("area", f"{found['area_m2']:.1f} m² without balconies and terraces"),
    ]
    facts += result.site.facts()
    for storey in result.document.storeys:
        scale = storey.scale
        size = f"{1000 * scale.metres_per_px:.2f} mm/px ± {100 * scale.sigma:.1f} %"
        facts.append((f"scale, {storey.name}", f"{size}, {_BASIS[scale.basis]}"))
    return facts


def _pictures(result: Result) -> list[Picture]:
    found = "Walls, doors, windows and rooms over the drawing. A question mark: doubtful."
    pictures = [_picture("Found", found, result.overlay, "overlay.png", wide=True)]
    if result.tour_picture is not None:
        way = "From blue to red. Thin lines: where one looks. Numbers: the order of the rooms."
        pictures.append(_picture("Tour", way, result.tour_picture, TOUR_PICTURE))
    for look in result.looks:
        pictures.append(
            Picture(
                f"Photo of {look.photo.room}",
                f"{look.photo.path.name}: red: tiles that were found; yellow: their texture",
                jpeg_bytes(look.picture, 88),
                "image/jpeg",
            )
        )
    for index, (storey, pixels) in enumerate(
        zip(result.document.storeys, result.sheets, strict=True)
    ):
        note = f"{drawing_label(storey.sheet.file, storey.sheet.page)}, laid straight"
        pictures.append(_picture(f"Drawing: {storey.name}", note, pixels, sheet_name(index)))
    return pictures


def _picture(
    title: str, note: str, pixels: NDArray[np.uint8], link: str, *, wide: bool = False
) -> Picture:
    image = Image.fromarray(pixels)
    image.thumbnail((THUMBNAIL_PX, THUMBNAIL_PX))
    return Picture(title, note, jpeg_bytes(image, 88), "image/jpeg", link, wide)


def _rooms(storey: Storey) -> Table:
    rows = [
        (
            room.id, room.name, room.use, round(room.use_score, 2), round(room.area_m2, 2),
            len(room.openings), "yes" if room.mended else "", room.origin,
        )
        for room in storey.rooms
    ]  # fmt: skip
    columns = ("id", "written", "use", "sure", "area m²", "openings", "mended", "origin")
    note = "Sure: how far the use can be trusted, 0 to 1. Mended: a gap in its walls was closed."
    return Table(f"Rooms of {storey.name}", columns, rows, note=note)


def _openings(storey: Storey) -> Table:
    rows = [
        (
            opening.id, opening.kind, opening.type, opening.wall, round(opening.width_m, 2),
            opening.hinge, opening.swing, round(opening.score, 2), opening.origin,
        )
        for opening in storey.openings
    ]  # fmt: skip
    columns = ("id", "kind", "type", "wall", "width m", "hinge", "swing", "score", "origin")
    return Table(f"Openings of {storey.name}", columns, rows)


def _finishes(storey: Storey) -> list[Table]:
    """What photos, or who edited the document, say of walls and floors."""
    rows: list[tuple[str, ...]] = []
    for room in storey.rooms:
        name, colour = room.name or room.use, room.wall_colour
        if colour is not None:
            told = f"#{hex_of(colour)}"
            rows.append((room.id, name, "wall", f"paint {told}", colour.origin, _file_of(colour)))
        for tiling in room.tilings:
            width, height = tiling.size_m
            told = f"tiles {100 * width:g} x {100 * height:g} cm ({tiling.size_origin})"
            told += "" if tiling.laid else ", not laid"
            rows.append((room.id, name, tiling.surface, told, tiling.origin, _file_of(tiling)))
    columns = ("room", "name", "surface", "finish", "origin", "photo")
    return [Table(f"Finishes of {storey.name}", columns, rows)] if rows else []


def _file_of(finish: WallColour | Tiling) -> str:
    return "" if finish.photo is None else finish.photo.file


def _furniture(storey: Storey) -> list[Table]:
    """What stands in each room; all of it is invented, unless it was edited."""
    if not storey.furniture:
        return []
    things: defaultdict[str, Counter[str]] = defaultdict(Counter)
    for thing in storey.furniture:
        things[thing.room][thing.object] += 1
    rows = [
        (
            room.id, room.name or room.use, sum(things[room.id].values()),
            ", ".join(f"{n} {name}" if n > 1 else name for name, n in things[room.id].items()),
        )
        for room in storey.rooms
        if room.id in things
    ]  # fmt: skip
    return [Table(f"Furniture of {storey.name}", ("room", "use", "things", "objects"), rows)]


def _evidence(storey: Storey) -> list[Table]:
    if not storey.scale.evidence:
        return []
    rows = [
        (
            one.kind, one.text, round(1000 * one.metres_per_px, 3), round(100 * one.sigma, 1),
            "yes" if one.agrees else "no",
        )
        for one in storey.scale.evidence
    ]  # fmt: skip
    columns = ("evidence", "read", "mm per pixel", "± %", "agrees")
    return [Table(f"The scale of {storey.name}", columns, rows)]


def _provenance(result: Result) -> Table:
    part = result.house.part
    count: Counter[tuple[str, str]] = Counter()
    area: defaultdict[tuple[str, str], float] = defaultdict(float)
    for row in range(len(part.features)):
        key = (part.features.semantic(row).value, part.features.provenance(row).value)
        count[key] += 1
        area[key] += float(part.feature_area_m2[row])
    rows = [(*key, count[key], round(area[key], 1)) for key in sorted(count)]
    note = (
        "measured: drawn on the plan; inferred: follows from it (no plan shows heights);"
        " invented: nothing shows it"
    )
    columns = ("surface", "provenance", "features", "area m²")
    return Table("Where the surfaces come from", columns, rows, note=note)
