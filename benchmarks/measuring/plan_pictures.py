"""Overlays of what was found on a drawing, and sheets of many, to be looked at."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from plan_truth import Affine, Layout
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

Image = NDArray[np.uint8]
COLOURS = {"door": (220, 0, 160), "gap": (240, 140, 0), "window": (0, 130, 255)}
FOUND, TRUE, ROOM = (230, 0, 0), (0, 190, 190), (0, 150, 0)
CELL_PX = 760
COLUMNS = 3
SHIFT = 4


def overlay(picture: Image, found: Layout | None, true: Layout | None, px_from_m: Affine) -> Image:
    """The drawing, paler, with walls, rooms and openings found; the truth's walls below them."""
    drawn = np.asarray(np.round(0.55 * picture + 0.45 * 255), np.uint8)
    pen = max(1, round(max(picture.shape[:2]) / 700))

    def px(points: object) -> NDArray[np.int32]:
        metres = np.asarray(points, float)[:, :2]
        at = metres @ px_from_m[:2, :2].T + px_from_m[:2, 2] - 0.5
        return np.asarray(np.round(at * 2**SHIFT), np.int32)

    def rings(area: BaseGeometry, colour: tuple[int, int, int], width: int) -> None:
        for part in getattr(area, "geoms", [area]):
            if isinstance(part, Polygon):
                for ring in (part.exterior, *part.interiors):
                    points = [px(ring.coords)]
                    cv2.polylines(drawn, points, True, colour, width, cv2.LINE_AA, SHIFT)

    if true is not None:
        rings(true.solid, TRUE, 2 * pen)
    if found is not None:
        for space in found.spaces:
            rings(space.area, ROOM, pen)
            spot = px([space.area.representative_point().coords[0]])[0] // 2**SHIFT
            at = (int(spot[0]) - 30 * pen, int(spot[1]) + 18 * pen)
            cv2.putText(drawn, space.use, at, cv2.FONT_HERSHEY_SIMPLEX, 0.5 * pen, ROOM, pen)
        rings(found.solid, FOUND, pen)
        for gap in found.gaps:
            line = [px(gap.ends_m)]
            cv2.polylines(drawn, line, False, COLOURS[gap.kind], 4 * pen, cv2.LINE_AA, SHIFT)
    return drawn


def contact_sheets(cells: Sequence[tuple[str, Image]], folder: Path, name: str) -> None:
    """Pages of twelve overlays with a line of words above each."""
    folder.mkdir(parents=True, exist_ok=True)
    for page, start in enumerate(range(0, len(cells), 4 * COLUMNS)):
        rows = [
            np.hstack([_cell(*cell) for cell in _row(cells, low)])
            for low in range(start, min(start + 4 * COLUMNS, len(cells)), COLUMNS)
        ]
        sheet = np.vstack(rows)
        cv2.imwrite(str(folder / f"{name}-{page:02d}.png"), sheet[..., ::-1])


def _row(cells: Sequence[tuple[str, Image]], low: int) -> list[tuple[str, Image]]:
    blank = np.full((CELL_PX, CELL_PX, 3), 230, np.uint8)
    row = list(cells[low : low + COLUMNS])
    return row + [("", blank)] * (COLUMNS - len(row))


def _cell(words: str, picture: Image) -> Image:
    cell = np.full((CELL_PX, CELL_PX, 3), 255, np.uint8)
    room = CELL_PX - 34
    scale = min((CELL_PX - 6) / picture.shape[1], room / picture.shape[0])
    size = (max(1, round(picture.shape[1] * scale)), max(1, round(picture.shape[0] * scale)))
    small = cv2.resize(picture, size, interpolation=cv2.INTER_AREA)
    cell[32 : 32 + size[1], 3 : 3 + size[0]] = small
    cv2.putText(cell, words, (6, 22), cv2.FONT_HERSHEY_SIMPLEX, 0.5, (0, 0, 0), 1, cv2.LINE_AA)
    return cell
