"""`--turntable`: cameras for photos that have none, from silhouettes of an object that turned."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from veduta.cameras import Camera, CameraSet
from veduta.carve.options import PoseOptions
from veduta.carve.read.turntable import Focal, Found, find_turns, seem_uneven
from veduta.carve.views import View
from veduta.imaging.read import image_size, read_image
from veduta.run.page import Table
from veduta.run.work import Work

USUAL_SHARE = 0.4
EXIF_SHARE, GIVEN_SHARE = 0.1, 1e-3
"""By what shares a usual focal length, one of EXIF, and one that is given, may be wrong."""


def turn_views(
    work: Work,
    views: Sequence[View],
    folder: Path,
    options: PoseOptions,
    keep: Callable[[Callable[[], Found]], Found] = lambda make: make(),
) -> tuple[CameraSet, tuple[View, ...]]:
    """The views with the cameras that a turntable gives them; their unit is the camera's distance
    from its axis. keep: gives the turns of a run that was killed.
    """
    focal = _focal(views[0], folder, options)
    with work.step("turntable") as step:
        masks = [view.mask for view in views]
        found = keep(
            lambda: find_turns(masks, focal, even=options.even_turns, progress=work.progress)
        )
        step.counts["photos"] = len(views)
    turned = tuple(
        replace(view, camera=_camera(view.camera, found, pose))
        for view, pose in zip(views, found.table.poses(), strict=True)
    )
    _tell(work, views, found)
    cameras = tuple(view.camera for view in turned)
    return CameraSet(cameras, source="a turntable", up=(0.0, 0.0, 1.0)), turned


def _camera(camera: Camera, found: Found, pose: np.ndarray) -> Camera:
    return replace(camera, focal_px=(found.table.focal_px,) * 2, cam_from_world=pose)


def _focal(view: View, folder: Path, options: PoseOptions) -> Focal:
    """Of the views' size, which may be smaller than the photos'."""
    path = view.camera.picture or folder / view.name
    width, height = image_size(path)
    factor = max(view.camera.width_px, view.camera.height_px) / max(width, height)
    if options.focal_px is not None:
        return Focal(options.focal_px * factor, GIVEN_SHARE)
    said = read_image(path).focal_px
    if said is not None:
        return Focal(said * factor, EXIF_SHARE)
    return Focal(view.camera.focal_px[0], USUAL_SHARE)


def _tell(work: Work, views: Sequence[View], found: Found) -> None:
    table = found.table
    degrees = np.degrees(np.abs(table.angles - table.angles[0]))
    sure = np.degrees(found.deviations)
    work.measure("turns_deg", [round(float(one), 2) for one in degrees])
    known = bool(np.isfinite(sure).all())
    if known:
        work.measure("turns_deviation_deg", round(float(sure.max()), 2))
    work.measure("outlines_miss_px", round(found.miss_px, 2))
    work.measure("focal_px", round(table.focal_px, 1))
    work.measure("tilt_deg", round(float(np.degrees(table.tilt)), 2))
    way = "counter-clockwise" if table.angles[-1] > table.angles[0] else "clockwise"
    work.note(
        f"Seen from above the object turned {way}. The camera looks down by"
        f" {np.degrees(table.tilt):.1f} degrees, and its focal length is {table.focal_px:.0f} px at"
        f" {views[0].camera.width_px} x {views[0].camera.height_px} px. The unit of length is its"
        " distance from the turntable's axis."
    )
    size = (views[0].camera.width_px, views[0].camera.height_px)
    if seem_uneven(found, size):
        work.doubt(
            f"taken as even, the turns leave the outlines {found.miss_px:.1f} px apart: they may be"
            " uneven, or no full turn; try without --even-turns"
        )
    elif not known:
        work.note("The turns are even as --even-turns says: how sure they are was not looked at.")
    rows: list[list[float | int | str | None]] = []
    for view, angle, one in zip(views, degrees, sure, strict=True):
        rows.append([view.name, round(float(angle), 2)])
        if known:
            rows[-1].append(round(float(one), 2))
    columns = ["photo", "turned since the first (degrees)"]
    columns += ["deviation (degrees)"] if known else []
    work.table(Table("Turns of the table", columns, rows))
