"""The drawings of the report: the plan with the cameras, the match matrix, the errors."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.encode import jpeg_bytes, png_bytes
from veduta.photos.matching.match import PairRecord
from veduta.photos.structure import Structure
from veduta.run.page import Picture

SIDE_PX = 900
MARGIN_PX = 40
PAPER, INK, FAINT = (250, 249, 246), (35, 38, 43), (190, 186, 176)
CAMERA = (179, 54, 43)
MOST_ERROR_PX = 2.0
BINS = 40
_FONT, _SCALE, _LINE_PX, _MOST_LETTERS = cv2.FONT_HERSHEY_SIMPLEX, 0.4, 14, 24


def plan_picture(structure: Structure, *, in_metres: bool = False) -> Picture:
    """The points from above in their colours, and each camera with the way that it looks.

    in_metres: whether the unit is known, and north is up.
    """
    centres, ahead = structure.centres()[:, :2], structure.cam_from_world[:, 2, :2]
    low, high = (corner[:2] for corner in structure.seen_box())
    scale = (SIDE_PX - 2 * MARGIN_PX) / float((high - low).max())
    width, height = (np.ceil((high - low) * scale).astype(int) + 2 * MARGIN_PX).tolist()
    pixels = _paper(height, width)

    def onto(points: NDArray[np.float64]) -> NDArray[np.int64]:
        across = (points[:, 0] - low[0]) * scale + MARGIN_PX
        down = height - MARGIN_PX - (points[:, 1] - low[1]) * scale
        return np.column_stack([across, down]).astype(np.int64)

    places = onto(structure.points)
    inside = ((places >= 0) & (places < (width, height))).all(axis=1)
    pixels[places[inside, 1], places[inside, 0]] = structure.colours[inside]
    reach = 0.05 * float((high - low).max())
    for start, end in zip(
        onto(centres).tolist(), onto(centres + reach * ahead).tolist(), strict=True
    ):
        cv2.line(pixels, start, end, CAMERA, 2, cv2.LINE_AA)
        cv2.circle(pixels, start, 5, CAMERA, -1, cv2.LINE_AA)
    draw_ruler(pixels, scale, "m" if in_metres else "units")
    note = "Points in their colours; a red dot is a camera, the line the way that it looks." + (
        " North is up." if in_metres else " The scale is not known: the unit is none of the world."
    )
    return Picture("From above", note, png(pixels), "image/png")


def draw_ruler(pixels: NDArray[np.uint8], px_per_unit: float, unit: str) -> None:
    """A length of one, two or five with a power of ten, at the lower left; about a sixth as wide
    as the picture.
    """
    wanted = pixels.shape[1] / 6.0 / px_per_unit
    power = 10.0 ** np.floor(np.log10(wanted))
    length = max(step * power for step in (1.0, 2.0, 5.0) if step * power <= wanted)
    down = pixels.shape[0] - 14
    end = (12 + round(length * px_per_unit), down)
    cv2.line(pixels, (12, down), end, INK, 2)
    for across in (12, end[0]):
        cv2.line(pixels, (across, down - 5), (across, down + 5), INK, 2)
    label = f"{length:g} {unit}"
    cv2.putText(pixels, label, (12, down - 9), _FONT, 0.5, INK, 1, cv2.LINE_AA)


def match_picture(
    image_ids: Sequence[int],
    pairs: Sequence[PairRecord],
    doubtful: Sequence[tuple[int, int]] = (),
    names: Sequence[str] = (),
) -> Picture:
    """A cell per pair of photos, the darker the more features agree; doubtful ones are red.

    names: of the photos, written beside their rows and above their columns, as far as they fit.
    """
    rows = {image_id: row for row, image_id in enumerate(image_ids)}
    counts = np.zeros((len(rows), len(rows)))
    for pair in pairs:
        counts[rows[pair.first], rows[pair.second]] = pair.verified
        counts[rows[pair.second], rows[pair.first]] = pair.verified
    share = np.log1p(counts) / max(1.0, float(np.log1p(counts).max()))
    ink = (1.0 - share)[:, :, None] * np.array(PAPER) + share[:, :, None] * np.array(INK)
    if doubtful:
        at = np.array([(rows[first], rows[second]) for first, second in doubtful])
        at = np.concatenate([at, at[:, ::-1]])
        strength = share[at[:, 0], at[:, 1], None]
        ink[at[:, 0], at[:, 1]] = (1.0 - strength) * np.array(PAPER) + strength * np.array(CAMERA)
    ink[np.eye(len(rows), dtype=bool)] = FAINT
    side = max(1, SIDE_PX // max(1, len(rows))) * len(rows)
    pixels = cv2.resize(ink.astype(np.uint8), (side, side), interpolation=cv2.INTER_NEAREST)
    if names:
        pixels = _named(np.asarray(pixels, dtype=np.uint8), names)
    planar = sum(pair.planar for pair in pairs)
    note = (
        "Which photos agree: a row and a column per photo in the order of their names, the darker"
        " the more features."
        + (f" {planar} pairs of photos agree in one flat surface alone." if planar else "")
        + (f" Red: {len(doubtful)} doubtful pairs, which were not used." if doubtful else "")
    )
    return Picture("Matches", note, png(np.asarray(pixels, np.uint8)), "image/png")


def _named(pixels: NDArray[np.uint8], names: Sequence[str]) -> NDArray[np.uint8]:
    """The matrix with names at the left and, turned, above; of many photos some of the names."""
    cell = len(pixels) / len(names)
    every = max(1, int(np.ceil(_LINE_PX / cell)))
    labels = [_short(name) for name in names[::every]]
    widths = [cv2.getTextSize(label, _FONT, _SCALE, 1)[0][0] for label in labels]
    room = max(widths, default=0) + 10
    side, above = _paper(len(pixels), room), _paper(len(pixels), room)
    for row, (label, width) in enumerate(zip(labels, widths, strict=True)):
        down = round((row * every + 0.5) * cell) + 4
        for where, left in ((side, room - 5 - width), (above, 5)):
            cv2.putText(where, label, (left, down), _FONT, _SCALE, INK, 1, cv2.LINE_AA)
    top = np.concatenate([_paper(room, room), np.rot90(above)], axis=1)
    return np.concatenate([top, np.concatenate([side, pixels], axis=1)], axis=0)


def _short(name: str) -> str:
    """Names differ at either end; OpenCV has no letters beyond ASCII."""
    plain = name.encode("ascii", "replace").decode()
    half = _MOST_LETTERS // 2 - 1
    return plain if len(plain) <= _MOST_LETTERS else f"{plain[:half]}..{plain[-half:]}"


def error_picture(errors_px: NDArray[np.float64]) -> Picture:
    """How many observations lie how far from their points' projections."""
    counts = np.histogram(np.minimum(errors_px, MOST_ERROR_PX), BINS, (0.0, MOST_ERROR_PX))[0]
    width, height = SIDE_PX, SIDE_PX // 2
    pixels = _paper(height, width)
    base, step = height - MARGIN_PX, (width - 2 * MARGIN_PX) / BINS
    tallest = max(1, int(counts.max()))
    for number, count in enumerate(counts.tolist()):
        left = MARGIN_PX + round(number * step)
        top = base - round((base - MARGIN_PX // 2) * count / tallest)
        cv2.rectangle(pixels, (left, top), (left + round(step) - 2, base), INK, -1)
    for tick in range(5):
        across = MARGIN_PX + round(tick * (width - 2 * MARGIN_PX) / 4)
        label = f"{tick * MOST_ERROR_PX / 4:.1f}" + ("+ px" if tick == 4 else "")
        cv2.putText(
            pixels,
            label,
            (across - 14, height - 12),
            cv2.FONT_HERSHEY_SIMPLEX,
            0.5,
            INK,
            1,
            cv2.LINE_AA,
        )
    note = "How far a point's projection lies from where the point was seen, in pixels."
    return Picture("Reprojection errors", note, png(pixels), "image/png")


def _paper(height: int, width: int) -> NDArray[np.uint8]:
    return np.full((height, width, 3), PAPER, dtype=np.uint8)


def png(pixels: NDArray[np.uint8]) -> bytes:
    """The file of (h, w, 3) pixels."""
    return png_bytes(pixels, optimize=True)


def jpeg(pixels: NDArray[np.uint8]) -> bytes:
    """The file of (h, w, 3) pixels, where there are photos in them."""
    return jpeg_bytes(pixels, 85)
