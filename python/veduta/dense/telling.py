"""What the report says and shows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.showing import beside, confidence_picture, depth_picture, shown_range_m
from veduta.dense.build.standing import told_axes
from veduta.dense.document import DepthMap, Views
from veduta.dense.read.neighbours import Comparison
from veduta.place.mesh import Mesh
from veduta.place.place import Place
from veduta.run.page import Bars, Table
from veduta.run.report import Count
from veduta.run.work import Work

MOST_SHOWN = 12


def tell_depths(
    work: Work,
    views: Views,
    comparisons: list[Comparison],
    depth_map: Callable[[int], DepthMap],
) -> None:
    """A row and a picture for each view, and how much of each is known."""
    rows: list[list[Count | None]] = []
    shares = []
    step = max(1, len(comparisons) // MOST_SHOWN)
    for place, one in enumerate(comparisons):
        found = depth_map(one.view)
        name = views.cameras[one.view].name
        share = float(found.known.mean())
        shares.append((name, round(100.0 * share, 1)))
        low, high = shown_range_m(found)
        with_names = ", ".join(views.cameras[other].name for other in one.neighbours)
        rows.append([name, with_names, round(low, 2), round(high, 2), round(100.0 * share, 1)])
        if place % step == 0:
            shown = depth_picture(found.depths_m, (low, high))
            parts = [views.pixels(one.view), shown, confidence_picture(found.confidence)]
            note = f"photo, depth ({low:.1f} red to {high:.1f} blue), confidence"
            work.picture(name, note, beside(parts), wide=True)
    columns = ("photo", "compared with", "near", "far", "known, %")
    work.table(Table("Depth maps", columns, rows))
    work.bars(Bars("Pixels with a depth", "%", shares))
    work.measure("known_share", round(float(np.mean([one for _, one in shares])) / 100.0, 4))


def tell_result(
    work: Work,
    place: Place,
    cloud: DenseCloud,
    mesh: tuple[Mesh, NDArray[np.float64]] | None,
) -> None:
    """The figures at the top of the page, and the line at the end of the terminal."""
    unit = "m" if place.scale == "metres" else "units of the cameras"
    work.measure("points", len(cloud.points_m))
    parts = [f"{len(cloud.points_m):,} points"]
    if mesh is not None:
        work.measure("triangles", len(mesh[0].triangles))
        work.measure("area_m2", round(float(mesh[0].triangle_area_m2.sum()), 3))
        parts.append(f"a mesh of {len(mesh[0].triangles):,} triangles")
    if place.scale != "metres":
        work.doubt("the scale is unknown: lengths are in the units of the cameras, not metres")
    low, high = np.quantile(cloud.points_m, [0.01, 0.99], axis=0)
    size = " x ".join(f"{one:.1f}" for one in high - low)
    work.fact("Photos with a depth map", str(len(place.cameras)))
    work.fact("Points", f"{len(cloud.points_m):,}")
    work.fact("Size", f"{size} {unit}")
    work.summary = f"{' and '.join(parts)} from {len(place.cameras)} photos, {size} {unit}"


def middle_depths_m(
    comparisons: list[Comparison], depth_map: Callable[[int], DepthMap]
) -> dict[int, float]:
    """The median depth of each view that has any."""
    found = {}
    for one in comparisons:
        known = depth_map(one.view)
        if known.known.any():
            found[one.view] = float(np.median(known.depths_m[known.known]))
    return found


def tell_standing(work: Work, stand: NDArray[np.float64]) -> None:
    """Where the place does not stand in the cameras' frame: how it was turned and raised."""
    if not np.array_equal(stand, np.eye(4)):
        work.measure("place_from_cameras", [float(one) for one in stand.ravel()])
        axes = told_axes(stand[:3, :3])
        work.note(
            f"Files of points and depths are in the cameras' frame; x, y, z of the place are its "
            f"{axes}, raised by {stand[2, 3]:.3f}, so that z points up and the ground is at 0."
        )
