"""Whether control points are marked in photos that are there, and within them: said before anything
is computed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches

import numpy as np

from veduta.photos.world.control_file import ControlPoint, ControlPoints
from veduta.photos.world.control_fit import FEWEST
from veduta.run.errors import InputError

FEWEST_PHOTOS = 2
MOST_NAMED = 5


def unknown_marks(control: ControlPoints, photos: Sequence[str]) -> list[str]:
    """The lines that name no photo, each with the photo that may be meant; a text for a person.

    photos: the names of all that are given. InputError where fewer points are left than it takes.
    """
    there = set(photos)
    named = dict.fromkeys(name for point in control.points for name, _ in point.seen)
    unknown = [name for name in named if name not in there]
    told = [_told(control, name, photos) for name in unknown]
    usable = sum(_photos_of(point, there) >= FEWEST_PHOTOS for point in control.points)
    if usable < FEWEST:
        fault = (
            f"marks {usable} of its {len(control.points)} points in two photos that are there, and"
            f" it takes {FEWEST}"
        )
        some = "; ".join(told[:MOST_NAMED])
        remedy = "Mark more points, or correct the names of the photos."
        raise InputError(control.path, f"{fault} ({some})" if some else fault, remedy)
    return told


def marks_within(
    control: ControlPoints, sizes_px: Mapping[str, tuple[int, int]]
) -> tuple[ControlPoints, list[str]]:
    """The points without marks that lie outside of their photos, and a text for each of these.

    sizes_px: width and height by name, of photos whose size is known. InputError where fewer
    points are left than it takes.
    """
    outside = [
        (point.name, name, pixel)
        for point in control.points
        for name, pixel in point.seen
        if name in sizes_px and not _is_within(pixel, sizes_px[name])
    ]
    if not outside:
        return control, []
    points = tuple(
        replace(
            point,
            seen=tuple(
                (name, pixel)
                for name, pixel in point.seen
                if name not in sizes_px or _is_within(pixel, sizes_px[name])
            ),
        )
        for point in control.points
    )
    there = set(sizes_px)
    usable = sum(_photos_of(point, there) >= FEWEST_PHOTOS for point in points)
    marks = sum(name in there for point in control.points for name, _ in point.seen)
    width, height = sizes_px[outside[0][1]]
    far = np.array([pixel for _, _, pixel in outside]).max(axis=0)
    if usable < FEWEST:
        fault = (
            f"has {len(outside)} of its {marks} marks outside of their photos, which are"
            f" {width} x {height} px: marks reach to {far[0]:.0f}, {far[1]:.0f}"
        )
        remedy = "Give the photos in the size that they were marked in, or mark these."
        raise InputError(control.path, fault, remedy)
    told = [
        f"{point}: the mark at {pixel[0]:g}, {pixel[1]:g} lies outside of {name}"
        f" ({sizes_px[name][0]} x {sizes_px[name][1]} px): left out"
        for point, name, pixel in outside
    ]
    kept = replace(control, points=points)
    if control.exchanged is not None:
        seen = {point.name: point.seen for point in points}
        others = tuple(replace(one, seen=seen[one.name]) for one in control.exchanged.points)
        kept = replace(kept, exchanged=replace(control.exchanged, points=others))
    return kept, told


def _is_within(pixel: tuple[float, float], size_px: tuple[int, int]) -> bool:
    return 0.0 <= pixel[0] <= size_px[0] and 0.0 <= pixel[1] <= size_px[1]


def _photos_of(point: ControlPoint, there: set[str]) -> int:
    return len({name for name, _ in point.seen if name in there})


def _told(control: ControlPoints, name: str, photos: Sequence[str]) -> str:
    lines = control.lines[name]
    shown = ", ".join(map(str, lines[:MOST_NAMED])) + (" ..." if len(lines) > MOST_NAMED else "")
    near = _nearest(name, photos)
    hint = f", where {near} is" if near else ""
    return f"line{'s' if len(lines) > 1 else ''} {shown}: {name} is not among the photos{hint}"


def _nearest(name: str, photos: Sequence[str]) -> str | None:
    """The photo whose name is most like it; small and capital letters are alike."""
    by_small = {photo.casefold(): photo for photo in photos}
    found = get_close_matches(name.casefold(), by_small, n=1)
    return by_small[found[0]] if found else None
