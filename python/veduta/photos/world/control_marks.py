"""Whether control points are marked in photos that are there: said before anything is computed."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches

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
