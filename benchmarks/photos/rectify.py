"""How well photos are rectified: straight edges of real street photos, and known cameras.

    python benchmarks photos/rectify [street] [cameras] [--views N] [--draws N]

Reads `facades/street-cc0`, `facades/ecp` and `facades/cmp` of $VEDUTA_DATA (else ../shared/data).
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import time
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Row, record

from veduta.facade.find_plane import plane_of_segments
from veduta.facade.options import RectifyOptions
from veduta.facade.plane_region import plane_region
from veduta.facade.rectify import rectify
from veduta.geometry import homography, polygon, vanishing
from veduta.geometry.homography import Matrix
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.exif import focal_px_from_mm35
from veduta.imaging.read import Photo, read_image
from veduta.imaging.segments import Segments, detect_segments
from veduta.run.errors import NotFoundError

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
BOUND_DEG = 1.0
CORNERS_BOUND = 0.9
LENGTHS_PX = (0, 20, 30, 60)
JUDGED_LENGTH_PX = 30
"""The shortest segment whose own direction is known better than the bound (end noise 0.5 px)."""


# --- (a) street photos -------------------------------------------------------------------------


def street() -> None:
    """Median absolute angle of held-out segments to the nearest axis, before and after."""
    rows: list[Row] = []
    for path in sorted((DATA / "facades/street-cc0/images").glob("*.jpg")):
        photo = read_image(path)
        started = time.perf_counter()
        rectify(photo, RectifyOptions())
        rows.append(
            {"photo": path.stem, "seconds": time.perf_counter() - started, **_street_row(photo)}
        )
    columns = [key for key in rows[0] if "after" in key]
    best = {key: sum(float(row[key] or 0.0) <= BOUND_DEG for row in rows) for key in columns}
    total: Row = {"photo": f"at most {BOUND_DEG:g} deg (of {len(rows)})", **best}
    notes = [
        "Half of the segments (chosen at random, seed 1) are fitted, the other half is judged: all "
        "of them inside the region that is kept, cars, people and lettering included.",
        "Angles in degrees, absolute, to the nearest image axis, the median over segments.",
        f"`LSD n` / `FLD n`: segments of at least n photo pixels. The bound is judged at LSD "
        f"{JUDGED_LENGTH_PX}: an end is known to about half a pixel, so the direction of a segment "
        f"of {JUDGED_LENGTH_PX} px to about 1 degree; of all lengths (0) the median segment is "
        "10 to 20 px long, and its own noise is larger than what is measured. `weighted`: the "
        "median by length in the photo over segments of all lengths, without a threshold.",
        "Segments shorter than 1/80 of the diagonal are never fitted, but the same edges, held out "
        "or not, may be longer in the view that faces the wall: `LSD 0`, `LSD 20` and `weighted` "
        "are not wholly a hold-out, `LSD 30` and `LSD 60` are.",
        "FLD (another detector, on the unreduced photo) sees all segments: its half is not "
        "separable from what LSD saw, so it is a second opinion, not a hold-out.",
    ]
    record("rectify-street", [*rows, total], notes)


def _street_row(photo: Photo) -> dict[str, float]:
    height, width = photo.pixels.shape[:2]
    segments = detect_segments(photo.pixels, shortest_part=0.0)
    held_out = np.random.default_rng(1).random(len(segments)) < 0.5
    usable = segments.lengths() >= 0.0125 * np.hypot(height, width)
    plane = plane_of_segments(segments.select(usable), held_out[usable], photo, None)
    matrix = plane.judged_plane_from_image()
    region = plane_region(plane, (width, height)).polygon_px
    other = _fld(photo)
    row: dict[str, float] = {}
    for name, judged in (("LSD", segments.select(held_out)), ("FLD", other)):
        inside = polygon.contains(region, judged.start) & polygon.contains(region, judged.end)
        for length in LENGTHS_PX:
            kept = judged.select(inside & (judged.lengths() >= length))
            row[f"{name} {length} before"] = _median_deg(kept)
            row[f"{name} {length} after"] = _median_deg(kept.mapped(matrix))
        kept = judged.select(inside)
        weights = kept.lengths()
        row[f"{name} weighted before"] = _median_deg(kept, weights)
        row[f"{name} weighted after"] = _median_deg(kept.mapped(matrix), weights)
    return row


def _fld(photo: Photo) -> Segments:
    """Segments of an independent detector (Lee et al. 2014, as in OpenCV's contributed modules)."""
    grey = cv2.cvtColor(photo.pixels, cv2.COLOR_RGB2GRAY)
    found = cv2.ximgproc.createFastLineDetector(10, 1.414, 50, 50, 3, True).detect(grey)
    ends = found.astype(np.float64).reshape(-1, 2, 2) + 0.5
    return Segments(ends[:, 0], ends[:, 1])


def _median_deg(segments: Segments, weights: NDArray[np.float64] | None = None) -> float:
    """Median angle to the nearest axis, each segment once or by its weight."""
    angles = np.rad2deg(vanishing.axis_angles(segments.directions()))
    if weights is None:
        return float(np.median(angles))
    order = np.argsort(angles)
    total = np.cumsum(weights[order])
    return float(angles[order[np.searchsorted(total, total[-1] / 2)]])


# --- (b) known cameras -------------------------------------------------------------------------


@dataclass(frozen=True)
class View:
    """A rendered photo of a facade picture, and the truth."""

    photo: Photo
    facade_from_view: Matrix
    judged_px: NDArray[np.float64]
    focal_mm35: float
    own_from_facade: Matrix


def cameras(pool: Executor, views: int, draws: int) -> None:
    """Corners and aspect under random cameras, in front of several backgrounds."""
    sets = {
        "ecp": sorted((DATA / "facades/ecp/images").glob("*.jpg")),
        "cmp": sorted((DATA / "facades/cmp").glob("**/*.jpg")),
    }
    rows: list[Row] = []
    pooled: dict[tuple[str, bool], list[NDArray[np.float64]]] = {}
    all_fit: list[NDArray[np.bool_]] = []
    for set_name, paths in sets.items():
        chosen, rng = drawn_pictures(paths, views)
        pictures = [read_image(path) for path in chosen]
        owns = [own_rectification(picture) for picture in pictures]
        as_given = [_as_given(*pair) for pair in zip(pictures, owns, strict=True)]
        given = _measured(pool, as_given, False)
        rows.append(_row(set_name, "(as given)", False, given, given[:, 0] <= 0.01))
        fits = np.tile(given[:, 0] <= 0.01, draws)
        all_fit.append(fits)
        for setting, measured in _turned(pool, pictures, owns, draws, rng).items():
            pooled.setdefault(setting, []).append(measured)
            rows.append(_row(set_name, *setting, measured, fits))
    fits = np.concatenate(all_fit)
    for (background, known), parts in pooled.items():
        rows.append(_row("both", background, known, np.vstack(parts), fits))
    everything = np.vstack([part for parts in pooled.values() for part in parts])
    rows.append(_row("both", "(all)", None, everything, np.tile(fits, len(pooled))))
    notes = [
        f"{views} pictures of each set, drawn at random; yaw to 45, pitch to 25, roll to 8 "
        f"degrees, focal length 24 to 50 mm (35 mm equivalent), all uniform; {draws} views of each "
        "before each background.",
        "noise / plain: the whole picture is in view before smoothed noise or one grey; inside: "
        "the view lies within the picture, so none of its own borders helps, and the four corners "
        "of the view are judged.",
        "corners: largest distance of a corner from where it belongs, as a part of the width, "
        "after the best shift and scale of x and of y (a plane is known up to these; the aspect "
        "is judged by itself); `uniform`: after the best shift and one scale.",
        "as given: the pictures themselves, unturned, focal length unknown: what is 'off' here is "
        "in part in the sets' own rectification, which is taken for the truth (rectify-frames.md).",
        "of true pictures: the share of corners <= 1 % among the views of those pictures that are "
        "within 1 % as given.",
        "own lines: the corners against the rectification found for the unturned picture instead "
        "of the picture's own frame: what turning it adds, without the sets' own errors.",
    ]
    record("rectify-cameras", rows, [*notes, *_bounds(rows)])


def _turned(
    pool: Executor, pictures: list[Photo], owns: list[Matrix], draws: int, rng: np.random.Generator
) -> dict[tuple[str, bool], NDArray[np.float64]]:
    """What is measured (draws x pictures, 4) by background and whether the focal is known."""
    found: dict[tuple[str, bool], list[NDArray[np.float64]]] = {}
    for _ in range(draws):
        for background in ("noise", "plain", "inside"):
            rendered = [
                _render(picture, own, background, rng)
                for picture, own in zip(pictures, owns, strict=True)
            ]
            for known in (True, False):
                found.setdefault((background, known), []).append(_measured(pool, rendered, known))
    return {setting: np.vstack(parts) for setting, parts in found.items()}


def drawn_pictures(paths: list[Path], count: int) -> tuple[list[Path], np.random.Generator]:
    """The pictures of a set that are judged, and the generator that goes on to draw their views."""
    rng = np.random.default_rng(7)
    drawn = rng.choice(len(paths), size=count, replace=count > len(paths))
    return [paths[i] for i in drawn], rng


def _bounds(rows: list[Row]) -> list[str]:
    """Which rows reach the bounds: corners in 90 % of the views, aspect with a known focal."""
    turned = [row for row in rows if row["background"] != "(as given)"]
    missed = [
        f"{row['set']} {row['background']} {row['focal']} {float(row['corners <= 1 %'] or 0):.2f}"
        for row in turned
        if float(row["corners <= 1 %"] or 0) < CORNERS_BOUND
    ]
    of_all = float(turned[-1]["corners <= 1 %"] or 0)
    aspects = [float(row["aspect <= 5 %"] or 0) for row in turned if row["focal"] == "known"]
    reason = (
        "`as given` is the share that is within 1 % before anything is turned: in the others the "
        "lines of the facade itself fan out or lean against the picture's frame, so that frame is "
        "not in them. What the method adds of its own shows in `of true pictures` "
        "and `own lines`."
    )
    return [
        f"Bound 'corners within 1 % in {CORNERS_BOUND:.0%} of the views': {of_all:.3f} of all "
        "views of both sets together. By set, background and focal length, each by itself, missed "
        "by: " + (", ".join(missed) + f". {reason}" if missed else "none."),
        f"Aspect within 5 % with a known focal length: in {min(aspects):.0%} of the views or more.",
    ]


def _render(photo: Photo, own: Matrix, background: str, rng: np.random.Generator) -> View:
    """A random view of a picture as a flat wall: 1200 px wide or high, the picture filling it."""
    height, width = photo.pixels.shape[:2]
    landscape = rng.random() < 0.5
    view_size = (1200, 900) if landscape else (900, 1200)
    focal_mm35 = float(rng.uniform(24.0, 50.0))
    focal_px = focal_px_from_mm35(focal_mm35, *view_size)
    yaw, pitch, roll = (np.deg2rad(rng.uniform(-v, v)) for v in (45.0, 25.0, 8.0))
    camera = FacadeView(yaw, pitch, roll, focal_px, view_size[0] / 2, view_size[1] / 2)
    if background == "inside":
        corners = polygon.rectangle(0, 0, *view_size)
        wall = homography.apply(vanishing.plane_from_image(camera), corners)
        low, high = wall.min(axis=0), wall.max(axis=0)
        scale = 0.98 * float(np.min((width, height) / (high - low)))
        free = np.array([width, height]) - (high - low) * scale
        move = rng.uniform(0.0, 1.0, 2) * free - low * scale
        frame = homography.translation(*move) @ homography.scaling(scale, scale)
        facade_from_view = frame @ vanishing.plane_from_image(camera)
        judged = corners.astype(np.float64)
    else:
        facade_from_view = _whole_in_view(camera, (width, height), view_size)
        judged = homography.apply(
            np.asarray(np.linalg.inv(facade_from_view), np.float64),
            polygon.rectangle(0, 0, width, height),
        )
    pixels = _painted(photo.pixels, facade_from_view, view_size, background, rng)
    rendered = replace(photo, pixels=pixels, focal_mm35=None, focal_px=None)
    return View(rendered, facade_from_view, judged, focal_mm35, own)


def _whole_in_view(camera: FacadeView, size: tuple[int, int], view_size: tuple[int, int]) -> Matrix:
    """facade_from_view with the optical axis on the picture's middle, 90 % of the view filled.

    The wall's corners, in the camera's frame at distance t: R (X - X_c) + t z; the smallest t
    that has them all in view is found by bisection.
    """
    width, height = size
    middle = homography.translation(-width / 2, -height / 2)
    rotation, matrix = camera.rotation(), camera.camera()
    near, far = 0.0, 100.0 * max(size)
    for _ in range(60):
        distance = (near + far) / 2
        view_from_facade = _view_from_wall(matrix, rotation, distance) @ middle
        corners = homography.homogeneous(view_from_facade, polygon.rectangle(0, 0, width, height))
        seen = corners[:, :2] / corners[:, 2:]
        margin = 0.05 * np.array(view_size)
        fits = (corners[:, 2] > 0).all() and (seen > margin).all()
        if fits and (seen < np.array(view_size) - margin).all():
            far = distance
        else:
            near = distance
    return homography.inverse(_view_from_wall(matrix, rotation, far) @ middle)


def _view_from_wall(
    camera: NDArray[np.float64], rotation: NDArray[np.float64], distance: float
) -> Matrix:
    columns = np.stack([rotation[:, 0], rotation[:, 1], np.array([0.0, 0.0, distance])], axis=1)
    return np.asarray(camera @ columns)


def _painted(
    pixels: NDArray[np.uint8],
    facade_from_view: Matrix,
    view_size: tuple[int, int],
    background: str,
    rng: np.random.Generator,
) -> NDArray[np.uint8]:
    half = homography.translation(0.5, 0.5)
    matrix = np.linalg.inv(half) @ np.linalg.inv(facade_from_view) @ half
    warped = cv2.warpPerspective(pixels, matrix, view_size, flags=cv2.INTER_CUBIC)
    ones = np.full(pixels.shape[:2], 255, dtype=np.uint8)
    mask = cv2.warpPerspective(ones, matrix, view_size, flags=cv2.INTER_LINEAR)[:, :, None]
    behind = np.full_like(warped, 128)
    if background == "noise":
        noise = cv2.GaussianBlur(np.asarray(rng.normal(0, 1, warped.shape)), (0, 0), 2.0)
        behind = np.clip(128 + 180 * noise, 0, 255).astype(np.uint8)
    return np.asarray((warped * (mask / 255) + behind * (1 - mask / 255)).round(), np.uint8)


def _measured(pool: Executor, views: list[View], known: bool) -> NDArray[np.float64]:
    """(views, 4): corners, uniform, aspect against the truth, corners against the own lines."""
    return np.array(list(pool.map(_measured_view, views, [known] * len(views))))


def _measured_view(view: View, known: bool) -> list[float]:
    options = RectifyOptions(focal_mm35=view.focal_mm35 if known else None)
    try:
        found = rectify(view.photo, options)
    except NotFoundError:
        return [np.inf] * 4
    matrix = np.array(found.record.rectified_from_source)
    estimate = homography.apply(matrix, view.judged_px)
    truth = homography.apply(view.facade_from_view, view.judged_px)
    own = homography.apply(view.own_from_facade, truth)
    return [*compared(estimate, truth), compared(estimate, own)[0]]


def _row(
    set_name: str,
    background: str,
    known: bool | None,
    measured: NDArray[np.float64],
    fits: NDArray[np.bool_],
) -> Row:
    """`fits` (views,): the picture's own lines are within the bound of its own frame.

    `known` None: of views with a known and with an unknown focal length.
    """
    corners, uniform, aspect, own = measured.T
    return {
        "set": set_name,
        "background": background,
        "focal": {True: "known", False: "unknown", None: "either"}[known],
        "corners <= 1 %": float(np.mean(corners <= 0.01)),
        "median %": 100 * float(np.median(corners)),
        "90th %": 100 * float(np.quantile(corners, 0.9, method="lower")),
        "of true pictures": float(np.mean(corners[fits] <= 0.01)),
        "own lines <= 1 %": float(np.mean(own <= 0.01)),
        "uniform <= 1 %": float(np.mean(uniform <= 0.01)),
        "aspect <= 5 %": float(np.mean(aspect <= 0.05)),
        "aspect median %": 100 * float(np.median(aspect)),
        "not found": int(np.isinf(corners).sum()),
    }


def own_rectification(photo: Photo) -> Matrix:
    """What the picture's own lines say, without turning it; the identity where they say nothing."""
    try:
        return np.array(rectify(photo, RectifyOptions()).record.rectified_from_source)
    except NotFoundError:
        return np.eye(3)


def _as_given(photo: Photo, own: Matrix) -> View:
    height, width = photo.pixels.shape[:2]
    return View(photo, np.eye(3), polygon.rectangle(0, 0, width, height), 32.0, own)


def compared(
    estimate: NDArray[np.float64], truth: NDArray[np.float64]
) -> tuple[float, float, float]:
    """Corner error with two scales and with one (parts of the width), and the aspect's error."""
    e, t = estimate - estimate.mean(axis=0), truth - truth.mean(axis=0)
    width = float(np.ptp(truth[:, 0]))
    each = (e * t).sum(axis=0) / (e * e).sum(axis=0)
    one = float((e * t).sum() / (e * e).sum())
    worst = float(np.linalg.norm(e * each - t, axis=1).max()) / width
    worst_uniform = float(np.linalg.norm(e * one - t, axis=1).max()) / width
    return worst, worst_uniform, abs(float(each[0] / each[1]) - 1.0)


def main() -> None:
    """Run the named parts, both by default."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("parts", nargs="*", choices=["street", "cameras", []], default=[])
    parser.add_argument("--views", type=int, default=60, help="pictures per set")
    parser.add_argument("--draws", type=int, default=3, help="views per picture and background")
    arguments = parser.parse_args()
    if not arguments.parts or "street" in arguments.parts:
        street()
    if not arguments.parts or "cameras" in arguments.parts:
        # Spawned, for OpenCV's threads do not survive a fork.
        spawned = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(None, spawned, cv2.setNumThreads, (1,)) as pool:
            cameras(pool, arguments.views, arguments.draws)


if __name__ == "__main__":
    main()
