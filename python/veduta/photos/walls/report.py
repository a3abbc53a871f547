"""What the report says of the walls: a plan, a table, and their pictures."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.report_pictures import CAMERA, FAINT, INK, MARGIN_PX, PAPER, SIDE_PX, jpeg, png
from veduta.photos.structure import Structure
from veduta.photos.walls.step import FoundWalls
from veduta.run.page import Picture, Table

THUMB_PX = 320
MOST_THUMBS = 24
COLOURS = ((31, 97, 141), (176, 96, 16), (35, 120, 70), (120, 60, 140), (150, 40, 60))


def walls_pictures(structure: Structure, found: FoundWalls) -> list[Picture]:
    """The plan, and the pictures of the largest walls; nothing where there are no walls."""
    if not found.walls:
        return []
    return [_plan(structure, found), _sheet(found)]


def walls_table(found: FoundWalls, unit: str) -> list[Table]:
    """A row per wall."""
    rows: list[list[float | int | str | None]] = [
        [
            wall.id,
            round(wall.width, 3),
            round(wall.height, 3),
            len(wall.point_rows),
            round(wall.rms, 4),
            round(100.0 * picture.seen, 1),
            len(picture.photos),
        ]
        for wall, picture in zip(found.walls, found.pictures, strict=True)
    ]
    lengths = "metres" if unit == "metres" else "the model's unit, whose size is not known"
    note = (
        f"Lengths in {lengths}. rms: how far the points lie off the plane. Seen: share of the"
        " picture that any photo shows; the rest is transparent."
    )
    columns = ("wall", "width", "height", "points", "rms", "seen %", "photos")
    return [Table("Walls", columns, rows, note=note)] if rows else []


def _plan(structure: Structure, found: FoundWalls) -> Picture:
    """Points from above, those of a wall in its colour; walls as lines with a tick outward."""
    low, high = (corner[:2] for corner in structure.seen_box())
    ends = np.concatenate([[wall.start, wall.end] for wall in found.walls])
    low, high = np.minimum(low, ends.min(axis=0)), np.maximum(high, ends.max(axis=0))
    scale = (SIDE_PX - 2 * MARGIN_PX) / float((high - low).max())
    width, height = (np.ceil((high - low) * scale).astype(int) + 2 * MARGIN_PX).tolist()
    pixels = np.full((height, width, 3), PAPER, dtype=np.uint8)

    def onto(points: NDArray[np.float64]) -> NDArray[np.int64]:
        across = (points[:, 0] - low[0]) * scale + MARGIN_PX
        return np.column_stack(
            [across, height - MARGIN_PX - (points[:, 1] - low[1]) * scale]
        ).astype(np.int64)

    _dots(pixels, onto(structure.points), FAINT)
    tick = 0.02 * float((high - low).max())
    for number, wall in enumerate(found.walls):
        colour = COLOURS[number % len(COLOURS)]
        _dots(pixels, onto(structure.points[wall.point_rows]), colour)
        middle = 0.5 * (wall.start + wall.end)
        drawn = onto(np.stack([wall.start, wall.end, middle, middle + tick * wall.outward]))
        for one, two in ((0, 1), (2, 3)):
            cv2.line(pixels, drawn[one].tolist(), drawn[two].tolist(), colour, 2, cv2.LINE_AA)
        at = (drawn[3] + 6).tolist()
        cv2.putText(pixels, wall.id, at, cv2.FONT_HERSHEY_SIMPLEX, 0.4, INK, 1, cv2.LINE_AA)
    for place in onto(structure.centres()).tolist():
        cv2.circle(pixels, place, 4, CAMERA, -1, cv2.LINE_AA)
    note = "Walls from above, each with its points; the tick shows the side that it is seen from."
    return Picture("Walls", note, png(pixels), "image/png")


def _dots(
    pixels: NDArray[np.uint8], places: NDArray[np.int64], colour: tuple[int, int, int]
) -> None:
    height, width = pixels.shape[:2]
    inside = ((places >= 0) & (places < (width, height))).all(axis=1)
    pixels[places[inside, 1], places[inside, 0]] = colour


def _sheet(found: FoundWalls) -> Picture:
    """The pictures of the walls side by side, small; checks where nothing is seen."""
    thumbs = [_thumb(picture.pixels) for picture in found.pictures[:MOST_THUMBS]]
    rows: list[list[NDArray[np.uint8]]] = [[]]
    for thumb in thumbs:
        if (
            rows[-1]
            and sum(other.shape[1] + 8 for other in rows[-1]) + thumb.shape[1] > 3 * SIDE_PX // 2
        ):
            rows.append([])
        rows[-1].append(thumb)
    lines = [_beside(row) for row in rows]
    widest = max(line.shape[1] for line in lines)
    sheet = np.concatenate([_padded(line, widest) for line in lines])
    left = len(found.pictures) - len(thumbs)
    note = "The walls' metric pictures (walls/*.png), small." + (
        f" {left} more are not shown here." if left else ""
    )
    return Picture("Pictures of the walls", note, jpeg(sheet), "image/jpeg")


def _thumb(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    height, width = pixels.shape[:2]
    shrink = min(1.0, THUMB_PX / height, 2 * THUMB_PX / width)
    size = (max(1, round(shrink * width)), max(1, round(shrink * height)))
    small = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA)
    down, across = np.indices(small.shape[:2]) // 8
    checks = np.where(((down + across) % 2)[..., None] > 0, PAPER, FAINT)
    share = small[..., 3:] / 255.0
    return np.round(share * small[..., :3] + (1.0 - share) * checks).astype(np.uint8)


def _beside(row: list[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    tallest = max(thumb.shape[0] for thumb in row)
    return np.concatenate(
        [
            cv2.copyMakeBorder(
                thumb, 0, tallest + 8 - thumb.shape[0], 0, 8, cv2.BORDER_CONSTANT, value=PAPER
            ).astype(np.uint8)
            for thumb in row
        ],
        axis=1,
    )


def _padded(line: NDArray[np.uint8], width: int) -> NDArray[np.uint8]:
    more = width - line.shape[1]
    return cv2.copyMakeBorder(line, 0, 0, 0, more, cv2.BORDER_CONSTANT, value=PAPER).astype(
        np.uint8
    )
