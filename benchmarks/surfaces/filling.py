"""Holes wider than a window in synthetic facades: filled, beside OpenCV's two inpaintings.

    python benchmarks surfaces/filling [--seeds 12] [--pictures DIR]

Facades with known truth are rectified; a hole with a third of a window of wall around it is cut
over each of two windows of every facade. The seeds start at 100: what was looked at while the step
was made is below 10. A window counts as found again where the picture about it, blurred by an
eighth of its width (each window has its own glazing and curtains), correlates with the true one by
0.5 or more.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print
from texture_measures import psnr, ssim

from veduta.surfaces import fill_holes
from veduta.synthetic.facade import make_facade
from veduta.synthetic.layout import STYLES
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.truth import FacadeTruth, TrueElement

FIRST_SEED = 100
LONGEST_PX = 900
AROUND = 0.35
FOUND = 0.5
Pixels = NDArray[np.uint8]
Box = tuple[int, int, int, int]


def _telea(pixels: Pixels, holes: NDArray[np.bool_]) -> Pixels:
    found = cv2.inpaint(pixels, holes.astype(np.uint8), 5, cv2.INPAINT_TELEA)
    return np.asarray(found, dtype=np.uint8)


def _navier_stokes(pixels: Pixels, holes: NDArray[np.bool_]) -> Pixels:
    found = cv2.inpaint(pixels, holes.astype(np.uint8), 5, cv2.INPAINT_NS)
    return np.asarray(found, dtype=np.uint8)


METHODS: dict[str, Callable[[Pixels, NDArray[np.bool_]], Pixels]] = {
    "veduta": lambda pixels, holes: fill_holes(pixels, holes).pixels,
    "OpenCV Telea": _telea,
    "OpenCV Navier-Stokes": _navier_stokes,
}


def rectified(seed: int, style: int) -> tuple[Pixels, FacadeTruth, float]:
    """The facade in its own plane, the truth, and pixels in a metre."""
    options = SyntheticOptions(
        style=STYLES[style], detached=True, long_side_px=LONGEST_PX, samples=1
    )
    made = make_facade(seed, options)
    truth = made.truth
    scale = 0.8 * LONGEST_PX / max(truth.width_m, truth.height_m)
    size = (int(truth.width_m * scale), int(truth.height_m * scale))
    facade = np.array([[1.0 / scale, 0, 0], [0, -1.0 / scale, truth.height_m], [0, 0, 1]])
    matrix = truth.photo_from_facade @ facade
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpPerspective(made.photo, matrix, size, flags=flags)), truth, scale


def box_of(element: TrueElement, truth: FacadeTruth, scale: float) -> Box:
    """Left, top, right, bottom of an element in the rectified picture (px)."""
    rect = element.rect
    top, bottom = truth.height_m - rect.y_m - rect.height_m, truth.height_m - rect.y_m
    left, right = rect.x_m, rect.x_m + rect.width_m
    return (int(left * scale), int(top * scale), int(right * scale), int(bottom * scale))


def holes_of(
    truth: FacadeTruth, scale: float, shape: tuple[int, int], seed: int
) -> tuple[NDArray[np.bool_], list[Box]]:
    """Two holes over windows, drawn from the seed, and the windows' boxes."""
    rng = np.random.default_rng(seed)
    windows = [one for one in truth.elements if one.label == "window"]
    boxes = [box_of(windows[n], truth, scale) for n in rng.permutation(len(windows))[:2]]
    holes = np.zeros(shape, dtype=np.bool_)
    for left, top, right, bottom in boxes:
        more = int(AROUND * (right - left)) + 3
        holes[max(0, top - more) : bottom + more, max(0, left - more) : right + more] = True
    return holes, boxes


def agree(filled: Pixels, true: Pixels, box: Box) -> float:
    """Correlation of both about a window, its glazing and curtains blurred away."""
    left, top, right, bottom = box
    more, soft = int(AROUND * (right - left)), (right - left) / 8.0
    both = []
    for pixels in (filled, true):
        grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY).astype(np.float32)
        blurred = cv2.GaussianBlur(grey, (0, 0), soft)
        part = blurred[max(0, top - more) : bottom + more, max(0, left - more) : right + more]
        both.append(part.ravel())
    if min(one.std() for one in both) < 1e-6:
        return 0.0
    return float(np.corrcoef(both[0], both[1])[0, 1])


def measure(seed: int, pictures: Path | None) -> list[dict[str, float | str]]:
    """Each method on one facade."""
    style = seed % len(STYLES)
    true, truth, scale = rectified(seed, style)
    holes, boxes = holes_of(truth, scale, true.shape[:2], seed)
    spoilt = true.copy()
    spoilt[holes] = (255, 0, 255)
    shown, rows = [spoilt], []
    for name, method in METHODS.items():
        start = time.perf_counter()
        filled = method(spoilt, holes)
        seconds = time.perf_counter() - start
        alike = [agree(filled, true, box) for box in boxes]
        one, other = true / 255.0, filled / 255.0
        rows.append(
            {
                "method": name,
                "style": STYLES[style],
                "psnr": psnr(one, other, holes),
                "ssim": ssim(one, other, holes),
                "windows": float(len(boxes)),
                "found": float(sum(value >= FOUND for value in alike)),
                "seconds": seconds,
                "megapixels": holes.sum() / 1e6,
            }
        )
        shown.append(filled)
    if pictures is not None:
        sheet = np.hstack(shown)[..., ::-1]
        cv2.imwrite(str(pictures / f"{seed}-{STYLES[style]}.png"), sheet)
    return rows


def main() -> None:
    """Measure all seeds and keep the means."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=12)
    parser.add_argument("--pictures", type=Path)
    given = parser.parse_args()
    if given.pictures:
        given.pictures.mkdir(parents=True, exist_ok=True)
    rows = [row for n in range(given.seeds) for row in measure(FIRST_SEED + n, given.pictures)]
    table: list[Row] = []
    for name in METHODS:
        own = [row for row in rows if row["method"] == name]
        total = {
            key: sum(float(row[key]) for row in own) for key in ("found", "windows", "seconds")
        }
        table.append(
            {
                "method": name,
                "facades": len(own),
                "PSNR (dB)": float(np.mean([float(row["psnr"]) for row in own])),
                "SSIM": float(np.mean([float(row["ssim"]) for row in own])),
                "windows found again": f"{total['found']:.0f} of {total['windows']:.0f}",
                "s per facade": total["seconds"] / len(own),
            }
        )
    notes = [
        f"Unseen seeds from {FIRST_SEED}, one style after the other; only inside the holes.",
        "Two holes a facade, each a window with 0.35 of its width around it.",
    ]
    keep_or_print("surfaces-filling", table, notes, keep=given.seeds >= 12)


if __name__ == "__main__":
    main()
