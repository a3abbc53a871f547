"""Control points that are marked in a panorama, as marks in the views that were cut out of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from veduta.imaging.read import image_size
from veduta.photos.intake.panoramas import pixel_in_view
from veduta.photos.intake.source import Source
from veduta.photos.world.control_file import ControlPoint, ControlPoints


@dataclass(frozen=True)
class _Cut:
    """size_px: of the panorama. side_px: of its views. names: what they are called, by number."""

    size_px: tuple[int, int]
    side_px: int
    names: Mapping[int, str]


def marks_in_views(
    control: ControlPoints, sources: Sequence[Source]
) -> tuple[ControlPoints, list[str]]:
    """The points with marks in views in place of those in panoramas, each in the view whose middle
    is nearest; and a text for each mark that no view shows: above, below, or outside.
    """
    cut: dict[str, _Cut] = {}
    for source in sources:
        if source.view is not None:
            name = source.view.panorama
            known = cut.get(name)
            side = image_size(source.path)[0] if known is None else known.side_px
            names = {**(known.names if known else {}), source.view.number: source.name}
            cut[name] = _Cut(source.view.size_px, side, names)
    if not cut:
        return control, []
    told = [
        f"{point.name}: the mark at {pixel[0]:g}, {pixel[1]:g} lies outside of what the views of"
        f" {name} show ({cut[name].size_px[0]} x {cut[name].size_px[1]} px): left out"
        for point in control.points
        for name, pixel in point.seen
        if name in cut and _in_view(cut[name], pixel) is None
    ]
    kept = replace(control, points=tuple(_moved(point, cut) for point in control.points))
    if control.exchanged is not None:
        points = tuple(_moved(point, cut) for point in control.exchanged.points)
        kept = replace(kept, exchanged=replace(control.exchanged, points=points))
    return kept, told


def _moved(point: ControlPoint, cut: Mapping[str, _Cut]) -> ControlPoint:
    moved = [
        _in_view(cut[name], pixel) if name in cut else (name, pixel) for name, pixel in point.seen
    ]
    return replace(point, seen=tuple(mark for mark in moved if mark is not None))


def _in_view(cut: _Cut, pixel: tuple[float, float]) -> tuple[str, tuple[float, float]] | None:
    """The mark in a view; None where none shows it."""
    width, height = cut.size_px
    if not (0.0 <= pixel[0] <= width and 0.0 <= pixel[1] <= height):
        return None
    found = pixel_in_view(pixel, cut.size_px, cut.side_px)
    if found is None or found[0] not in cut.names:
        return None
    return cut.names[found[0]], found[1]
