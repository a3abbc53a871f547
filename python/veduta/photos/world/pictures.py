"""Plans of a component in the world: the outlines of the model, the walls and the cameras."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.facades import Facades, facades_of
from veduta.photos.city.model import CityModel
from veduta.photos.report_pictures import (
    CAMERA,
    FAINT,
    INK,
    MARGIN_PX,
    PAPER,
    SIDE_PX,
    draw_ruler,
    png,
)
from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall
from veduta.photos.world.georeference import Fit, Georeference
from veduta.run.page import Picture

AROUND_M = 15.0
WALL = (38, 92, 168)
POINT = (196, 202, 190)


def georef_pictures(
    structure: Structure,
    walls: tuple[Wall, ...],
    tried: Georeference,
    model: CityModel | None,
) -> list[Picture]:
    """The plan of the best fit; of a refused one the two best, side by side.

    structure, walls: in the component's own frame.
    """
    if tried.best is None:
        return []
    facades = None if model is None else facades_of(model)
    drawn = ("Grey: outlines of the model.",) if model is not None else ()
    drawn = (*drawn, *(("Blue: walls.",) if walls else ()))
    note = " ".join((*drawn, "Red: cameras. Dots: points. North is up."))
    first = _plan(structure, walls, tried.best, facades)
    if tried.accepted:
        title = f"In the world, by {_title(tried)}"
        return [Picture(title, note, png(first), "image/png")]
    if tried.second is None:
        return [Picture(f"Refused: by {_title(tried)}", note, png(first), "image/png")]
    second = _plan(structure, walls, tried.second, facades)
    both = _beside(first, second)
    title = f"Refused: the two best fits by {_title(tried)}"
    return [Picture(title, f"{note} The best is at the left.", png(both), "image/png")]


def model_beside(tried: Georeference, model: CityModel | None) -> CityModel | None:
    """The model, where it lies in the frame into which something else laid the photos."""
    if model is None or (model.crs, model.origin_m) != (tried.crs, tried.origin_m):
        return None
    return model


def _title(tried: Georeference) -> str:
    return {"model": "the city model", "gps": "GPS", "gcp": "control points"}[tried.method]


def _plan(
    structure: Structure, walls: tuple[Wall, ...], fit: Fit, facades: Facades | None
) -> NDArray[np.uint8]:
    """North is up."""
    world = fit.world_from_model
    centres = world.moved(structure.centres())
    low_own, high_own = structure.seen_box()
    corners = np.array(
        [[x, y, low_own[2]] for x in (low_own[0], high_own[0]) for y in (low_own[1], high_own[1])]
    )
    frame = np.concatenate([world.moved(corners), centres])[:, :2]
    low, high = frame.min(axis=0) - AROUND_M, frame.max(axis=0) + AROUND_M
    scale = (SIDE_PX - 2 * MARGIN_PX) / float((high - low).max())
    width, height = np.ceil((high - low) * scale).astype(int).tolist()
    pixels: NDArray[np.uint8] = np.full((height, width, 3), PAPER, dtype=np.uint8)

    def onto(places: NDArray[np.float64]) -> NDArray[np.int64]:
        across = (places[:, 0] - low[0]) * scale
        down = height - (places[:, 1] - low[1]) * scale
        return np.column_stack([across, down]).round().astype(np.int64)

    places = onto(world.moved(structure.points))
    inside = ((places >= 0) & (places < (width, height))).all(axis=1)
    pixels[places[inside, 1], places[inside, 0]] = POINT
    if facades is not None:
        reach = np.abs(facades.middle - (low + high) / 2.0).max(axis=1)
        near = np.flatnonzero(reach < float((high - low).max()))
        ends = zip(onto(facades.start[near]), onto(facades.end[near]), strict=True)
        for start, end in ends:
            cv2.line(pixels, start.tolist(), end.tolist(), FAINT, 2, cv2.LINE_AA)
    for wall in walls:
        foot = np.array([[*wall.start, wall.bottom], [*wall.end, wall.bottom]])
        start, end = onto(world.moved(foot)).tolist()
        cv2.line(pixels, start, end, WALL, 3, cv2.LINE_AA)
    for centre in onto(centres).tolist():
        cv2.circle(pixels, centre, 4, CAMERA, -1, cv2.LINE_AA)
    draw_ruler(pixels, scale, "m")
    return pixels


def _beside(first: NDArray[np.uint8], second: NDArray[np.uint8]) -> NDArray[np.uint8]:
    tallest = max(len(first), len(second))
    padded = [
        np.pad(one, ((0, tallest - len(one)), (0, 0), (0, 0)), constant_values=250)
        for one in (first, second)
    ]
    gap: NDArray[np.uint8] = np.full((tallest, 12, 3), INK, dtype=np.uint8)
    return np.concatenate([padded[0], gap, padded[1]], axis=1)
