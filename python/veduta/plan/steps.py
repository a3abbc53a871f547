"""The steps from drawings or a document to a house and its tour, each told, timed and counted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from veduta.plan.analyse import read_drawings
from veduta.plan.call import Call
from veduta.plan.document import PlanDocument
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.furnish import furnish
from veduta.plan.house.build import House, build_house
from veduta.plan.house.room_looks import TilePictures
from veduta.plan.idle_options import idle_notes
from veduta.plan.lights.furnished import relit
from veduta.plan.lights.lighting import Lit, light_house
from veduta.plan.options import HouseOptions, PlanOptions
from veduta.plan.pages import Drawing
from veduta.plan.photos.finish import Finished, load_pictures, with_photos
from veduta.plan.photos.given import RoomPhoto
from veduta.plan.sheets import Pixels, load_sheets
from veduta.plan.tour.find import Tour, find_tour, outdoor_notes
from veduta.plan.tour.leaves import with_shut
from veduta.plan.upper_floor import upper_floor
from veduta.run.progress import StepProgress
from veduta.run.report import StepRecord, timed_step


def document_step(
    call: Call,
    given: PlanDocument | list[Drawing],
    options: PlanOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> tuple[PlanDocument, list[Pixels], list[str]]:
    """The document and the cleaned drawings, with what is to be said of them."""
    if not isinstance(given, PlanDocument):
        read = read_drawings(given, options, steps, progress)
        return read.document, read.sheets, []
    progress("load", 0.0)
    with timed_step(steps, "load") as step:
        sheets, notes = load_sheets(call.paths[0].parent, given)
        step.counts["storeys"] = len(given.storeys)
    return given, sheets, [*idle_notes(given, options), *notes]


def finish_step(
    call: Call,
    document: PlanDocument,
    photos: Sequence[RoomPhoto],
    steps: list[StepRecord],
    progress: StepProgress,
    *,
    stays: bool,
) -> Finished:
    """The document with the paint and the tiles that photos show, and the pictures of tiles."""
    before = load_pictures(call.paths[0].parent, document)
    if not photos:
        return before
    progress("photos", 0.0)
    with timed_step(steps, "photos") as step:
        finished = with_photos(before, photos, stays=stays)
        step.counts |= {
            "photos": len(photos),
            "colours": sum(look.colour is not None for look in finished.looks),
            "tiles": sum(len(look.tiles) for look in finished.looks),
        }
        step.rejected.extend(finished.notes)
    return finished


def furnish_step(
    document: PlanDocument,
    catalogue: Catalogue,
    options: HouseOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> PlanDocument:
    """The document with furniture in each storey that has none yet, and the lamps among it."""
    progress("furnish", 0.0)
    with timed_step(steps, "furnish") as step:
        done, rooms = furnish(
            document, catalogue, options.seed, options.slab, varied=options.varied_furniture
        )
        done, lit_anew = relit(document, done, catalogue)
        step.counts |= {"rooms": len(rooms), "things": sum(len(room.stood) for room in rooms)}
        step.rejected.extend(lit_anew)
        step.rejected.extend(
            f"{room.room.id} ({room.room.use}): no place for {', '.join(room.missing)}"
            for room in rooms
            if room.missing
        )
        step.rejected.extend(
            f"{room.room.id} ({room.room.use}): {note}" for room in rooms for note in room.notes
        )
    return done


def light_step(
    document: PlanDocument,
    options: PlanOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> Lit:
    """The document with lamps in each storey that has none yet."""
    progress("lights", 0.0)
    with timed_step(steps, "lights") as step:
        lit = light_house(document, options.house)
        step.counts |= {
            "lamps": sum(len(storey.lights or []) for storey in lit.document.storeys),
            "points_looked_at": lit.points,
            "points_in_the_dark": lit.dark,
        }
        step.rejected.extend(lit.notes)
    return lit


def house_step(
    document: PlanDocument,
    pictures: TilePictures,
    options: HouseOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> House:
    """The house, with the tiles that photos of its rooms show."""
    progress("house", 0.0)
    with timed_step(steps, "house") as step:
        house = build_house(document, options, pictures)
        part = house.part
        step.counts |= {
            "features": len(part.features),
            "polygons": len(part.polygon_feature),
            "triangles": len(part.triangles.indices),
        }
        step.rejected.extend(part.notes)
    return house


def tour_step(
    house: House, options: HouseOptions, steps: list[StepRecord], progress: StepProgress
) -> tuple[Tour | None, House]:
    """The tour, and the house in which the doors are closed that it keeps so.

    There is none where none is wanted, or there is no floor to stand on.
    """
    if options.no_tour:
        return None, house
    progress("tour", 0.0)
    with timed_step(steps, "tour") as step:
        above = upper_floor([space.storey for space in house.spaces]) is not None
        tour = find_tour(
            house, options.tour_speed, indoors=options.flat or options.terraced or above
        )
        if tour is None:
            step.rejected.append("there is no tour: no room has a floor on which one can stand")
            return None, house
        step.counts |= {
            "rooms": len(
                {(one.storey, one.room) for one in tour.stretches if one.room is not None}
            ),
            "metres": round(tour.length_m),
            "seconds": round(float(tour.path.times_s[-1])),
        }
        step.rejected.extend([*tour.notes, *outdoor_notes(tour.stretches)])
    if tour.shut:
        house = replace(house, part=with_shut(house.part, tour.shut))
    return tour, house
