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


def plan_picture(structure: Structure) -> Picture:
    """The points from above in their colours, and each camera with the way that it looks."""
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
    note = "Points in their colours; a red dot is a camera, the line the way that it looks."
    return Picture("From above", note, png(pixels), "image/png")


def match_picture(
    image_ids: Sequence[int],
    pairs: Sequence[PairRecord],
    doubtful: Sequence[tuple[int, int]] = (),
) -> Picture:
    """A cell per pair of photos, the darker the more features agree; doubtful ones are red."""
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
    planar = sum(pair.planar for pair in pairs)
    note = (
        "Which photos agree: a row and a column per photo in the order of their names, the darker"
        f" the more features. {planar} pairs are explained by a plane."
        + (f" Red: {len(doubtful)} doubtful pairs, which were not used." if doubtful else "")
    )
    return Picture("Matches", note, png(pixels), "image/png")


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
