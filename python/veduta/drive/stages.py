"""The segments of a drive one after the other: of each only what others need stays in memory.

What is made of a segment is on disk as soon as it is made, so that a killed run goes on from there.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import TypeVar

from pydantic import JsonValue

from veduta.drive.build.backdrop import backdrop_of
from veduta.drive.build.beside import others_beside, points_beside
from veduta.drive.build.near_images import NearImages
from veduta.drive.build.outcome import Outcome, outcome_of
from veduta.drive.build.pictures import (
    atlas_picture,
    depth_picture,
    histogram_picture,
    object_picture,
    source_picture,
)
from veduta.drive.build.pictures_of import Around, Seen
from veduta.drive.build.segment import Geometry, Textured, frame_of, reconstruct, texture
from veduta.drive.build.solid import solid_below
from veduta.drive.document.model import DriveSegment
from veduta.drive.kept import load_result, save_result
from veduta.drive.options import DriveOptions
from veduta.drive.record import DriveRecord
from veduta.run.errors import NotFoundError
from veduta.run.threads import available_cores
from veduta.run.work import Work

_IDLE_S = 0.5
Item = TypeVar("Item")
Made = TypeVar("Made")


@dataclass(frozen=True)
class StageParameters:
    """most_taken_out: points of the whole drive that are shown as taken out; `points.laz` has all.
    fewest_columns: columns with a facade that a segment needs.
    """

    most_taken_out: int = 3_000_000
    fewest_columns: int = 10


@dataclass(frozen=True, eq=False)
class Layered:
    """A segment with a facade. load: its geometry, from disk. around: what images near it show."""

    segment: DriveSegment
    load: Callable[[], Geometry]
    around: Callable[[], Around]


def layer_segments(
    record: DriveRecord,
    segments: Sequence[DriveSegment],
    options: DriveOptions,
    road_m: float,
    digests: JsonValue,
    work: Work,
) -> list[Layered]:
    """Sections 5 and 6 for all segments. NotFoundError where none has a facade."""
    found, fewest = [], StageParameters().fewest_columns
    with work.step("layers") as step:
        built = [one for one in segments if one.fate != "leave-out"]

        def geometry_of(segment: DriveSegment) -> Geometry:
            return _kept_geometry(record, segment, options, road_m, digests, work)

        for number, (segment, geometry) in enumerate(_side_by_side(geometry_of, built)):
            work.progress("layers", number / len(built))
            load = partial(geometry_of, segment)
            if geometry.segment.fate == "as-is" and segment.fate != "as-is":
                step.rejected.append(f"{segment.id}: {geometry.segment.reason}")
            if geometry.segment.fate == "build" and geometry.measured_walls() < fewest:
                step.rejected.append(f"{segment.id}: no facade stands along it")
                continue

            def around(load: Callable[[], Geometry] = load) -> Around:
                return _around(load(), options)

            found.append(Layered(geometry.segment, load, around))
            step.counts[f"{segment.id}: objects"] = geometry.object_count
    if not found:
        raise NotFoundError(
            "a facade", "no segment has a main depth", "Drive along a street with buildings."
        )
    return found


def _side_by_side(
    make: Callable[[Item], Made],
    items: Iterable[Item],
    idle: Callable[[], None] = lambda: None,
) -> Iterator[tuple[Item, Made]]:
    """Each item with what is made of it, in their order; as many at once as there are cores.

    Items are taken from what gives them here, not in a thread. idle: is called now and then.
    """
    cores = available_cores()
    waiting = iter(items)
    with ThreadPoolExecutor(cores) as pool:
        at_work: deque[tuple[Item, Future[Made]]] = deque()
        while True:
            for item in islice(waiting, cores - len(at_work)):
                at_work.append((item, pool.submit(make, item)))
            if not at_work:
                return
            item, made = at_work.popleft()
            while not wait([made], timeout=_IDLE_S).done:
                idle()
            yield item, made.result()


def _kept_geometry(
    record: DriveRecord,
    segment: DriveSegment,
    options: DriveOptions,
    road_m: float,
    digests: JsonValue,
    work: Work,
) -> Geometry:
    def make() -> Geometry:
        points = points_beside(record, segment, options)
        others = others_beside(record, segment, options)
        return reconstruct(segment, frame_of(segment, options, road_m), points, options, others)

    kept: Geometry = work.kept(
        f"layers-{segment.id}", _inputs(segment, options, digests), make, save_result,
        lambda folder: load_result(Geometry, folder),
    )  # fmt: skip
    return kept


def _around(geometry: Geometry, options: DriveOptions) -> Around:
    """What stands before a segment's facades, and the facades as the images should show them."""
    backdrop = backdrop_of(geometry.background, geometry.frame, options.texture.wall_top_m)
    crowns, solid = geometry.crowns(options.seed), solid_below(geometry.layers)
    return Around(geometry.foreground(), crowns, (backdrop,), solid)


def texture_segments(
    record: DriveRecord,
    layered: Sequence[Layered],
    options: DriveOptions,
    digests: JsonValue,
    work: Work,
) -> list[Outcome]:
    """Section 7 for all segments, and what the report shows of each."""
    found: list[Outcome] = []
    images = NearImages(record.shots, [(one.segment, one.around) for one in layered])
    shares = dict.fromkeys(range(len(layered)), 0.0)

    def place_of(number: int) -> tuple[str, JsonValue]:
        segment = layered[number].segment
        return f"texture-{segment.id}", _inputs(segment, options, digests)

    load = partial(load_result, Textured)

    def made_of(number: int, seen: list[Seen]) -> Textured:
        def told(share: float) -> None:
            shares[number] = share

        def make() -> Textured:
            return texture(layered[number].load(), seen, options, told)

        found: Textured = work.kept(*place_of(number), make, save_result, load)
        return found

    def again(number: int) -> Textured:
        """From disk alone: the images that it was made of are not in memory any more."""
        found: Textured = work.kept_again(*place_of(number), load)
        return found

    def idle() -> None:
        work.progress("texture", sum(shares.values()) / len(layered))

    near = ((number, images.near(one.segment)) for number, one in enumerate(layered))
    with work.step("texture") as step:
        for (number, seen), made in _side_by_side(lambda item: made_of(*item), near, idle):
            shares[number] = 1.0
            idle()
            found.append(outcome_of(
                made, partial(again, number), seen, options.texture.texel_m,
                max(StageParameters().most_taken_out // len(layered), 1), work.folder,
            ))  # fmt: skip
            _show(made, work)
            step.counts[f"{layered[number].segment.id}: triangles"] = len(made.surface.triangles)
        step.counts["images"] = images.looked
    return found


def _inputs(segment: DriveSegment, options: DriveOptions, digests: JsonValue) -> JsonValue:
    return [digests, segment.model_dump(mode="json"), options.model_dump(mode="json")]


def _show(one: Textured, work: Work) -> None:
    geometry, name = one.geometry, one.geometry.segment.id
    work.picture(f"{name}: as scanned", "Depth image before; near is light",
                 depth_picture(geometry.layers.first, geometry), wide=True)  # fmt: skip
    work.picture(f"{name}: depth histogram", "Main depth white, split depth blue",
                 histogram_picture(geometry), wide=True)  # fmt: skip
    work.picture(f"{name}: objects", "What stood before the facade", object_picture(geometry),
                 wide=True)  # fmt: skip
    work.picture(f"{name}: background", "Depth image after",
                 depth_picture(geometry.background.depth, geometry), wide=True)  # fmt: skip
    work.picture(
        f"{name}: what is known",
        "Grey measured, orange filled, red filled where images disagree, blue inferred",
        source_picture(one), wide=True,
    )  # fmt: skip
    work.picture(f"{name}: atlas before", "Red is seen in no image",
                 atlas_picture(one, filled=False), wide=True)  # fmt: skip
    work.picture(f"{name}: atlas after", "Holes filled, and marked",
                 atlas_picture(one, filled=True), wide=True)  # fmt: skip
